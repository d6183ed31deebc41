//! Page and tables of the study.

use serde_json::json;

use super::super::goal::Goal;
use super::blame::OperationError;
use super::errors::Errors;
use super::graph::Expression;
use super::sample::Samples;
use super::{ExpressionOutcome, ExpressionStudy, FormatErrors};
use crate::report::digits::{Quantity, shown};
use crate::report::words::counted;
use crate::report::{Cell, Chart, Findings, FoundTable, NamedChart, Scale, Series, Table, Verdict};
use crate::study::StudyError;

const BITS: &str = "Bits of error are log2(1 + n), with n the numbers of the format from the computed result to the \
    correctly rounded one; all bits of the format if the result is NaN. The mean is over sampled inputs, with its \
    standard error. Accuracy is the share of the format's bits that are right in the mean. Inputs are numbers of the \
    format itself. Discarded inputs meet the precondition but have no finite result in the format.";

const OPERATIONS: &str = "Local: bits of error of the operation on its exact operands, each rounded once. Alone: bits \
    of error of the whole expression if only this operation rounds its result and all others are exact. Both are means \
    over up to 256 inputs; operations that never err are left out.";

const RELATIVE: &str = "Measures of relative error are over inputs in single precision, which each format rounds \
    first, against the exact result of the inputs as they were.";

/// Builds the findings. Of several expressions those that fail are listed; one alone is an error.
pub(super) fn findings(
    study: &ExpressionStudy,
    goal: &Goal,
    outcomes: Vec<Result<ExpressionOutcome, StudyError>>,
) -> Result<Findings, StudyError> {
    let mut found = Findings::new(format!("Precision of {}", study.title));
    let mut refused = Table::of("Not studied", "place reason");
    for error in &study.refused {
        let (line, column) = error.line_and_column();
        refused.push([format!("{line}:{column}").into(), error.to_string().into()]);
    }
    let mut studied = Vec::new();
    for (expression, outcome) in study.expressions.iter().zip(outcomes) {
        match outcome {
            Ok(outcome) => studied.push((expression, outcome)),
            Err(error) if study.expressions.len() == 1 => return Err(error),
            Err(error) => {
                let place = expression.body.0.last().map(|node| expression.text(node)).unwrap_or_default();
                refused.push([format!("{}:{}", place.1, place.2).into(), error.to_string().into()]);
            }
        }
    }
    if let [(expression, outcome)] = &studied[..] {
        one(&mut found, expression, outcome, study, goal);
    } else {
        many(&mut found, &studied, study, goal);
    }
    found.table(FoundTable::from(refused).csv("not_studied").field("not_studied"));
    let meets = |outcome: &ExpressionOutcome| outcome.curves.iter().any(|curve| curve.minimum.is_some());
    found.conclude(Verdict::held(!studied.is_empty() && studied.iter().all(|(_, outcome)| meets(outcome))));
    found.fields(json!({ "title": study.title, "goal": goal.to_string(), "samples": study.samples }));
    Ok(found)
}

