//! Costs of formats.

use std::fs;

use super::needs::Told;
use super::*;

fn load(text: &str) -> Result<FormatCosts, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("costs.csv");
    fs::write(&path, text).expect("a file");
    FormatCosts::load(&path).map_err(|error| {
        let message = error.to_string();
        message.strip_prefix(&format!("{}:", path.display())).expect("the path").to_owned()
    })
}

#[test]
fn a_format_costs_as_the_narrowest_width_that_holds_it() {
    let costs = load("bits,cost\n16,1.5\n8, 1\n32,4\n").expect("a table");
    let of = |costs: &FormatCosts| {
        ["e4m3", "s3.5", "s3.12", "e8m23"].map(|minimum| {
            let study = Precision { costs: costs.clone(), ..Told::minimum(minimum).study() };
            let document = document(&study);
            let family = if minimum.starts_with('e') { "mixed_float" } else { "mixed_fixed" };
            assert_eq!(texts(&document, family, "format"), [minimum; 2]);
            let each = column(&document, family, "cost")[0].as_f64().expect("a cost");
            assert_eq!(document["families"][0]["mixed_cost"], 2.0 * each);
            each
        })
    };
    assert_eq!(of(&costs), [1.0, 1.5, 1.5, 4.0]);
    assert_eq!(of(&FormatCosts::default()), [8.0, 9.0, 16.0, 32.0]);
}

#[test]
fn errors_say_where_and_what() {
    let error = |text: &str| load(text).expect_err("no table");
    assert_eq!(error("bits,cost\n"), "1: expected rows, found a table without");
    assert_eq!(error("bits,cost\n8,1\n"), "2: expected a row of 32 bits or more, found 8 at most");
    assert_eq!(error("bits,cost\n8,1\n8,2\n"), "3: expected each width once, found 8 again");
    assert_eq!(error("bits,cost\n8,-1\n"), "2: expected a finite cost of at least 0, found -1");
    assert!(error("bits,cost\n8,2\n32,1\n").ends_with("found 2 for 8 bits and 1 for 32"));
    assert!(error("bits,cost\n8,x\n").starts_with("2: expected a width in bits and its cost"));
    assert!(error("bits,price\n8,1\n").starts_with("2: expected a width in bits and its cost"));
}
