use crossbar_ground::io::{NumberTable, parse_number_table};
use std::path::Path;

fn parse(text: &str) -> Result<NumberTable<f64>, String> {
    parse_number_table(text.as_bytes(), Path::new("s.csv")).map_err(|error| error.to_string())
}

#[test]
fn a_line_is_a_row() {
    let table = Ok(NumberTable { columns: 2, values: vec![1.0, 0.5, -2e3, 0.0] });
    assert_eq!(parse("1, 0.5\n-2e3,0\n"), table);
    assert_eq!(parse("\u{feff}x,y\r\n1,0.5\r\n\r\n-2e3,0"), table);
}

#[test]
fn numbers_are_rounded_once_to_the_precision_asked_for() {
    // Slightly above the middle of two f32: rounding to f64 first would give the lower one.
    let text = b"1.000000059604644775390626,0.1,1e39\n";
    let wide: NumberTable<f64> = parse_number_table(text, Path::new("s.csv")).expect("a table");
    assert_eq!(wide.values, [1.000_000_059_604_644_8, 0.1, 1e39]);
    let narrow: NumberTable = parse_number_table(&text[..30], Path::new("s.csv")).expect("a table");
    assert_eq!(narrow.values, [1.000_000_1_f32, 0.1]);
    let large = parse_number_table::<f32>(text, Path::new("s.csv")).expect_err("too large for f32").to_string();
    assert!(large.contains("too large for a 32-bit float"), "{large}");
}

#[test]
fn bad_tables_are_named() {
    let error = |text: &str| parse(text).expect_err("no table");
    assert_eq!(error(""), "s.csv: expected at least one row of numbers, found none");
    assert_eq!(error("x,y\n"), "s.csv: expected at least one row of numbers, found none");
    assert_eq!(error("x,y\n1,2\n3\n"), "s.csv:3: expected 2 numbers as in the first row, found 1 field");
    assert_eq!(error("1,2\n3,4,5\n"), "s.csv:2: expected 2 numbers as in the first row, found 3 fields");
    assert_eq!(error("1,x\n"), "s.csv:1: expected a number in field 2, found `x`");
    assert_eq!(error("1,2\n1,nan\n"), "s.csv:2: expected a finite number in field 2, found `nan`");
    assert_eq!(error("1,2\na,b\n"), "s.csv:2: expected a number in field 1, found `a`");
}
