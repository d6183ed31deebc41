//! Tables as CSV, JSON and text, and on a page.

use crossbar_studies::report::{Cell, Findings, Table, Tone};

use super::page;

fn sample() -> Table {
    let mut table = Table::new("Formats", &["format", "leaks", "error"]);
    table.push(["s3.12".into(), 12_usize.into(), 0.125.into()]);
    table.push(["fp,32".into(), 0_usize.into(), f64::INFINITY.into()]);
    table
}

#[test]
fn csv_quotes_what_needs_it() {
    assert_eq!(sample().csv().expect("a table of text"), "format,leaks,error\ns3.12,12,0.125\n\"fp,32\",0,inf\n");
}

#[test]
fn json_keeps_numbers_and_survives_infinity() {
    assert_eq!(
        sample().json().to_string(),
        r#"[{"error":0.125,"format":"s3.12","leaks":12},{"error":"inf","format":"fp,32","leaks":0}]"#
    );
}

#[test]
fn short_rows_are_filled() {
    let mut table = Table::new("t", &["a", "b"]);
    table.push(["x".into()]);
    assert_eq!(table.rows()[0], [Cell::Text("x".to_owned()), Cell::Empty]);
}

#[test]
fn marks_are_named_in_json_and_stand_behind_numbers() {
    let mut table = Table::of("t", "what ours");
    table.push(["a".into(), Cell::percent(23.456).marked("*")]);
    assert_eq!(table.rows()[0][1].text(), "23.5 *");
    assert_eq!(table.json().to_string(), r#"[{"marked":["ours"],"ours":23.456,"what":"a"}]"#);
    table.push(["b".into(), Cell::percent(1.5)]);
    assert_eq!(table.csv().expect("text"), "what,ours,marked\na,23.456,ours\nb,1.5,\n");
}

#[test]
fn columns_have_names_for_programs() {
    let headings = ["bandwidth_used_%", "of the signal (%)", "MFLOP/s_of_Gauss-Seidel", "sc+rec", "%", "rms_255ths"];
    let keys = ["bandwidth_used_percent", "of_the_signal_percent", "MFLOP_s_of_Gauss_Seidel", "sc_rec", "percent"];
    assert_eq!(Table::new("t", &headings).keys()[..5], keys);
    assert_eq!(Table::new("t", &headings).keys()[5], headings[5]);
}

#[test]
fn parts_of_a_table_repeat_the_columns_that_tell_rows_apart() {
    let mut table = Table::of("t", "way switch value rounds largest_relative_error");
    for (way, switch, rounds) in [("fp16", "rounding", 1.5), ("fp16", "dot_order", 2.5), ("fp32", "rounding", 3.5)] {
        table.push([way.into(), switch.into(), "1".into(), rounds.into(), 1e-9.into()]);
    }
    let text = table.text_within(44);
    let (first, second) = text.split_once("\n\n").expect("two parts");
    for part in [first, second] {
        assert!(part.lines().any(|line| line.contains("fp16") && line.contains("dot_order")), "{text}");
    }
    assert!(!second.contains("value"), "{text}");
}

/// A page with one table; a row whose verdict is `missed` counts as undesirable.
fn page_of(table: Table) -> String {
    let mut found = Findings::new("t");
    found.tally(1, ["missed", "missed"], Tone::Bad);
    found.table(table);
    page(found)
}

#[test]
fn verdicts_stand_second_and_rows_have_links() {
    let mut table = Table::of("Rows", "what paper ours verdict");
    table.push_named("figure-7.1".to_owned(), ["rate".into(), 1.0.into(), 2.0.into(), "missed".into()]);
    table.push(["other".into(), 3.0.into(), 4.0.into(), "unknown".into()]);
    let html = page_of(table);
    let after = |text: &str| html.find(text).unwrap_or_else(|| panic!("{text} in {html}"));
    let headings = ["what", "verdict", "paper", "ours"].map(|name| after(&format!("<th scope=\"col\">{name}</th>")));
    assert!(headings.is_sorted());
    let row = "<tr id=\"figure-7.1\" class=\"bad\"><th scope=\"row\">rate <a class=\"anchor\" href=\"#figure-7.1\"";
    assert!(after(row) < after("<td class=\"said\">missed</td><td class=\"number\">1</td>"));
    assert!(html.contains("<tr><th scope=\"row\">other</th>"), "a row without name or known verdict: {html}");
}