/// Everything of one expression.
fn one(
    found: &mut Findings,
    expression: &Expression,
    outcome: &ExpressionOutcome,
    study: &ExpressionStudy,
    goal: &Goal,
) {
    let variables = expression.variables.join(", ");
    let of = if variables.is_empty() { String::new() } else { format!(" of {variables}") };
    let samples = counted(study.samples as u64, "input", "inputs");
    found.introduce(format!("{}{of}: {samples} per format, goal {goal}", expression.name));
    for curve in &outcome.curves {
        let family = curve.family.name();
        found.conclusion(match curve.minimum {
            None => format!("No {family} format up to {} bits meets {goal}.", if family == "float" { 32 } else { 33 }),
            Some(bits) => format!("Smallest {family} format that meets {goal}: {bits}, {} bits.", bits.width()),
        });
    }
    let (format, operations) = &outcome.blamed;
    if let Some(most) = operations.iter().max_by(|a, b| a.alone.total_cmp(&b.alone)) {
        let (text, line, column) = expression.text(&expression.body.0[most.node]);
        found.conclusion(format!(
            "Most to blame in {format}: `{text}` ({line}:{column}), {} bits of error alone.",
            shown(most.alone, Quantity::Error)
        ));
    }
    if let Some(chart) = chart(outcome, goal) {
        found.chart(chart);
    }
    found.heading("Formats");
    let mut table = errors_table(goal);
    outcome.formats.iter().for_each(|row| table.push(error_cells(row, goal)));
    found.explained_table(FoundTable::from(table).csv("formats").field("formats"), BITS);
    found.paragraph(RELATIVE);
    found.heading("Operations");
    let mut table = Table::of(format!("Operations in {format}"), "place operation local_bits alone_bits");
    operations.iter().for_each(|error| table.push(operation_cells(expression, error)));
    found.explained_table(FoundTable::from(table).csv("operations").field("operations"), OPERATIONS);
    found.heading("Inputs");
    let mut table = Table::of("Inputs", "format kept undefined too_large undecided worst_input worst_bits");
    outcome.formats.iter().for_each(|row| table.push(input_cells(expression, row)));
    found.table(FoundTable::from(table).csv("inputs").field("inputs").unprinted());
}

fn errors_table(goal: &Goal) -> Table {
    let measure = match goal.measure.as_str() {
        "mean_bits" | "worst_bits" => "mean_relative",
        measure => measure,
    };
    Table::new(
        "Bits of error",
        &[
            "format",
            "layout",
            "bits",
            "mean_bits",
            "standard_error",
            "worst_bits",
            "accuracy_%",
            "discarded",
            measure,
            "met",
        ],
    )
}

fn error_cells(row: &FormatErrors, goal: &Goal) -> Vec<Cell> {
    let FormatErrors { name, layout, arithmetic, samples, errors, value } = row;
    let width = arithmetic.width();
    let relative = if goal.measure.ends_with("_bits") { errors.mean_relative } else { *value };
    let accuracy = 100.0 * (1.0 - errors.mean_bits / f64::from(width));
    let format: [Cell; 3] = [(*name).into(), layout.clone().into(), width.into()];
    let bits = [errors.mean_bits, errors.standard_error, errors.worst_bits].map(Cell::error);
    let found = if samples.kept.is_empty() { [Cell::Empty, Cell::Empty, Cell::Empty] } else { bits };
    let accuracy = if samples.kept.is_empty() { Cell::Empty } else { Cell::percent(accuracy) };
    let rest = [accuracy, discarded(samples).into(), Cell::error(relative), goal.met(*value).into()];
    format.into_iter().chain(found).chain(rest).collect()
}

fn discarded(samples: &Samples) -> usize {
    samples.undefined + samples.too_large + samples.undecided
}

fn operation_cells(expression: &Expression, error: &OperationError) -> [Cell; 4] {
    let (text, line, column) = expression.text(&expression.body.0[error.node]);
    let [local, alone] = [error.local, error.alone].map(Cell::error);
    [format!("{line}:{column}").into(), text.into(), local, alone]
}

fn input_cells(expression: &Expression, row: &FormatErrors) -> Vec<Cell> {
    let FormatErrors { name, samples, errors: Errors { worst, worst_bits, .. }, arithmetic, .. } = row;
    let value = |(name, bits): (&String, &u64)| format!("{name}={}", shown(arithmetic.value(*bits), Quantity::Exact));
    let worst = samples.kept.get(*worst).map(|sample| expression.variables.iter().zip(&sample.inputs).map(value));
    let counts = [samples.kept.len(), samples.undefined, samples.too_large, samples.undecided].map(Cell::from);
    let input = worst.map(|words| words.collect::<Vec<_>>().join(", "));
    std::iter::once((*name).into()).chain(counts).chain([input.into(), Cell::error(*worst_bits)]).collect()
}

