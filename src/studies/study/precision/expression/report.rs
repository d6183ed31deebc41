//! Page and tables of the study.

use serde_json::json;

use super::super::curve::Curve;
use super::super::goal::Goal;
use super::graph::Expression;
use super::sample::{Sample, Samples};
use super::study::{ExpressionOutcome, ExpressionStudy, FormatErrors};
use crate::report::digits::{Quantity, exact, shown};
use crate::report::words::counted;
use crate::report::{Cell, Chart, Findings, FoundTable, NamedChart, Scale, Series, Table, Verdict};
use crate::study::StudyError;

const BITS: &str = "Bits of error are log2(1 + n), where n counts the format's numbers from the computed result to \
    the correctly rounded one; a NaN counts as all bits of the format. The mean is over sampled inputs. Accuracy is \
    the mean share of correct bits in the format. Inputs are numbers of the format itself. Discarded inputs meet the \
    precondition, but their result in the format is not finite, or still ambiguous with 12,288 bits.";

const OPERATIONS: &str = "local_bits is the error of the operation on its exact operands, each rounded once. \
    alone_bits is the error of the whole expression if only this operation rounds its result and all others are \
    exact. Both are means over up to 256 inputs; the table leaves out operations that never err.";

const RELATIVE: &str = "Relative errors are over single-precision inputs, which each format rounds first; the \
    reference is the exact result for the unrounded inputs.";

/// Builds the findings. Among several expressions, failing ones are listed; the failure of a single one is an error.
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
    let (one, samples) = (studied.len() == 1, counted(study.samples as u64, "input", "inputs"));
    found.introduce(format!("{}: {samples} per format, goal {goal}", study.title));
    match &studied[..] {
        [(expression, outcome)] => conclude(&mut found, expression, outcome, goal),
        _ => count(&mut found, &studied, study, goal),
    }
    tables(&mut found, &studied, goal, one);
    found.table(FoundTable::from(refused).csv("not_studied").field("not_studied"));
    let meets = |outcome: &ExpressionOutcome| outcome.curves.iter().any(|curve| curve.minimum.is_some());
    found.conclude(Verdict::held(!studied.is_empty() && studied.iter().all(|(_, outcome)| meets(outcome))));
    found.fields(json!({ "title": study.title, "goal": goal.to_string(), "samples": study.samples }));
    Ok(found)
}

/// Adds the sentences about one expression.
fn conclude(found: &mut Findings, expression: &Expression, outcome: &ExpressionOutcome, goal: &Goal) {
    for curve in &outcome.curves {
        let family = curve.family.name();
        found.conclusion(match curve.minimum {
            None => format!("No {family} format of up to 32 bits meets {goal}."),
            Some(bits) => format!("Smallest {family} format that meets {goal}: {bits}, {} bits.", bits.width()),
        });
    }
    let (format, operations) = &outcome.blamed;
    if let Some(most) = operations.iter().max_by(|a, b| a.alone.total_cmp(&b.alone)) {
        let (text, line, column) = expression.text(&expression.body.0[most.node]);
        found.conclusion(format!(
            "Most to blame in {format}: `{text}` ({line}:{column}), which alone causes {} bits of error.",
            shown(most.alone, Quantity::Error)
        ));
    }
    if let Some(chart) = chart(outcome, goal) {
        found.chart(chart);
    }
}

/// Adds a table with a row per expression, if there are several.
fn count(found: &mut Findings, studied: &[(&Expression, ExpressionOutcome)], study: &ExpressionStudy, goal: &Goal) {
    let expressions = counted(studied.len() as u64, "expression", "expressions");
    for (at, family) in study.families.iter().enumerate() {
        let met = studied.iter().filter(|(_, outcome)| outcome.curves[at].minimum.is_some()).count();
        found.conclusion(format!("For {met} of {expressions}, at least one {} format meets {goal}.", family.name()));
    }
    let names = studied.iter().take(1).flat_map(|(_, outcome)| outcome.formats.iter().map(|row| row.name));
    let smallest = study.families.iter().map(|family| format!("smallest_{}", family.name()));
    let columns = names.map(|name| format!("{name}_bits")).chain(smallest);
    let headings: Vec<String> = std::iter::once("expression".to_owned()).chain(columns).collect();
    let mut table = Table::new("Mean bits of error", &headings);
    for (expression, outcome) in studied {
        let bits = outcome.formats.iter().map(|row| error_cell(row.bits.mean));
        let minima = outcome.curves.iter().map(|curve| curve.minimum.map(|bits| bits.to_string()).into());
        table.push(std::iter::once(expression.name.as_str().into()).chain(bits).chain(minima));
    }
    found.heading("Expressions");
    found.table(FoundTable::from(table).csv("expressions").field("expressions"));
}

