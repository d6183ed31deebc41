//! Table of expressions in half precision.

use super::half::HalfExpression;
use super::runs::Runs;
use super::tables;
use crate::report::words::counted;
use crate::report::{Cell, Findings, FoundTable, Table};

/// Adds the table, and the sentence at the top.
pub(super) fn report(found: &mut Findings, rows: &[HalfExpression], runs: &Runs<'_>) {
    if rows.is_empty() {
        return;
    }
    let mut table = Table::of("Half precision", "line expression alone may_be_f16");
    for row in rows {
        let may = match (row.together, runs.goal.met(row.alone)) {
            (true, _) => "yes",
            (false, true) => "alone",
            _ => "no",
        };
        let cells = [Cell::error(row.alone), may.into()];
        table.push(tables::named_line(row.place, runs).into_iter().chain(cells));
    }
    let count = rows.iter().filter(|row| row.together).count();
    let all = counted(rows.len() as u64, "expression", "expressions");
    found.conclusion(format!("{count} of {all} may be f16 together."));
    found.heading("Half precision");
    found.explained_table(
        FoundTable::from(table).csv("half").field("half"),
        "Each expression computed in f16 while all others are exact, and whether it may be f16 together with all others \
         that say yes. Found by adding one after the other, the harmless first.",
    );
}
