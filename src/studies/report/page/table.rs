//! Tables that scroll inside their box.

use maud::{Markup, html};

use super::super::{Cell, Table};

/// Name of the column that stays visible at the right edge.
const SAID: &str = "verdict";

/// Renders a table in a box that scrolls; `place` makes its id.
pub(super) fn scrolling(table: &Table, place: usize) -> Markup {
    let id = format!("table-{place}");
    let said = |column: usize| table.headings()[column] == SAID;
    html! {
        // Scrollable regions are focusable by keyboard, and have a name.
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

/// CSS class of a cell; a verdict is not formatted as a number.
const fn class(cell: &Cell, said: bool) -> Option<&'static str> {
    match (said, cell.is_number()) {
        (true, _) => Some("said"),
        (false, true) => Some("number"),
        (false, false) => None,
    }
}
