use crossbar_ground::io::{CoordinateMatrix, parse_matrix_market, write_matrix_market};
use std::path::Path;

fn parse(text: &str) -> Result<CoordinateMatrix, String> {
    parse_matrix_market(text.as_bytes(), Path::new("t.mtx")).map_err(|error| error.to_string())
}

#[test]
fn what_is_written_is_read() {
    let entries = vec![(0, 2, 0.25), (1, 0, -1.0), (1, 1, 5e-324)];
    let mut text = Vec::new();
    let places = entries.iter().map(|&(row, column, value)| (row as usize, column as usize, value));
    write_matrix_market([2, 3, 3], "a comment\nof two lines", places, &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains("% of two lines\n2 3 3\n1 3 0.25\n") && text.ends_with("2 2 5e-324\n"));
    assert_eq!(parse(&text), Ok(CoordinateMatrix { rows: 2, columns: 3, entries }));
}

#[test]
fn whole_numbers_and_other_line_ends_are_read() {
    let text = "\u{feff}%%matrixmarket MATRIX coordinate integer general\r\n2 2 2\r\n\r\n2 1 3\r\n1 2 -4\r\n";
    for text in [text.to_owned(), text.replace("\r\n", "\r")] {
        assert_eq!(parse(&text).expect("a matrix").entries, [(0, 1, -4.0), (1, 0, 3.0)]);
    }
}

#[test]
fn what_is_no_matrix_is_refused() {
    let real = |rest: &str| parse(&format!("%%MatrixMarket matrix coordinate real general\n{rest}")).unwrap_err();
    assert!(parse("").unwrap_err().starts_with("t.mtx:1: expected `%%MatrixMarket"));
    for other in ["array real general", "coordinate pattern general", "coordinate real symmetric"] {
        assert!(parse(&format!("%%MatrixMarket matrix {other}\n1 1 1\n1 1 2\n")).is_err(), "{other}");
    }
    for text in ["% nothing", "0 1 0"] {
        assert!(real(text).starts_with("t.mtx:2: expected the numbers of rows, columns and entries, "), "{text}");
    }
    for entry in ["3 1 1", "1 0 1", "1 1"] {
        assert!(real(&format!("2 2 1\n{entry}")).starts_with("t.mtx:3: expected "), "{entry}");
    }
    for (value, expected) in [
        ("NaN", "a finite number"),
        ("-1e400", "a number that is not too large for a 64-bit float"),
        ("-1e-400", "a number that a 64-bit float does not round to 0"),
    ] {
        assert_eq!(real(&format!("2 2 1\n1 1 {value}")), format!("t.mtx:3: expected {expected}, found `{value}`"));
    }
    let zero = parse("%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 -0.0e5\n");
    assert_eq!(zero.expect("a zero with its sign").entries, [(0, 0, 0.0)]);
    let claim = "t.mtx:2: expected at most 16777216 rows and columns in a file of 66 bytes, found 4294967295 x 1";
    assert_eq!(real("4294967295 1 1\n1 1 1"), claim);
    assert_eq!(real("2 2 2\n1 1 1"), "t.mtx: expected 2 entries as line 2 says, found 1");
    assert_eq!(real("2 2 2\n1 2 1\n1 2 3"), "t.mtx: expected one entry for row 1, column 2, found two");
    assert_eq!(real("2 2 99999999999999\n1 1 1"), "t.mtx: expected 99999999999999 entries as line 2 says, found 1");
}