/// The cell of an error; empty if there were no inputs.
fn error_cell(error: f64) -> Cell {
    if error.is_nan() { Cell::Empty } else { Cell::error(error) }
}

/// Adds the tables of errors and of operations; they are printed only for a single expression, and then without its
/// name.
fn tables(found: &mut Findings, studied: &[(&Expression, ExpressionOutcome)], goal: &Goal, one: bool) {
    let name = if one { "" } else { "expression " };
    let columns = format!("{name}format bits mean_bits worst_bits accuracy_% discarded {} met", goal.measure);
    let mut errors = Table::of("Bits of error", &columns);
    let title = studied.iter().take(usize::from(one)).map(|(_, outcome)| format!(" in {}", outcome.blamed.0)).next();
    let title = format!("Operations{}", title.unwrap_or_default());
    let mut inputs =
        Table::of("Inputs", &format!("{name}format layout inputs mean_bits standard_error worst_bits worst_input"));
    let mut operations = Table::of(title, &format!("{name}place operation local_bits alone_bits"));
    for (expression, outcome) in studied {
        let lead = || (!one).then(|| Cell::from(expression.name.as_str())).into_iter();
        for row in &outcome.formats {
            errors.push(lead().chain(error_cells(row, goal)));
            inputs.push(lead().chain(worst_input(expression, row)));
        }
        for error in &outcome.blamed.1 {
            let (text, line, column) = expression.text(&expression.body.0[error.node]);
            let [local, alone] = [error.local, error.alone].map(Cell::error);
            operations.push(lead().chain([format!("{line}:{column}").into(), text.into(), local, alone]));
        }
    }
    let printed = |table: FoundTable| if one { table } else { table.unprinted() };
    found.heading("Formats");
    found.explained_table(printed(FoundTable::from(errors).csv("formats").field("formats")), BITS);
    found.paragraph(RELATIVE);
    found.table(FoundTable::from(inputs).csv("inputs").field("inputs").unprinted());
    found.heading("Operations");
    found.explained_table(printed(FoundTable::from(operations).csv("operations").field("operations")), OPERATIONS);
}

fn error_cells(row: &FormatErrors, goal: &Goal) -> [Cell; 8] {
    let FormatErrors { name, arithmetic, samples, bits, value } = row;
    let width = arithmetic.width();
    let accuracy = 100.0 * (1.0 - bits.mean / f64::from(width));
    let accuracy = if accuracy.is_nan() { Cell::Empty } else { Cell::percent(accuracy) };
    let [mean, worst, value_cell] = [bits.mean, bits.worst, *value].map(error_cell);
    [(*name).into(), width.into(), mean, worst, accuracy, samples.discarded.into(), value_cell, goal.met(*value).into()]
}

/// The input with the largest error.
fn worst_input(expression: &Expression, row: &FormatErrors) -> [Cell; 7] {
    let FormatErrors { name, arithmetic, samples: Samples { kept, .. }, bits, .. } = row;
    let value = |(name, input): (&String, &u64)| format!("{name}={}", exact(arithmetic.value(*input)));
    let words = |sample: &Sample| expression.variables.iter().zip(&sample.inputs).map(value).collect::<Vec<_>>();
    let worst = kept.get(bits.worst_input).map(|sample| words(sample).join(" "));
    let [mean, error, most] = [bits.mean, bits.standard_error, bits.worst].map(error_cell);
    [(*name).into(), arithmetic.layout().into(), kept.len().into(), mean, error, most, worst.into()]
}

/// Chart of the goal's measure by mantissa or fraction bits, if there are values to draw.
fn chart(outcome: &ExpressionOutcome, goal: &Goal) -> Option<NamedChart> {
    let line = |curve: &Curve| curve.line(|value| value.is_finite() && value > 0.0);
    let mut lines: Vec<Series> = outcome.curves.iter().map(line).filter(|line| line.points.len() > 1).collect();
    let is_flat = lines.iter().all(|line| line.points.iter().all(|point| point.1 == line.points[0].1));
    let y_scale = Scale::fitting(lines.iter().flat_map(|line| &line.points).map(|point| point.1));
    lines.push(goal.line(&lines));
    let words = goal.words();
    let chart = Chart {
        title: format!("{words} by bits of precision"),
        x: "mantissa or fraction bits of all operations".to_owned(),
        y: words.clone(),
        y_scale,
        lines,
        ..Chart::default()
    };
    let caption = format!("{words} of the whole expression in one format; goal: {goal}.");
    (!is_flat).then(|| NamedChart { name: "curve".to_owned(), chart, caption })
}
