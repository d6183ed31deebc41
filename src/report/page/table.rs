//! Tables that move inside their box.

use maud::{Markup, html};

use super::super::Table;

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
                        @for (column, heading) in table.headings().iter().enumerate() {
                            th.said[said(column)] scope="col" { (broken(heading)) }
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
                                    td.number[cell.is_number()].said[said(column)] { (cell.text()) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// A heading that may go over several lines behind its underscores.
fn broken(heading: &str) -> Markup {
    html! {
        @for part in heading.split_inclusive('_') { (part) @if part.ends_with('_') { wbr; } }
    }
}
