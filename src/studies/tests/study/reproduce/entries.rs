//! Entries are chosen by their names, and by the names of papers.

use std::collections::BTreeSet;

use crossbar_studies::study::reproduce::{ENTRIES, Paper, choose};
use strum::VariantArray as _;

fn chosen(wanted: &[&str]) -> Vec<&'static str> {
    let wanted: Vec<String> = wanted.iter().map(|&name| name.to_owned()).collect();
    choose(&wanted).expect("names").iter().map(|entry| entry.id).collect()
}

/// A paper's name chooses its entries: those whose names begin with it.
#[test]
fn papers_and_entries_are_chosen_by_name() {
    for paper in Paper::VARIANTS {
        let entries = chosen(&[paper.id()]);
        let begin = format!("{}-", paper.id());
        let named: Vec<&str> = ENTRIES.iter().map(|entry| entry.id).filter(|id| id.starts_with(&begin)).collect();
        assert!(!entries.is_empty());
        assert_eq!(entries, named);
    }
    assert_eq!(chosen(&[]).len(), ENTRIES.iter().map(|entry| entry.id).collect::<BTreeSet<_>>().len());
    let both = chosen(&["ray-engine-figure-7", "radiosity", "radiosity-rates"]);
    assert_eq!(both, ["ray-engine-figure-7", "radiosity-figure-3", "radiosity-rates", "radiosity-figure-4"]);
    let error = choose(&["figure-7".to_owned()]).expect_err("no such name").to_string();
    assert!(error.contains("found `figure-7`"), "{error}");
}
