//! Tables of the study.

use refsim::isa::Span;

use super::bits::{FormatBits, FormatFamily};
use super::half::rewritten;
use super::outcome::{FamilyOutcome, PrecisionOutcome};
use super::runs::Runs;
use crate::report::digits::{Quantity, shown};
use crate::report::words::{counted, percent};
use crate::report::{Cell, Findings, FoundTable, Table};
use crate::shader::SourceLine;
use crate::study::StudyError;

/// Formats a value for sentences.
pub(super) fn number(value: f64) -> String {
    shown(value, Quantity::Error)
}

/// A table, written to a file and to the document under a name.
fn kept(table: Table, name: &'static str) -> FoundTable {
    FoundTable::from(table).csv(name).field(name)
}

/// The verb that says whether a value meets or misses the goal.
fn meets(value: f64, runs: &Runs<'_>) -> &'static str {
    if runs.goal.met(value) { "meets" } else { "misses" }
}

/// Source line of an instruction.
pub(super) fn line(place: usize, runs: &Runs<'_>) -> SourceLine {
    let place = &runs.places[place];
    let studied = &runs.programs[place.program];
    // Places of a study are instructions of its programs.
    studied
        .text
        .instruction(studied.program, place.instructions[0])
        .unwrap_or_else(|| studied.text.line(Span::default()))
}

/// A row that begins with the line number and text of the instruction at a place, with the program's name if there are
/// several programs.
fn at_line<const N: usize>(place: usize, runs: &Runs<'_>, cells: [Cell; N]) -> impl Iterator<Item = Cell> {
    let SourceLine { file, line, text, .. } = line(place, runs);
    let number = if runs.programs.len() > 1 { format!("{file}:{line}") } else { line.to_string() };
    [number.into(), text.into()].into_iter().chain(cells)
}

/// Adds the uniform runs in the formats of cards, and the points of the curves.
pub(super) fn uniform(found: &mut Findings, outcome: &PrecisionOutcome, runs: &Runs<'_>) {
    let measure = runs.goal.measure.as_str();
    found.heading("Formats for all instructions");
    let mut table = Table::new("All instructions in formats of cards", &["format", "layout", "bits", measure, "met"]);
    for (name, bits, value) in &outcome.named {
        let met = runs.goal.met(*value);
        let layout = bits.to_string();
        table.push([(*name).into(), layout.into(), bits.width().into(), Cell::error(*value), met.into()]);
    }
    found.table(kept(table, "formats"));
    let mut table = Table::new("Points of the curves", &["family", "format", "bits", "precision_bits", measure, "met"]);
    for curve in outcome.families.iter().map(|family| &family.curve) {
        for (&digits, &value) in &curve.scan.points {
            let bits = FormatBits { family: curve.family, range: curve.range, digits };
            table.push([
                curve.family.name().into(),
                bits.to_string().into(),
                bits.width().into(),
                digits.into(),
                Cell::error(value),
                runs.goal.met(value).into(),
            ]);
        }
    }
    found.table(kept(table, "curve").unprinted());
}

/// Adds the table of expressions in half precision, a sentence at the top, and the rewritten shader.
pub(super) fn half(found: &mut Findings, outcome: &PrecisionOutcome, runs: &Runs<'_>) -> Result<(), StudyError> {
    let rows = &outcome.half;
    let Some(text) = rewritten(rows, runs).filter(|_| !rows.is_empty()) else { return Ok(()) };
    let mut table =
        Table::new("Half precision", &["line", "expression", "alone", "may be f16", "refuted at column, row"]);
    for row in rows {
        let may = match (row.together, runs.goal.met(row.alone)) {
            (true, _) => "yes",
            (false, true) => "alone",
            _ => "no",
        };
        let refuted = row.worst.as_deref().filter(|_| !row.together);
        table.push(at_line(row.place, runs, [Cell::error(row.alone), may.into(), refuted.into()]));
    }
    let count = rows.iter().filter(|row| row.together).count();
    let all = counted(rows.len() as u64, "expression", "expressions");
    let measure = &runs.goal.measure;
    let value = runs.subject.measure_text(&text, measure)?.map_or(f64::NAN, |measured| measured.value(measure));
    found.conclusion(format!(
        "{count} of {all} may be f16 together. half.wgsl has them in f16 and {} the goal: {measure} is {}.",
        meets(value, runs),
        number(value)
    ));
    found.keep_file("half.wgsl", text.named_source().text().as_bytes().to_vec());
    found.heading("Half precision");
    found.explained_table(
        kept(table, "half"),
        "alone is the value of the goal's measure with only this expression in f16. All expressions with `yes` may be \
         f16 together: they were added one after the other, the least harmful first. The last column is the pixel with \
         the largest error in the run that refuted the expression.",
    );
    Ok(())
}

/// Adds the tables of one family.
pub(super) fn family(found: &mut Findings, family: &FamilyOutcome, runs: &Runs<'_>) {
    let Some(minimum) = family.curve.minimum else { return };
    let (name, digits) = (minimum.family.name(), minimum.family.digits());
    let [csv, mixed_csv, refuted_csv] = match minimum.family {
        FormatFamily::Float => ["instructions_float", "mixed_float", "refuted_float"],
        FormatFamily::Fixed => ["instructions_fixed", "mixed_fixed", "refuted_fixed"],
    };
    found.heading(format!("Instructions in {name} formats"));
    let columns = "line instruction alone others_at_minimum mixed blame_% regained_% note";
    let mut table = Table::of(format!("Instructions, {digits}"), columns);
    let fewest = *minimum.family.digit_bits(minimum.range).start();
    for (place, needs) in family.needs.iter().enumerate() {
        let mixed = family.mixed.as_ref().map(|mixed| mixed.formats[place].to_string());
        let share = |share: Option<f64>| share.map(|share| Cell::percent(100.0 * share));
        let has_no_effect = needs.blame == Some(0.0) && needs.alone == Some(fewest);
        let cells: [Cell; 6] = [
            needs.alone.into(),
            needs.in_company.into(),
            mixed.into(),
            share(needs.blame).into(),
            share(needs.regained).into(),
            has_no_effect.then_some("no effect").into(),
        ];
        table.push(at_line(place, runs, cells));
    }
    found.table(kept(table, csv));
    if let Some(blamed) = family.blamed {
        let sum: f64 = family.needs.iter().filter_map(|needs| needs.blame).fold(0.0, |sum, share| sum + share);
        found.paragraph(format!(
            "alone is the fewest {digits} that the instruction needs if all others are exact; others_at_minimum is the \
             fewest if all others are in {minimum}. blame and regained are shares of the loss with all instructions in \
             {}: blame remains if only this instruction is in that format, regained disappears if only this one is \
             exact. The shares of blame sum to {}: {}.",
            blamed,
            percent(sum),
            additivity(sum),
        ));
    }
    let Some(mixed) = &family.mixed else { return };
    let state = if mixed.is_minimal { "1-minimal" } else { "the best so far" };
    found.heading(format!("Mixed {name} formats, {state}"));
    let mut table = Table::of("A format per instruction", "line instruction format bits");
    for (place, bits) in mixed.formats.iter().enumerate() {
        table.push(at_line(place, runs, [bits.to_string().into(), bits.width().into()]));
    }
    found.table(kept(table, mixed_csv).unprinted());
    let measure = runs.goal.measure.as_str();
    if let Some(value) = family.held_back {
        let (met, value) = (meets(value, runs), number(value));
        found.paragraph(format!("On input held back from the search, {measure} is {value}, which {met} the goal."));
    }
    let columns = ["line", "instruction", "format", measure, "met", "largest error at column, row"];
    let mut table = Table::new("One bit less", &columns);
    for refuted in &mixed.refuted {
        let (value, worst) = (refuted.value, refuted.worst.as_deref());
        let (format, met) = (refuted.bits.to_string().into(), runs.goal.met(value).into());
        table.push(at_line(refuted.place, runs, [format, Cell::error(value), met, worst.into()]));
    }
    found.table(kept(table, refuted_csv).unprinted());
}

/// Explains the sum of the blame shares.
fn additivity(sum: f64) -> &'static str {
    match sum {
        ..0.99 => "errors that are small alone add up, or one enables another",
        ..=1.01 => "errors add up",
        _ => {
            "more than the whole loss, because errors cancel, or one hides another, as a clamp or a code of a target \
             does"
        }
    }
}

