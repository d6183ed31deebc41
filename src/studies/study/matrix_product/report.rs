//! Findings of the study.

use serde_json::json;

use super::blame::Blame;
use super::product::{Errors, MatrixProduct, ProductOutcome, ProductRow};
use crate::io::write_npy_array;
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Chart, Findings, FoundTable, NamedChart, Scale, Series, Table, Verdict};
use crate::study::StudyError;

/// Maximum number of addends that are printed; those that lose most.
const MOST_ADDENDS: usize = 10;
/// Lines of the chart, at most.
const MOST_LINES: usize = 12;

const ERRORS: &str = "Errors are relative to the reference, element by element: worst is the largest, mean has the sign of \
    larger results, bits is -log2 of the worst; of addends is the largest error as a share of the sum of the magnitudes of \
    an element's addends, which cancellation does not enlarge.";

impl ProductRow {
    fn name(&self) -> String {
        let promote = self.promote.map(|step| format!(", promoted every {step}")).unwrap_or_default();
        format!("{}{promote}", self.unit.name)
    }
}

pub(super) fn findings(study: &MatrixProduct, outcome: ProductOutcome) -> Result<Findings, StudyError> {
    let [rows, depth, columns] = outcome.shape;
    let mut found = Findings::new(format!("Matrix product, {rows} x {depth} x {columns}"));
    let reference = study.against.map_or("the exact product of the quantised operands", |unit| unit.name);
    found
        .paragraph(format!("{} times {}, against {reference}. {ERRORS}", study.factors[0].name, study.factors[1].name));
    found.field("shape", json!(outcome.shape));
    let title = format!("Errors against {reference}");
    found.table(FoundTable::from(errors(&title, &outcome)).csv("errors").field("errors"));
    found.keep_table(FoundTable::from(curve(&outcome)).csv("curve").field("curve"));
    if let Some(worst) = outcome.rows.iter().max_by(|x, y| last(x).worst.total_cmp(&last(y).worst)) {
        let size = shown(last(worst).worst, Quantity::Error);
        found.conclusion(format!("The largest error is {size}, of {}.", worst.name()));
    }
    if let Some(chart) = chart(&outcome) {
        found.chart(chart);
    }
    if let Some(blame) = &outcome.blame {
        add_blame(&mut found, study, blame);
    }
    if let (Some(goal), Some(reached)) = (&study.goal, &outcome.goal) {
        let name = study.units.first().map_or("", |unit| unit.name);
        let bits = reached.fewest_bits.map_or("no number of bits".to_owned(), |bits| format!("{bits} bits or more"));
        let promotion = match reached.rarest_promotion {
            None => "no promotion meets it".to_owned(),
            Some(step) if step == depth => "it meets the goal with one accumulator".to_owned(),
            Some(step) => format!("promotion every {step} products is the rarest that meets it"),
        };
        found.conclusion(format!(
            "{goal}: {name} with {bits} below the largest exponent meets it with one accumulator; with its own, {promotion}."
        ));
        found.field("fewest_bits", json!(reached.fewest_bits));
        found.field("rarest_promotion", json!(reached.rarest_promotion));
        found.conclude(Verdict::held(reached.fewest_bits.is_some() || reached.rarest_promotion.is_some()));
    }
    for row in &outcome.rows {
        let mut bytes = Vec::new();
        let values: Vec<f32> = row.product.iter().map(|&value| value as f32).collect();
        // Writing to memory cannot fail.
        write_npy_array(&[rows, columns], &values, &mut bytes).ok();
        let promote = row.promote.map(|step| format!("_{step}")).unwrap_or_default();
        found.keep_file(format!("{}{promote}.npy", row.unit.name), bytes);
    }
    Ok(found)
}

fn last(row: &ProductRow) -> Errors {
    row.errors.last().copied().unwrap_or_default()
}

fn promotion(row: &ProductRow) -> Cell {
    row.promote.map_or("none".into(), Cell::from)
}

fn errors(title: &str, outcome: &ProductOutcome) -> Table {
    let mut table = Table::of(title, "unit promoted_every worst mean of_addends bits differing of not_finite");
    let elements = outcome.shape[0] * outcome.shape[2];
    for row in &outcome.rows {
        let errors = last(row);
        table.push([
            row.unit.name.into(),
            promotion(row),
            Cell::error(errors.worst),
            Cell::error(errors.mean),
            Cell::error(errors.of_addends),
            if errors.worst == 0.0 { Cell::Empty } else { Cell::decimals(errors.bits(), 1) },
            errors.differing.into(),
            elements.into(),
            errors.not_finite.into(),
        ]);
    }
    table
}

fn curve(outcome: &ProductOutcome) -> Table {
    let mut table = Table::of("Errors by depth", "unit promoted_every k worst mean of_addends");
    for row in &outcome.rows {
        for (&depth, errors) in outcome.depths.iter().zip(&row.errors) {
            let [worst, mean, share] = [errors.worst, errors.mean, errors.of_addends].map(Cell::error);
            table.push([row.unit.name.into(), promotion(row), depth.into(), worst, mean, share]);
        }
    }
    table
}

/// Worst error over depth; none if there is no error at two depths.
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
    let caption = format!("The first K products of every element; at most {MOST_LINES} lines.");
    (!chart.lines.is_empty()).then(|| NamedChart { name: "curve".to_owned(), chart, caption })
}

fn add_blame(found: &mut Findings, study: &MatrixProduct, blame: &Blame) {
    let ([row, column], [start, end]) = (blame.place, blame.block);
    let names =
        [study.units.first().map_or("", |unit| unit.name), study.against.map_or("the exact sum", |unit| unit.name)];
    let [before, behind] = blame.sums.map(|sums| sums.map(|sum| shown(sum, Quantity::Error)));
    let sentence = if start == end {
        format!("Element ({row}, {column}): {} and {} do not part.", names[0], names[1])
    } else {
        format!(
            "Element ({row}, {column}): {} and {} part most in the products {start} to {}: {} and {} before, {} and {} behind.",
            names[0],
            names[1],
            end - 1,
            before[0],
            before[1],
            behind[0],
            behind[1],
        )
    };
    let sentence = if study.against.is_some() { sentence.replace("part most in", "first part in") } else { sentence };
    found.heading("One element");
    found.paragraph(sentence.clone());
    found.print(sentence);
    let mut fates: Vec<_> = blame.addends.iter().collect();
    let table = |title: &str, fates: &[&super::blame::AddendFate]| {
        let mut table = Table::of(title, "unit addend exact kept cut");
        for fate in fates {
            let cut = fate.exact - fate.kept;
            table.push([
                fate.unit.into(),
                fate.addend.as_str().into(),
                Cell::error(fate.exact),
                Cell::error(fate.kept),
                Cell::error(cut),
            ]);
        }
        table
    };
    found.keep_table(FoundTable::from(table("All addends of the block", &fates)).csv("addends").field("addends"));
    fates.sort_by(|x, y| (y.exact - y.kept).abs().total_cmp(&(x.exact - x.kept).abs()));
    fates.truncate(MOST_ADDENDS);
    found.table(FoundTable::from(table("Addends that lose most; `result` is the rounding of the block's sum", &fates)));
}