/// One row for each of several expressions.
fn many(found: &mut Findings, studied: &[(&Expression, ExpressionOutcome)], study: &ExpressionStudy, goal: &Goal) {
    let expressions = counted(studied.len() as u64, "expression", "expressions");
    let samples = counted(study.samples as u64, "input", "inputs");
    found.introduce(format!("{}: {expressions}, {samples} per format, goal {goal}", study.title));
    for (at, family) in study.families.iter().enumerate() {
        let met = studied.iter().filter(|(_, outcome)| outcome.curves[at].minimum.is_some()).count();
        found.conclusion(format!("In {met} of {expressions} some {} format meets {goal}.", family.name()));
    }
    let names: Vec<&str> =
        studied.first().map(|(_, outcome)| outcome.formats.iter().map(|row| row.name).collect()).unwrap_or_default();
    let columns: Vec<String> = names.iter().map(|name| format!("{name}_bits")).collect();
    let smallest = study.families.iter().map(|family| format!("smallest_{}", family.name()));
    let headings: Vec<String> = std::iter::once("expression".to_owned()).chain(columns).chain(smallest).collect();
    let mut table = Table::new("Mean bits of error", &headings);
    let mut all = errors_table(goal);
    let mut blamed = Table::of("Operations", "expression format place operation local_bits alone_bits");
    for (expression, outcome) in studied {
        let bits = outcome.formats.iter().map(|row| match row.samples.kept.is_empty() {
            true => Cell::Empty,
            false => Cell::error(row.errors.mean_bits),
        });
        let minima = outcome.curves.iter().map(|curve| curve.minimum.map(|bits| bits.to_string()).into());
        table.push(std::iter::once(expression.name.as_str().into()).chain(bits).chain(minima));
        for row in &outcome.formats {
            let mut cells = error_cells(row, goal);
            cells[0] = format!("{}: {}", expression.name, row.name).into();
            all.push(cells);
        }
        for error in &outcome.blamed.1 {
            let lead: [Cell; 2] = [expression.name.as_str().into(), outcome.blamed.0.as_str().into()];
            blamed.push(lead.into_iter().chain(operation_cells(expression, error)));
        }
    }
    found.heading("Expressions");
    found.explained_table(FoundTable::from(table).csv("expressions").field("expressions"), BITS);
    found.paragraph(RELATIVE);
    found.keep_table(FoundTable::from(all).csv("formats").field("formats"));
    found.heading("Operations");
    let table = FoundTable::from(blamed).csv("operations").field("operations").unprinted();
    found.explained_table(table, OPERATIONS);
}

/// The goal's measure by mantissa or fraction bits, if there are values to draw.
fn chart(outcome: &ExpressionOutcome, goal: &Goal) -> Option<NamedChart> {
    let line = |curve: &super::Curve| {
        let points = curve.scan.points.iter().map(|(bits, value)| (f64::from(*bits), *value));
        let label = format!("{}, {}", curve.family.name(), curve.range_text());
        Series { label, points: points.filter(|(_, value)| value.is_finite() && *value > 0.0).collect() }
    };
    let lines: Vec<Series> = outcome.curves.iter().map(line).filter(|line| line.points.len() > 1).collect();
    let is_flat = lines.iter().all(|line| line.points.iter().all(|point| point.1 == line.points[0].1));
    let chart = Chart {
        title: format!("{} by bits of precision", goal.measure),
        x: "mantissa or fraction bits of all operations".to_owned(),
        y: goal.measure.clone(),
        y_scale: Scale::fitting(lines.iter().flat_map(|line| &line.points).map(|point| point.1)),
        lines,
        ..Chart::default()
    };
    let caption = format!("{} of the whole expression in one format; goal: {goal}.", goal.measure);
    (!is_flat).then(|| NamedChart { name: "curve".to_owned(), chart, caption })
}
