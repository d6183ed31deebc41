//! Findings of the study.

use refsim::num::matrix::Element;
use serde_json::json;

use super::blame::{AddendFate, Blame};
use super::product::{Errors, MatrixProduct, ProductOutcome, ProductRow};
use crate::io::{write_npy_array, write_npy_doubles};
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Chart, Findings, FoundTable, NamedChart, Scale, Series, Table, Verdict};
use crate::study::{ProgressFn, Study, StudyError};

/// Maximum number of addends printed; those with the largest loss are printed.
const MOST_ADDENDS: usize = 10;
const MOST_LINES: usize = 12;

const ERRORS: &str = "Errors are relative to the magnitude of the reference, per element. worst is the largest error; \
    mean is signed, and positive if results are too large; bits is -log2 of worst. of_addends is the largest error \
    relative to the sum of the magnitudes of an element's addends, so cancellation does not enlarge it.";

impl ProductRow {
    fn name(&self) -> String {
        let promotion = self.promote.map_or("with one accumulator".into(), |step| format!("promoted every {step}"));
        format!("{} {promotion}", self.unit.name)
    }

    /// Errors over all products.
    fn last(&self) -> Errors {
        self.errors.last().copied().unwrap_or_default()
    }
}

fn error(value: f64) -> String {
    shown(value, Quantity::Error)
}

impl Study for MatrixProduct {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        let outcome = self.compute(progress)?;
        findings(self, outcome)
    }
}

fn findings(study: &MatrixProduct, outcome: ProductOutcome) -> Result<Findings, StudyError> {
    let [rows, depth, columns] = outcome.shape;
    let mut found = Findings::new(format!("Matrix product, {rows} x {depth} x {columns}"));
    let reference = study.against.map_or("the exact product of the quantised operands", |unit| unit.name);
    conclude(&mut found, reference, &outcome);
    found
        .paragraph(format!("{} times {}, against {reference}. {ERRORS}", study.factors[0].name, study.factors[1].name));
    found.field("shape", json!(outcome.shape));
    let table = errors(&format!("Errors against {reference}"), &outcome, outcome.depths.len() - 1);
    found.table(FoundTable::from(table).csv("errors").field("errors"));
    found.keep_table(FoundTable::from(errors("Errors by depth", &outcome, 0)).csv("curve").field("curve"));
    if let Some(chart) = chart(&outcome) {
        found.chart(chart);
    }
    if let Some(blame) = &outcome.blame {
        add_blame(&mut found, study, blame);
    }
    if let Some(goal) = &study.goal {
        let name = study.units.first().map_or("", |unit| unit.name);
        let bits = match (outcome.fewest_bits, study.units.first().and_then(|unit| unit.bits)) {
            (Some(bits), _) => format!("{name} with one accumulator must keep {bits} bits below the largest exponent"),
            (None, Some(_)) => {
                format!("{name} misses the goal with one accumulator for any number of kept bits")
            }
            (None, None) => format!("{name} has a fixed number of bits"),
        };
        let promotion = match outcome.rarest_promotion {
            None => "promotion does not meet the goal at any interval".to_owned(),
            Some(step) if step == depth => "the unit meets the goal with one accumulator".to_owned(),
            Some(step) => format!("promotion every {step} products is the least frequent that meets the goal"),
        };
        found.conclusion(format!("{goal}: {bits}; with the unit's own number of bits, {promotion}."));
        found.field("fewest_bits", json!(outcome.fewest_bits));
        found.field("rarest_promotion", json!(outcome.rarest_promotion));
        found.conclude(Verdict::held(outcome.fewest_bits.is_some() || outcome.rarest_promotion.is_some()));
    }
    for row in &outcome.rows {
        let mut bytes = Vec::new();
        // Writing to memory cannot fail.
        if row.unit.result.element == Element::FP64 {
            write_npy_doubles(&[rows, columns], &row.product, &mut bytes).ok();
        } else {
            let values: Vec<f32> = row.product.iter().map(|&value| value as f32).collect();
            write_npy_array(&[rows, columns], &values, &mut bytes).ok();
        }
        let promote = row.promote.map(|step| format!("_{step}")).unwrap_or_default();
        found.keep_file(format!("{}{promote}.npy", row.unit.name), bytes);
    }
    Ok(found)
}