/// Adds the values of open switches; rows with the same findings are folded.
pub(super) fn switches(found: &mut Findings, outcome: &PrecisionOutcome) {
    let rows = &outcome.switches;
    if rows.is_empty() {
        return;
    }
    let mut table = Table::of("Values of open switches", "switch value current as_given exact minimum note");
    for row in rows {
        let cells: [Cell; 4] = match &row.found {
            Ok(found) => {
                let minimum = found.minimum.map(|bits| bits.to_string());
                [Cell::error(found.given), Cell::error(found.exact), minimum.into(), Cell::Empty]
            }
            Err(error) => [Cell::Empty, Cell::Empty, Cell::Empty, error.as_str().into()],
        };
        let head = [Cell::from(row.switch.as_str()), row.value.as_str().into(), row.is_current.into()];
        table.push(head.into_iter().chain(cells));
    }
    let first = |row: usize| rows[..row].iter().position(|other| other.same_as(&rows[row])).unwrap_or(row);
    let firsts: Vec<usize> = (0..rows.len()).map(first).collect();
    let named = |row: usize| format!("{}={}", rows[row].switch, rows[row].value);
    found.heading("Open switches");
    found.explained_table(
        kept(table, "switches").folded(&firsts, named, (["value", "values"], "the same")),
        "Each row changes one switch that has several values. minimum is the smallest format for all instructions with \
         the exponent or integer bits of the curve; the reference is the exact run of the device as given.",
    );
}
