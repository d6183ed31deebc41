//! Tables, pages, charts, pictures and texts of findings.

mod charts;
pub(crate) mod colors;
mod pages;
mod pictures;
mod tables;
mod texts;

use crossbar_studies::report::{Findings, Provenance};

fn page(mut found: Findings) -> String {
    let files = found.take_files(&Provenance::new("crossbar")).expect("all of it can be encoded");
    let (_, bytes) = files.into_iter().find(|(name, _)| name == "index.html").expect("a page");
    String::from_utf8(bytes).expect("text")
}

/// All parts of a text between `from` and `before`.
fn between<'a>(text: &'a str, from: &str, to: &str) -> impl Iterator<Item = &'a str> {
    text.split(from).skip(1).filter_map(move |rest| rest.split_once(to).map(|(inside, _)| inside))
}