/// Reports the largest and the smallest error in words.
fn conclude(found: &mut Findings, reference: &str, outcome: &ProductOutcome) {
    let [rows, depth, columns] = outcome.shape;
    let order = |x: &&ProductRow, y: &&ProductRow| {
        let (x, y) = (x.last(), y.last());
        x.worst.total_cmp(&y.worst).then(x.differing.cmp(&y.differing)).then(x.not_finite.cmp(&y.not_finite))
    };
    let (Some(worst), Some(best)) = (outcome.rows.iter().max_by(order), outcome.rows.iter().min_by(order)) else {
        return;
    };
    let (errors, elements) = (worst.last(), rows * columns);
    let differ = format!("{} of {elements} elements differ from {reference}.", errors.differing);
    let mut sentence = if errors.differing == 0 {
        let every = ["Every element", "Every finite element"][usize::from(errors.not_finite > 0)];
        format!("{every} equals that of {reference}.")
    } else if errors.worst == 0.0 {
        differ
    } else {
        format!(
            "After {depth} products, {} is off by up to {} of an element ({:.1} bits are right); {differ}",
            worst.name(),
            error(errors.worst),
            errors.bits(),
        )
    };
    if best.last().worst < errors.worst {
        sentence += &format!(" {} has the smallest error: up to {}.", best.name(), error(best.last().worst));
    }
    found.conclusion(sentence);
    if errors.not_finite > 0 {
        found.conclusion(format!(
            "{} of {elements} elements are infinite or NaN in the result of {} or in {reference}; the errors exclude \
             them.",
            errors.not_finite,
            worst.name(),
        ));
    }
}

/// Errors at the depths after the first `skipped`.
fn errors(title: &str, outcome: &ProductOutcome, skipped: usize) -> Table {
    let mut table = Table::of(title, "unit promoted_every k worst mean of_addends bits differing of not_finite");
    let elements = outcome.shape[0] * outcome.shape[2];
    for row in &outcome.rows {
        let promotion: Cell = row.promote.map_or("none".into(), Cell::from);
        for (&depth, errors) in outcome.depths.iter().zip(&row.errors).skip(skipped) {
            let [worst, mean, share] = [errors.worst, errors.mean, errors.of_addends].map(Cell::error);
            let bits = if errors.worst == 0.0 { Cell::Empty } else { Cell::decimals(errors.bits(), 1) };
            let counts = [errors.differing, elements, errors.not_finite].map(Cell::from);
            let cells = [row.unit.name.into(), promotion.clone(), depth.into(), worst, mean, share, bits];
            table.push(cells.into_iter().chain(counts));
        }
    }
    table
}

/// Chart of the worst error over depth; `None` unless errors are known at two depths or more.
fn chart(outcome: &ProductOutcome) -> Option<NamedChart> {
    let line = |row: &ProductRow| {
        let points = outcome.depths.iter().zip(&row.errors).map(|(&depth, errors)| (depth as f64, errors.worst));
        Series { label: row.name(), points: points.filter(|point| point.1 > 0.0 && point.1.is_finite()).collect() }
    };
    let lines: Vec<Series> =
        outcome.rows.iter().map(line).filter(|line| line.points.len() > 1).take(MOST_LINES).collect();
    let chart = Chart {
        title: "Worst relative error over K".to_owned(),
        x: "K, products per element".to_owned(),
        y: "worst relative error".to_owned(),
        x_scale: Scale::Logarithmic,
        y_scale: Scale::Logarithmic,
        lines,
        ..Chart::default()
    };
    let caption = "Error of the sum of the first K products, maximum over all elements.".to_owned();
    (!chart.lines.is_empty()).then(|| NamedChart { name: "curve".to_owned(), chart, caption })
}

fn add_blame(found: &mut Findings, study: &MatrixProduct, blame: &Blame) {
    let ([row, column], [before, behind], end) = (blame.place, blame.block, blame.end);
    let unit = study.units.first().map_or("", |unit| unit.name);
    let other = study.against.map_or("the exact sum", |unit| unit.name);
    let [x, y] = [end.ours, end.theirs].map(|sum| shown(sum, Quantity::Exact));
    let difference = error(end.ours - end.theirs);
    let ends = format!("Element ({row}, {column}) is {x} by {unit} and {y} by {other}: a difference of {difference}");
    let products = format!("products {} to {}", before.k, behind.k.saturating_sub(1));
    let [from, to] = [before, behind].map(|sums| error(sums.ours - sums.theirs));
    let sentence = match study.against {
        _ if before.k == behind.k => format!("Element ({row}, {column}): {unit} and {other} do not differ."),
        Some(_) => format!("{ends}. The sums first differ in the {products}, by {to}."),
        None => format!("{ends}. The {products} contribute most: the difference is {to} after them, {from} before."),
    };
    found.heading("One element");
    found.paragraph(sentence.clone());
    found.print(sentence);
    let table = |title: &str, fates: &[&AddendFate]| {
        let mut table = Table::of(title, "unit addend exact kept cut");
        for fate in fates {
            let [exact, kept, cut] = [fate.exact, fate.kept, fate.exact - fate.kept].map(Cell::error);
            table.push([fate.unit.into(), fate.addend.as_str().into(), exact, kept, cut]);
        }
        table
    };
    let mut fates: Vec<&AddendFate> = blame.addends.iter().collect();
    found.keep_table(FoundTable::from(table("All addends of the block", &fates)).csv("addends").field("addends"));
    fates.sort_by(|x, y| (y.exact - y.kept).abs().total_cmp(&(x.exact - x.kept).abs()));
    fates.truncate(MOST_ADDENDS);
    let title = "Addends with the largest losses: a number is the k of a product, c is the sum before the block, \
         result is the rounding of the sum";
    found.table(FoundTable::from(table(title, &fates)));
}
