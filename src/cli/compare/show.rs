//! A comparison as text and as JSON.

use std::{path::Path, sync::Arc};

use miette::{Diagnostic, SourceSpan};
use serde_json::{Value, json};

use super::super::{
    Out,
    words::{fate, letters},
};
use crate::{
    case::{Comparison, First, Setup, Side},
    compare::{Compared, FragmentPass, Operand, SurfaceDifference, TraceDifference, TraceStage},
    report::{Cell, SourceText, Table, visible::visible_line},
};

/// A comparison with its sides.
pub(super) struct ShownComparison<'a> {
    pub(super) case: &'a Path,
    pub(super) sides: &'a [Side<'a>; 2],
    pub(super) comparison: &'a Comparison,
}

/// An instruction, quoted.
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

fn pass_text(pass: &FragmentPass) -> String {
    let part = if pass.part > 0 { format!(", part {}", pass.part) } else { String::new() };
    format!("instance {}, triangle {}{part}", pass.instance, pass.triangle)
}

fn pass_json(pass: &FragmentPass) -> Value {
    json!({ "index": pass.index, "instance": pass.instance, "triangle": pass.triangle, "part": pass.part })
}

fn values_table(values: &[Compared]) -> Table {
    let mut table = Table::new("Values", &["component", "left", "bits", "right", "bits ", "ulps", "of"]);
    for v in values {
        let text = [&v.name, &v.left, &v.left_bits, &v.right, &v.right_bits].map(|text| Cell::from(text.as_str()));
        table.push(text.into_iter().chain([ulps_cell(v), v.unit.as_str().into()]));
    }
    table
}

