//! The book's text on the figures: `docs/papers` and `docs/status.md` are the program's own text.

use crate::environment::writes_files;
use std::collections::BTreeSet;

use crossbar::report::Table;
use crossbar::study::reproduce::report::{evidence_line, tables};
use crossbar::study::reproduce::{Paper, PaperRow, Prose, Reproduced, RowVerdict, number};

use super::{FOUND, all, file, findings, found, is_all};

/// Figures in sentences are the run's: what is written by hand has digits in names alone.
#[test]
fn no_figure_is_written_by_hand() {
    let prose = |text: &Prose| {
        assert!(text.is_whole(), "{}", text.template());
        figures_in(text.template())
    };
    for (entry, found) in FOUND.iter() {
        let captions = found.charts.iter().map(|chart| &chart.caption);
        let mut figures: Vec<String> = found.text.iter().chain(captions).flat_map(prose).collect();
        figures.extend(found.questions.iter().flat_map(|question| figures_in(question)));
        assert_eq!(figures, Vec::<String>::new(), "{}", entry.id);
    }
}

/// Numbers of a text that name nothing: not part of a word (`GeForce3`), and not behind `Table`, `equation` and the
/// like.
fn figures_in(text: &str) -> Vec<String> {
    const BEFORE: [&str; 7] = ["table", "figure", "equation", "section", "radeon", "step", "tables"];
    let words: Vec<&str> =
        text.split_whitespace().map(|word| word.trim_matches(|c: char| !c.is_alphanumeric())).collect();
    let is_figure = |(i, word): (usize, &&str)| {
        let bare = word.split("'").next().unwrap_or_default();
        let number = bare.starts_with(|c: char| c.is_ascii_digit()) && !bare.contains(char::is_alphabetic);
        let named = i > 0 && BEFORE.contains(&words[i - 1].to_lowercase().as_str());
        (number && !named).then(|| (*word).to_owned())
    };
    words.iter().enumerate().filter_map(is_figure).collect()
}

#[test]
fn figures_are_told_from_names() {
    assert_eq!(figures_in("a GeForce3's Table 3, equation 11, section 6.1's entry in fp32"), Vec::<String>::new());
    assert_eq!(figures_in("within 15 % of 29, or 2.5 times"), ["15", "29", "2.5"]);
}

/// Holds a file against what it should be, or writes it: as snapshots do, by `INSTA_UPDATE=always`.
fn hold(path: &str, expected: &str) {
    if writes_files() {
        std::fs::write(file(path), expected).expect("it can be written");
    }
    let found = std::fs::read_to_string(file(path)).unwrap_or_default();
    assert!(found == expected, "{path} is out of date: INSTA_UPDATE=always cargo test --test papers writes it");
}

/// The text with what stands between `<!-- reproduce: NAME -->` and `<!-- /reproduce -->` replaced by what `of` says,
/// where it says something.
fn filled(text: &str, of: impl Fn(&str) -> Option<String>) -> String {
    const END: &str = "<!-- /reproduce -->";
    let mut parts = text.split("<!-- reproduce: ");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, rest) = part.split_once(" -->").expect("the mark's end");
        let (old, rest) = rest.split_once(END).expect("an end mark for each mark");
        let new = of(name).unwrap_or_else(|| old.to_owned());
        out.push_str(&format!("<!-- reproduce: {name} -->{new}{END}{rest}"));
    }
    out
}

fn markdown(table: &Table) -> String {
    let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let rule = row(table.headings().iter().map(|_| "---".to_owned()).collect());
    let body = table.rows().iter().map(|cells| row(cells.iter().map(|cell| cell.text()).collect()));
    [row(table.shown_headings()), rule].into_iter().chain(body).collect()
}

/// Where figures are missed, calibrated ones among them: `Table 1 (2 of 6)`.
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
        places[at].2[1] += usize::from(row.verdict() != RowVerdict::Reduced);
    }
    let missed = places.iter().filter(|(.., [missed, _])| *missed > 0);
    let text = missed.map(|(paper, place, [missed, all])| format!("{paper}, {place} ({missed} of {all})"));
    text.collect::<Vec<_>>().join("; ")
}

/// Text of the book for a name: `rows ID...`, `calibrated ID...`, `table ID PLACE`, `tally`, `missed`; `None` if the
/// short form leaves one of the entries out.
fn said(name: &str) -> Option<String> {
    let words: Vec<&str> = name.split(' ').collect();
    let of = |ids: &[&str], calibrated: usize| -> Option<Table> {
        let entries: Option<Vec<_>> = ids.iter().map(|id| found(id)).collect();
        entries?;
        let of: Reproduced = FOUND.iter().filter(|(entry, _)| ids.contains(&entry.id)).cloned().collect();
        Some(tables(&of)[calibrated].clone())
    };
    let table = match words[..] {
        ["tally"] => return is_all().then(|| evidence_line(&FOUND)),
        ["missed"] => return is_all().then(missed_by_place),
        ["rows", ref ids @ ..] => of(ids, 0)?,
        ["calibrated", ref ids @ ..] => of(ids, 1)?,
        ["table", id, place] => found(id)?.tables[place.parse::<usize>().expect("a place from 0")].clone(),
        _ => panic!("unknown block `{name}`"),
    };
    Some(format!("\n\n{}\n", markdown(&table)))
}

/// The page of what works and those of the papers.
fn pages() -> Vec<String> {
    let folder = std::fs::read_dir(file("docs/papers")).expect("the papers' pages");
    let names = folder.map(|entry| entry.expect("an entry").file_name().into_string().expect("a name in ASCII"));
    let mut pages: Vec<String> =
        names.filter(|name| name.ends_with(".md")).map(|name| format!("docs/papers/{name}")).collect();
    pages.sort();
    pages.insert(0, "docs/status.md".to_owned());
    pages
}

/// The book's figures are the program's.
#[test]
fn the_book_says_what_the_program_says() {
    for path in pages() {
        let text = std::fs::read_to_string(file(&path)).expect("a page");
        assert!(text.contains("<!-- reproduce: "), "{path} has figures of the program");
        hold(&path, &filled(&text, said));
    }
}

/// No row is left out of the book: predicted ones and calibrated ones have tables of their own.
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

/// The book's charts are the program's.
#[test]
fn the_book_draws_what_the_program_draws() {
    for (id, name) in [
        ("ray-engine-tables-1-2", "ray-engine-table-2"),
        ("ray-engine-table-3", "ray-engine-host-octree"),
        ("ray-engine-table-5", "ray-engine-table-5"),
    ] {
        let chart = findings(id).charts.iter().find(|chart| chart.name == name).expect("a chart");
        hold(&format!("docs/papers/{}.svg", name.replace('-', "_")), &chart.chart.svg().expect("a drawing"));
    }
}

#[test]
fn blocks_are_filled() {
    let text = "a <!-- reproduce: tally -->old<!-- /reproduce --> b";
    assert_eq!(filled(text, |name| Some(name.to_uppercase())), text.replace("old", "TALLY"));
    assert_eq!(filled(text, |_| None), text);
    assert_eq!(number(2.5, 1), "2.5");
}
