//! A comparison as text.

use std::sync::Arc;

use miette::{Diagnostic, SourceSpan};

use super::super::Out;
use crate::{
    case::{ComparedSides, Comparison, First, pass_text},
    compare::{Compared, SurfaceDifference, TraceDifference},
    report::{Cell, SourceText, Table, visible::visible_line},
};

pub(super) struct ShownComparison<'a>(pub(super) ComparedSides<'a>);

#[derive(Debug, thiserror::Error, Diagnostic)]
#[error("{message}")]
#[diagnostic(severity(Advice))]
struct Quote {
    message: String,
    #[source_code]
    source_code: Arc<SourceText>,
    #[label("{label}")]
    span: SourceSpan,
    label: String,
}

fn ulps_cell(values: &Compared) -> Cell {
    values.ulps.map_or_else(|| "none".into(), Cell::from)
}

/// Values on both sides; `named` is the heading of their names.
fn values_table<'a>(named: &str, values: impl IntoIterator<Item = &'a Compared>) -> Table {
    let mut table = Table::new("Values", &[named, "left", "bits", "right", "bits ", "ulps", "of"]);
    for v in values {
        let text = [&v.name, &v.left, &v.left_bits, &v.right, &v.right_bits].map(|text| Cell::from(text.as_str()));
        table.push(text.into_iter().chain([ulps_cell(v), v.unit.as_str().into()]));
    }
    table
}

fn surfaces_table(surfaces: &[SurfaceDifference]) -> Table {
    let headings = ["surface", "pixels", "different", "largest difference", "at", "channel", "left", "right", "ulps"];
    let mut table = Table::new("Surfaces", &headings);
    for surface in surfaces {
        let mut row: Vec<Cell> = vec![surface.surface.as_str().into(), surface.pixels.into(), surface.different.into()];
        if let Some(largest) = &surface.largest {
            let [x, y] = largest.pixel;
            let v = &largest.values;
            row.extend([largest.difference.into(), format!("{x}, {y}").into(), v.name.as_str().into()]);
            row.extend([v.left.as_str().into(), v.right.as_str().into(), ulps_cell(v)]);
        }
        table.push(row);
    }
    table
}

impl ShownComparison<'_> {
    pub(super) fn print(&self, out: &mut Out) -> miette::Result<()> {
        if let Some(title) = &self.0.setup().title {
            out.line(visible_line(title))?;
        }
        for (name, side) in ["left ", "right"].into_iter().zip(self.0.sides) {
            let profile = &side.setup.profile;
            let executor = side.executor.kind().name();
            out.line(format_args!(
                "{name}  executor {executor}, device {}, pixel registers {}",
                profile.name, profile.rules.format
            ))?;
            if !side.setup.left_out.is_empty() {
                out.line(format_args!(
                    "       ignored switches, which this device does not have: {}",
                    side.setup.left_out.join(", ")
                ))?;
            }
        }
        let comparison = self.0.comparison;
        out.line("")?;
        out.table(&surfaces_table(&comparison.surfaces))?;
        if !comparison.counts.is_empty() {
            out.line("")?;
            let mut table = Table::new("Counts", &["count", "left", "right"]);
            for count in &comparison.counts {
                table.push([count.count.into(), count.left.into(), count.right.into()]);
            }
            out.table(&table)?;
        }
        out.line("")?;
        out.line(self.verdict())?;
        if let Some(first) = &comparison.first {
            out.line("")?;
            self.print_first(first, out)?;
        }
        Ok(())
    }

    fn verdict(&self) -> String {
        let Comparison { pixels, different, followed, counts, .. } = self.0.comparison;
        if self.0.comparison.equal() {
            let steps = match followed[0] {
                0 => String::new(),
                1 => ", and every value written at the pixel".to_owned(),
                n => format!(", and every value written at {n} pixels"),
            };
            return format!("equal: every stored bit of {pixels} pixels, every count{steps}");
        }
        let mut text = format!("different: {different} of {pixels} pixels");
        if !counts.is_empty() {
            text.push_str(", and counts");
        }
        if followed[0] > 1 {
            text.push_str(&format!("; written values differ at {} of {} pixels", followed[1], followed[0]));
        }
        text
    }

    fn print_first(&self, first: &First, out: &mut Out) -> miette::Result<()> {
        let [x, y] = first.pixel;
        let place = format!("first difference: draw 0 `{}`", self.0.draw_name());
        let Some(difference) = &first.difference else {
            out.line(format_args!("{place}, pixel {x}, {y}"))?;
            out.line("no traced step differs: on one side the draw disagrees with its own trace")?;
            return Ok(());
        };
        let [left, right] = difference.passes;
        let passes = if left == right { left.to_string() } else { format!("{left} on the left, {right} on the right") };
        out.line(format_args!(
            "{place}, pixel {x}, {y}, pass {} of {passes} there ({})",
            difference.pass.index + 1,
            pass_text(&difference.pass)
        ))?;
        self.print_difference(difference, out)?;
        if let Some(later) = &difference.instruction {
            out.line("")?;
            out.line("the first affected instruction of the pass:")?;
            self.print_difference(later, out)?;
        }
        Ok(())
    }

    fn print_difference(&self, difference: &TraceDifference, out: &mut Out) -> miette::Result<()> {
        let (text, instruction) = self.0.stage(difference);
        match instruction.and_then(|index| self.quote(index, text.clone())) {
            Some(quote) => out.finding(&quote)?,
            None => out.line(text)?,
        }
        if !difference.values.is_empty() {
            out.line("")?;
            out.table(&values_table("component", &difference.values))?;
        }
        if !difference.operands.is_empty() {
            let differs = difference.operands.iter().any(|operand| operand.differs);
            out.line("")?;
            out.line(if differs {
                "its operands, which already differ (before swizzle and modifiers):"
            } else {
                "its operands, the same on both sides (before swizzle and modifiers):"
            })?;
            out.table(&values_table("read", difference.operands.iter().flat_map(|operand| &operand.values)))?;
        }
        Ok(())
    }

    fn quote(&self, index: usize, message: String) -> Option<Quote> {
        let instruction = self.0.setup().pixel.instructions.get(index)?;
        let text = &self.0.setup().pixel_text;
        Some(Quote {
            message,
            source_code: text.named_source(),
            span: instruction.span.into(),
            label: format!("line {}", text.line(instruction.span).line),
        })
    }
}
