//! Tables of the traces of refutations.

use super::outcome::FamilyOutcome;
use super::refutations::RefutationTrace;
use super::runs::Runs;
use super::subject::StepResult;
use super::tables::{line_cells, named_line};
use crate::report::{Cell, Table, digits};

/// The trace of the most blamed instruction that has one.
pub(super) fn most_blamed<'t>(traces: &'t [RefutationTrace], family: &FamilyOutcome) -> Option<&'t RefutationTrace> {
    let blame = |trace: &RefutationTrace| family.needs[trace.refuted.place].blame.unwrap_or(0.0);
    // The first one on a tie.
    traces.iter().min_by(|a, b| blame(b).total_cmp(&blame(a)))
}

pub(super) fn title(trace: &RefutationTrace, runs: &Runs<'_>) -> String {
    let [line, text] = named_line(trace.refuted.place, runs).map(|cell| cell.text());
    let [column, row] = trace.traced.pixel;
    format!("Pixel {column}, {row} with line {line}, {text}, in {}", trace.refuted.bits)
}

/// Columns of a trace.
const COLUMNS: &str = "fragment line instruction component exact mixed one_bit_less one_bit_less_differs";

/// Number of rows above which a trace shows only results that one bit less changes.
const LONG: usize = 1000;

/// Table of one trace: a row per component of each step that all three runs execute; above [`LONG`] rows, only rows in
/// which the last two runs differ.
pub(super) fn table(title: String, trace: &RefutationTrace, runs: &Runs<'_>) -> Table {
    let mut table = Table::of(title, COLUMNS);
    rows(trace, runs).for_each(|row| table.push(row));
    table
}

/// Table of all traces, each row with the refuted format.
pub(super) fn all(traces: &[RefutationTrace], runs: &Runs<'_>) -> Table {
    let mut table = Table::of("Traces of refutations", &format!("refuted_line format column row {COLUMNS}"));
    for trace in traces {
        let [refuted_line, _] = named_line(trace.refuted.place, runs);
        let [column, row] = trace.traced.pixel;
        let place = [refuted_line, trace.refuted.bits.to_string().into(), column.into(), row.into()];
        rows(trace, runs).for_each(|row| table.push(place.iter().cloned().chain(row)));
    }
    table
}

fn rows(trace: &RefutationTrace, runs: &Runs<'_>) -> impl Iterator<Item = Vec<Cell>> {
    let steps = aligned(&trace.traced.steps);
    let is_long = steps.clone().count() > LONG;
    let is_shown = move |[mixed, less]: [f64; 2]| !is_long || mixed.to_bits() != less.to_bits();
    steps.filter(move |(_, results)| is_shown(*results)).map(|(exact, [mixed, less])| {
        let [line, text] = line_cells(exact.program, exact.instruction, runs);
        let component = ["r", "g", "b", "a"][usize::from(exact.component)];
        let values = [exact.value, mixed, less].map(|value| digits::exact(value).into());
        let differs = less.to_bits() != mixed.to_bits();
        [exact.fragment.into(), line, text, component.into()]
            .into_iter()
            .chain(values)
            .chain([differs.into()])
            .collect()
    })
}

/// Steps that execute the same instruction in all three runs, up to the first difference in control flow.
fn aligned([exact, mixed, less]: &[Vec<StepResult>; 3]) -> impl Iterator<Item = (StepResult, [f64; 2])> + Clone {
    let place = |step: &StepResult| (step.fragment, step.program, step.instruction, step.component);
    exact
        .iter()
        .zip(mixed.iter().zip(less))
        .take_while(move |(exact, (mixed, less))| place(exact) == place(mixed) && place(exact) == place(less))
        .map(|(exact, (mixed, less))| (*exact, [mixed.value, less.value]))
}