fn operands_table(operands: &[Operand]) -> Table {
    let mut table = Table::new("Operands", &["read", "left", "bits", "right", "bits ", "ulps", "of"]);
    for v in operands.iter().flat_map(|operand| &operand.values) {
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
    fn setup(&self) -> &Setup {
        self.sides[0].setup
    }

    fn draw_name(&self) -> String {
        let stem = || self.case.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        self.setup().title.clone().unwrap_or_else(stem)
    }

    pub(super) fn print(&self, out: &mut Out) -> miette::Result<()> {
        if let Some(title) = &self.setup().title {
            out.line(visible_line(title))?;
        }
        for (name, side) in ["left ", "right"].into_iter().zip(self.sides) {
            let profile = &side.setup.profile;
            let executor = side.executor.kind().name();
            out.line(format_args!(
                "{name}  executor {executor}, device {}, pixel registers {}",
                profile.name, profile.rules.format
            ))?;
            if !side.setup.left_out.is_empty() {
                out.line(format_args!(
                    "       without what this device does not have: {}",
                    side.setup.left_out.join(", ")
                ))?;
            }
        }
        let comparison = self.comparison;
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
        let Comparison { pixels, different, followed, counts, .. } = self.comparison;
        if self.comparison.equal() {
            let steps = match followed[0] {
                0 => String::new(),
                1 => ", and everything written at the pixel".to_owned(),
                n => format!(", and everything written at {n} pixels"),
            };
            return format!("equal: every stored bit of {pixels} pixels, every count{steps}");
        }
        let mut text = format!("different: {different} of {pixels} pixels");
        if !counts.is_empty() {
            text.push_str(", and counts");
        }
        if followed[0] > 1 {
            text.push_str(&format!("; something written differs at {} of {} pixels", followed[1], followed[0]));
        }
        text
    }

    fn print_first(&self, first: &First, out: &mut Out) -> miette::Result<()> {
        let [x, y] = first.pixel;
        let place = format!("first difference: draw {} `{}`", first.draw, self.draw_name());
        let Some(difference) = &first.difference else {
            out.line(format_args!("{place}, pixel {x}, {y}"))?;
            out.line("no step on the way of its fragments differs: the draw of a side departs from its own trace")?;
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
            out.line("the first instruction of the pass that is affected:")?;
            self.print_difference(later, out)?;
        }
        Ok(())
    }

    fn print_difference(&self, difference: &TraceDifference, out: &mut Out) -> miette::Result<()> {
        let (text, instruction) = self.stage(difference);
        match instruction.and_then(|index| self.quote(index, text.clone())) {
            Some(quote) => out.finding(&quote)?,
            None => out.line(text)?,
        }
        if !difference.values.is_empty() {
            out.line("")?;
            out.table(&values_table(&difference.values))?;
        }
        if !difference.operands.is_empty() {
            let differs = difference.operands.iter().any(|operand| operand.differs);
            out.line("")?;
            out.line(if differs {
                "what it read, which differs already (before swizzle and modifiers):"
            } else {
                "what it read, the same on both sides (before swizzle and modifiers):"
            })?;
            out.table(&operands_table(&difference.operands))?;
        }
        Ok(())
    }

    /// The stage in words, and the instruction it is about.
    fn stage(&self, difference: &TraceDifference) -> (String, Option<usize>) {
        let name = difference.values.first().map_or("nothing", |v| v.name.as_str());
        match &difference.stage {
            TraceStage::Vertex { corner } => {
                (format!("stage: vertices: {name} of corner {corner} of the triangle, before set-up"), None)
            }
            TraceStage::Coverage { left, right } => {
                let side = |pass: &Option<FragmentPass>| pass.as_ref().map_or("none".to_owned(), pass_text);
                let sides = format!("{} on the left, {} on the right", side(left), side(right));
                (format!("stage: coverage, from the set-up of triangles: {sides}"), None)
            }
            TraceStage::Input => (format!("stage: interpolation of {name}, before the program"), None),
            TraceStage::Delivered => {
                (format!("stage: input register {name}, the interpolated value in the register format"), None)
            }
            TraceStage::Instruction { index } => (format!("instruction {index} writes another {name}"), Some(*index)),
            TraceStage::Mask { index, left, right } => {
                let sides = format!("`{}` on the left, `{}` on the right", letters(*left), letters(*right));
                (format!("instruction {index} writes other components, by its predicate: {sides}"), Some(*index))
            }
            TraceStage::Flow { left, right } => {
                let side = |next: &Option<usize>| next.map_or("the end".to_owned(), |i| format!("instruction {i}"));
                let sides = format!("{} on the left, {} on the right", side(left), side(right));
                (format!("stage: flow control: what runs next is {sides}"), left.or(*right))
            }
            TraceStage::Output { instruction } => {
                let text = format!("stage: what the program leaves behind: {name}");
                (text, *instruction)
            }
            TraceStage::Test { left, right } => {
                let sides = format!("the fragment {} on the left and {} on the right", fate(*left), fate(*right));
                (format!("stage: output tests, after equal results of the program: {sides}"), None)
            }
            TraceStage::Merge => {
                let text = "stage: output merge (quantising, blending, masking), after equal results of the program";
                (format!("{text}: {name}"), None)
            }
        }
    }

    fn quote(&self, index: usize, message: String) -> Option<Quote> {
        let instruction = self.setup().pixel.instructions.get(index)?;
        let text = &self.setup().pixel_text;
        Some(Quote {
            message,
            source_code: text.named_source(),
            span: instruction.span.into(),
            label: format!("line {}", text.line(instruction.span).line),
        })
    }

    pub(super) fn document(&self) -> Value {
        let comparison = self.comparison;
        json!({
            "case": self.case.display().to_string(),
            "title": self.setup().title,
            "version": env!("CARGO_PKG_VERSION"),
            "left": side_json(&self.sides[0]),
            "right": side_json(&self.sides[1]),
            "equal": comparison.equal(),
            "pixels": comparison.pixels,
            "different": comparison.different,
            "surfaces": comparison.surfaces,
            "counts": comparison.counts,
            "followed": { "pixels": comparison.followed[0], "different": comparison.followed[1] },
            "first": comparison.first.as_ref().map(|first| self.first_json(first)),
        })
    }

    fn first_json(&self, first: &First) -> Value {
        json!({
            "draw": { "index": first.draw, "name": self.draw_name() },
            "pixel": first.pixel,
            "difference": first.difference.as_ref().map(|difference| self.difference_json(difference)),
        })
    }

    fn difference_json(&self, difference: &TraceDifference) -> Value {
        let (text, instruction) = self.stage(difference);
        let mut value = json!({
            "pass": pass_json(&difference.pass),
            "passes": difference.passes,
            "stage": stage_name(&difference.stage),
            "text": text,
            "instruction": instruction.map(|index| self.instruction_json(index)),
            "values": difference.values,
            "operands": difference.operands.iter().map(|operand| {
                json!({ "differs": operand.differs, "values": operand.values })
            }).collect::<Vec<_>>(),
        });
        match &difference.stage {
            TraceStage::Vertex { corner } => value["corner"] = (*corner).into(),
            TraceStage::Coverage { left, right } => {
                value["left"] = json!(left.as_ref().map(pass_json));
                value["right"] = json!(right.as_ref().map(pass_json));
            }
            TraceStage::Mask { left, right, .. } => {
                (value["left"], value["right"]) = (letters(*left).into(), letters(*right).into());
            }
            TraceStage::Flow { left, right } => {
                value["left"] = json!(left.map(|index| self.instruction_json(index)));
                value["right"] = json!(right.map(|index| self.instruction_json(index)));
            }
            TraceStage::Test { left, right } => {
                (value["left"], value["right"]) = (fate(*left).into(), fate(*right).into());
            }
            _ => {}
        }
        if let Some(later) = &difference.instruction {
            value["later"] = self.difference_json(later);
        }
        value
    }

    fn instruction_json(&self, index: usize) -> Value {
        let setup = self.setup();
        let line = setup.pixel.instructions.get(index).map(|i| setup.pixel_text.line(i.span));
        json!({ "index": index, "source": line })
    }
}

/// The stage in one word.
const fn stage_name(stage: &TraceStage) -> &'static str {
    match stage {
        TraceStage::Vertex { .. } => "vertices",
        TraceStage::Coverage { .. } => "coverage",
        TraceStage::Input => "interpolation",
        TraceStage::Delivered => "input",
        TraceStage::Instruction { .. } => "instruction",
        TraceStage::Mask { .. } => "predicate",
        TraceStage::Flow { .. } => "flow",
        TraceStage::Output { .. } => "output",
        TraceStage::Test { .. } => "test",
        TraceStage::Merge => "merge",
    }
}

fn side_json(side: &Side<'_>) -> Value {
    let profile = &side.setup.profile;
    let switches: serde_json::Map<String, Value> =
        profile.switches().iter().map(|switch| (switch.name.clone(), switch.current.clone().into())).collect();
    json!({
        "executor": side.executor.kind().name(),
        "device": profile.name,
        "format": profile.rules.format.to_string(),
        "switches": switches,
        "left_out": side.setup.left_out,
    })
}
