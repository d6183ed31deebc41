//! Tests the documentation of the figures: the program generates parts of `docs/papers` and `docs/status.md`.

use std::collections::BTreeSet;

use crossbar::report::Table;
use crossbar::study::reproduce::report::{evidence_line, tables};
use crossbar::study::reproduce::{Paper, PaperRow, Reproduced, RowVerdict};

use super::{FOUND, all, file, findings};
use crate::pages::{filled, hold};

fn markdown(table: &Table) -> String {
    let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let rule = row(table.headings().iter().map(|_| "---".to_owned()).collect());
    let body = table.rows().iter().map(|cells| row(cells.iter().map(|cell| cell.text()).collect()));
    [row(table.shown_headings()), rule].into_iter().chain(body).collect()
}

/// Lists where figures are missed, including calibrated ones: `Table 1 (2 of 6)`.
fn missed_by_place() -> String {
    let mut places: Vec<(Paper, &str, [usize; 2])> = Vec::new();
    for row in all() {
        let paper = row.target.paper;
        let found = places.iter().position(|(p, place, _)| (*p, *place) == (paper, row.target.place.as_str()));
        let at = found.unwrap_or_else(|| {
            places.push((paper, &row.target.place, [0, 0]));
            places.len() - 1
        });
        places[at].2[0] += usize::from(row.verdict() == RowVerdict::Missed);
        places[at].2[1] += 1;
    }
    let missed = places.iter().filter(|(.., [missed, _])| *missed > 0);
    let text = missed.map(|(paper, place, [missed, all])| format!("{paper}, {place} ({missed} of {all})"));
    text.collect::<Vec<_>>().join("; ")
}

/// Text of the generated block with this name: `rows ID...`, `calibrated ID...`, `table ID PLACE`, `tally`, `missed`.
fn said(name: &str) -> String {
    let words: Vec<&str> = name.split(' ').collect();
    let of = |ids: &[&str], calibrated: usize| -> Table {
        ids.iter().for_each(|id| _ = findings(id));
        let of: Reproduced = FOUND.iter().filter(|(entry, _)| ids.contains(&entry.id)).cloned().collect();
        tables(&of)[calibrated].clone()
    };
    let table = match words[..] {
        ["tally"] => return evidence_line(&FOUND),
        ["missed"] => return missed_by_place(),
        ["rows", ref ids @ ..] => of(ids, 0),
        ["calibrated", ref ids @ ..] => of(ids, 1),
        ["table", id, place] => findings(id).tables[place.parse::<usize>().expect("a place from 0")].clone(),
        _ => panic!("unknown block `{name}`"),
    };
    format!("\n\n{}\n", markdown(&table))
}

/// Paths of docs/status.md and the papers' pages.
fn pages() -> Vec<String> {
    let folder = std::fs::read_dir(file("docs/papers")).expect("the papers' pages");
    let names = folder.map(|entry| entry.expect("an entry").file_name().into_string().expect("a name in ASCII"));
    let mut pages: Vec<String> =
        names.filter(|name| name.ends_with(".md")).map(|name| format!("docs/papers/{name}")).collect();
    pages.sort();
    pages.insert(0, "docs/status.md".to_owned());
    pages
}

/// The figures on the pages equal the program's.
#[test]
fn the_book_says_what_the_program_says() {
    for path in pages() {
        let text = std::fs::read_to_string(file(&path)).expect("a page");
        assert!(text.contains("<!-- reproduce: "), "{path} has figures of the program");
        hold(&file(&path), &filled(&text, "reproduce", said));
    }
}

/// The pages contain every row; predicted and calibrated rows have separate tables.
#[test]
fn every_row_stands_in_the_book() {
    let texts = pages().iter().map(|path| std::fs::read_to_string(file(path)).expect("a page")).collect::<String>();
    for (mark, is_calibrated) in [("rows", false), ("calibrated", true)] {
        let begin = format!("<!-- reproduce: {mark} ");
        let blocks = texts.split(begin.as_str()).skip(1).filter_map(|rest| rest.split_once(" -->"));
        let shown: BTreeSet<&str> = blocks.flat_map(|(ids, _)| ids.split(' ')).collect();
        let stands = |row: &PaperRow| row.is_calibrated() == is_calibrated;
        let judged = FOUND.iter().filter(|(_, found)| found.rows.iter().any(stands)).map(|(entry, _)| entry.id);
        assert_eq!(judged.filter(|id| !shown.contains(id)).collect::<Vec<_>>(), Vec::<&str>::new(), "{mark}");
    }
}

/// The charts in the documentation equal the program's.
#[test]
fn the_book_draws_what_the_program_draws() {
    for (id, name) in [
        ("ray-engine-tables-1-2", "ray-engine-table-2"),
        ("ray-engine-table-3", "ray-engine-host-octree"),
        ("ray-engine-table-5", "ray-engine-table-5"),
    ] {
        let chart = findings(id).charts.iter().find(|chart| chart.name == name).expect("a chart");
        let path = file(&format!("docs/papers/{}.svg", name.replace('-', "_")));
        hold(&path, &chart.chart.svg().expect("a drawing"));
    }
}
