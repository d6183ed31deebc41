//! Tables of the study.

use refsim::isa::Span;

use super::bits::FormatBits;
use super::outcome::{FamilyOutcome, Precision, PrecisionOutcome};
use super::runs::Runs;
use super::search::MixedFormats;
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Table};
use crate::shader::SourceLine;

/// Formats a value for sentences.
pub(super) fn number(value: f64) -> String {
    shown(value, Quantity::Error)
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

/// Line number and text of the instruction at a place, with the program's name if there are several programs.
pub(super) fn named_line(place: usize, runs: &Runs<'_>) -> [Cell; 2] {
    let SourceLine { file, line, text, .. } = line(place, runs);
    let number = if runs.programs.len() > 1 { format!("{file}:{line}") } else { line.to_string() };
    [number.into(), text.into()]
}

/// Table of uniform runs in the formats of cards.
pub(super) fn named(outcome: &PrecisionOutcome, runs: &Runs<'_>) -> Table {
    let measure = runs.goal.measure.as_str();
    let mut table = Table::new("All instructions in formats of cards", &["format", "layout", "bits", measure, "met"]);
    for (name, bits, value) in &outcome.named {
        let cells = [bits.to_string().into(), bits.width().into(), Cell::error(*value), runs.goal.met(*value).into()];
        table.push([Cell::from(*name)].into_iter().chain(cells));
    }
    table
}

/// Table of the curves' points.
pub(super) fn curves(outcome: &PrecisionOutcome, runs: &Runs<'_>) -> Table {
    let measure = runs.goal.measure.as_str();
    let mut table = Table::new("Points of the curves", &["family", "format", "bits", "precision_bits", measure, "met"]);
    for family in &outcome.families {
        for (&digits, &value) in &family.curve.scan.points {
            let bits = FormatBits { family: family.curve.family, range: family.curve.range, digits };
            table.push([
                family.curve.family.name().into(),
                bits.to_string().into(),
                bits.width().into(),
                digits.into(),
                Cell::error(value),
                runs.goal.met(value).into(),
            ]);
        }
    }
    table
}

/// Table with a row per instruction.
pub(super) fn instructions(family: &FamilyOutcome, minimum: FormatBits, runs: &Runs<'_>) -> Table {
    let mut table = Table::of(
        format!("Instructions, {}", family.curve.family.digits()),
        "line instruction alone others_at_minimum mixed blame_% regained_% note",
    );
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
        table.push(named_line(place, runs).into_iter().chain(cells));
    }
    table
}

/// Table of the mixed formats.
pub(super) fn mixed(mixed: &MixedFormats, study: &Precision, runs: &Runs<'_>) -> Table {
    let mut table = Table::of("A format per instruction", "line instruction format bits cost");
    for (place, &bits) in mixed.formats.iter().enumerate() {
        let cells: [Cell; 3] = [bits.to_string().into(), bits.width().into(), study.costs.of(bits).into()];
        table.push(named_line(place, runs).into_iter().chain(cells));
    }
    table
}

/// Table of each format with one bit less.
pub(super) fn refuted(mixed: &MixedFormats, runs: &Runs<'_>) -> Table {
    let measure = runs.goal.measure.as_str();
    let mut table =
        Table::new("One bit less", &["line", "instruction", "format", measure, "met", "largest error at column, row"]);
    for refuted in &mixed.refuted {
        let cells: [Cell; 4] = [
            refuted.bits.to_string().into(),
            Cell::error(refuted.value),
            runs.goal.met(refuted.value).into(),
            refuted.worst.as_deref().into(),
        ];
        table.push(named_line(refuted.place, runs).into_iter().chain(cells));
    }
    table
}

/// Table of switch values, the index of the first row with the same findings per row, and the names of the rows.
pub(super) fn switches(outcome: &PrecisionOutcome) -> (Table, Vec<usize>, Vec<String>) {
    let mut table = Table::of("Values of open switches", "switch value current as_given exact minimum note");
    let rows = &outcome.switches;
    for row in rows {
        let head = [Cell::from(row.switch.as_str()), row.value.as_str().into(), row.is_current.into()];
        let cells: [Cell; 4] = match &row.found {
            Ok(found) => {
                let minimum = found.minimum.map(|bits| bits.to_string());
                [Cell::error(found.given), Cell::error(found.exact), minimum.into(), Cell::Empty]
            }
            Err(error) => [Cell::Empty, Cell::Empty, Cell::Empty, error.as_str().into()],
        };
        table.push(head.into_iter().chain(cells));
    }
    let first = |row: usize| rows[..row].iter().position(|other| other.same_as(&rows[row])).unwrap_or(row);
    let names = rows.iter().map(|row| format!("{}={}", row.switch, row.value)).collect();
    (table, (0..rows.len()).map(first).collect(), names)
}

/// Table of the measures' meanings.
pub(super) fn measures(runs: &Runs<'_>) -> Table {
    let mut table = Table::of("Measures, against the exact run", "measure meaning");
    for measure in runs.subject.measures() {
        table.push([Cell::from(measure.name), measure.meaning.into()]);
    }
    table
}
