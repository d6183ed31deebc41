//! Tables that scroll inside their box.

use maud::{Markup, html};

use super::super::summary::TallyEntry;
use super::super::{Cell, Table};

/// Name of the column that the page moves to second place; files keep the order.
const VERDICT: &str = "verdict";

/// Maximum number of rows of a table shown in full; a longer table scrolls in a box as high as the window.
const LONG: usize = 25;

/// Renders a table in a box that scrolls; `place` determines its id, and `tally` gives the tone of each verdict.
///
/// The script of the page adds search, choices and sorting.
pub(super) fn scrolling(table: &Table, place: usize, tally: &[TallyEntry]) -> Markup {
    let id = format!("table-{place}");
    let headings = table.shown_headings();
    let verdict = table.headings().iter().position(|heading| heading == VERDICT).filter(|column| *column > 0);
    let columns: Vec<usize> = [0].into_iter().chain(verdict).chain(others(headings.len(), verdict)).collect();
    let style = |row: &[Cell]| {
        if row.iter().any(|cell| matches!(cell, Cell::Folded(_))) {
            return Some("folded");
        }
        let said = row[verdict?].text();
        tally.iter().find(|entry| entry.what == said).map(|entry| entry.tone.class())
    };
    let class = |column: usize, cell: &Cell| if Some(column) == verdict { Some("said") } else { number(cell) };
    html! {
        // Scrollable regions are focusable by keyboard, and have a name.
        div.scroll.long[table.rows().len() > LONG] tabindex="0" role="region" aria-labelledby=(id) {
            table {
                caption id=(id) { (table.title()) }
                thead { tr { @for &column in columns.iter().take(headings.len()) { th scope="col" { (headings[column]) } } } }
                tbody {
                    @for (n, row) in table.rows().iter().enumerate() {
                        @let name = table.name(n);
                        tr id=[name] class=[style(row)] {
                            @for &column in columns.iter().take(row.len()) {
                                @let text = row[column].text();
                                @if column > 0 {
                                    td class=[class(column, &row[column])] { (text) }
                                } @else if let Some(name) = name {
                                    th scope="row" { (text) " " a.anchor href=(format!("#{name}")) title="Link to this row" { "#" } }
                                } @else {
                                    th scope="row" { (text) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Columns after the first, except the verdict column.
fn others(count: usize, verdict: Option<usize>) -> impl Iterator<Item = usize> {
    (1..count).filter(move |column| Some(*column) != verdict)
}

fn number(cell: &Cell) -> Option<&'static str> {
    cell.is_number().then_some("number")
}
