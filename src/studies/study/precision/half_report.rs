//! Table of expressions in half precision, and the shader with them.

use super::half::{HalfExpression, rewritten};
use super::runs::Runs;
use super::tables::{self, number};
use crate::report::words::counted;
use crate::report::{Cell, Findings, FoundTable, Table};
use crate::study::StudyError;

/// Adds the table, the sentence at the top, and the rewritten shader.
pub(super) fn report(found: &mut Findings, rows: &[HalfExpression], runs: &Runs<'_>) -> Result<(), StudyError> {
    let Some(text) = rewritten(rows, runs).filter(|_| !rows.is_empty()) else { return Ok(()) };
    let mut table =
        Table::new("Half precision", &["line", "expression", "alone", "may be f16", "refuted at column, row"]);
    for row in rows {
        let may = match (row.together, runs.goal.met(row.alone)) {
            (true, _) => "yes",
            (false, true) => "alone",
            _ => "no",
        };
        let refuted = row.worst.as_ref().filter(|_| !row.together).map(String::as_str);
        let cells = [Cell::error(row.alone), may.into(), refuted.into()];
        table.push(tables::named_line(row.place, runs).into_iter().chain(cells));
    }
    let count = rows.iter().filter(|row| row.together).count();
    let all = counted(rows.len() as u64, "expression", "expressions");
    let measure = &runs.goal.measure;
    let value = runs.subject.measure_text(&text, measure)?.map_or(f64::NAN, |measured| measured.value(measure));
    let met = if runs.goal.met(value) { "meets" } else { "misses" };
    found.conclusion(format!(
        "{count} of {all} may be f16 together. half.wgsl has them in f16 and {met} the goal: {measure} is {}.",
        number(value)
    ));
    found.keep_file("half.wgsl", text.named_source().text().as_bytes().to_vec());
    found.heading("Half precision");
    found.explained_table(
        FoundTable::from(table).csv("half").field("half"),
        "Each expression computed in f16 while all others are exact, and whether it may be f16 together with all others \
         that say yes. Found by adding one after the other, the harmless first. The last column is the pixel with the \
         largest error of the run that refuted it.",
    );
    Ok(())
}
