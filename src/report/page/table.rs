//! Tables that move inside their box.

use maud::{Markup, html};

use super::super::{Cell, Table};

/// The column of this name stays in sight at the right edge.
const SAID: &str = "verdict";

/// A table in a box that scrolls; `place` makes its id.
pub(super) fn scrolling(table: &Table, place: usize) -> Markup {
    let id = format!("table-{place}");
    let said = |column: usize| table.headings()[column] == SAID;
    html! {
        // What scrolls can be reached by keys, and has a name.
        div.scroll tabindex="0" role="region" aria-labelledby=(id) {
            table {
                caption id=(id) { (table.title()) }
                thead {
                    tr {
                        @for (column, heading) in table.shown_headings().iter().enumerate() {
                            th class=[said(column).then_some("said")] scope="col" { (heading) }
                        }
                    }
                }
                tbody {
                    @for row in table.rows() {
                        tr {
                            @for (column, cell) in row.iter().enumerate() {
                                @if column == 0 {
                                    th scope="row" { (cell.text()) }
                                } @else {
                                    td class=[class(cell, said(column))] { (cell.text()) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The class of an entry; a verdict is no number.
const fn class(cell: &Cell, said: bool) -> Option<&'static str> {
    match (said, cell.is_number()) {
        (true, _) => Some("said"),
        (false, true) => Some("number"),
        (false, false) => None,
    }
}
