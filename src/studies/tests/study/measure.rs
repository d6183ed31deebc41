//! Files of measured pixels.

use std::path::Path;

use crossbar_studies::study::StudyError;
use crossbar_studies::study::measure::{MeasuredCase, MeasuredPixel, parse_measurement};

fn parse(text: &str) -> Result<Vec<MeasuredCase>, StudyError> {
    parse_measurement(text.as_bytes(), Path::new("cards/m.csv"))
}

#[test]
fn pixels_are_sorted_by_case() {
    let text = "case,row,column,red,alpha\na.toml,1,2,255,\nb.toml,0,0,,3\na.toml, 0, 0, 7, 8\n";
    let cases = parse(text).expect("a table");
    let pixel = |line, place, red, alpha| MeasuredPixel { line, place, codes: [red, None, None, alpha, None] };
    let a = vec![pixel(2, [2, 1], Some(255), None), pixel(4, [0, 0], Some(7), Some(8))];
    let b = vec![pixel(3, [0, 0], None, Some(3))];
    let expected = [("cards/a.toml", a), ("cards/b.toml", b)];
    assert_eq!(cases, expected.map(|(path, pixels)| MeasuredCase { path: path.into(), pixels }));
}

/// Lines about a card, and about probes that it could not draw, as the runner writes them.
#[test]
fn remarks_are_no_pixels() {
    let text = "# card: \"R200\", 64 MB\ncase,column,row,red\n# skipped b.toml: no, or not yet\n\"a.toml\",0,0,7\n";
    let cases = parse(text).expect("a table");
    assert_eq!(cases.len(), 1);
    assert_eq!((cases[0].path.as_path(), cases[0].pixels[0].line), (Path::new("cards/a.toml"), 4));
    let wrong = parse("case,column,row,red\n# one\n\na.toml,0,0,f\n").expect_err("no table").to_string();
    assert!(wrong.starts_with("cards/m.csv:4: "), "{wrong}");
}

#[test]
fn errors_say_where_and_what() {
    let message = |text: &str| parse(text).expect_err("no table").to_string();
    insta::assert_snapshot!(
        [
            "",
            "case,column,row,red\n",
            "case,column,row,red\na.toml,0,0,\n",
            "case,column,row,red\na.toml,0,0,f\n",
            "case,column,row,red\na.toml,0\n",
            "case,column,row,hue\na.toml,0,0,1\n",
            "case,column,red\na.toml,0,1\n"
        ]
        .map(message)
        .join("\n"),
        @r"
    cards/m.csv:1: expected measured pixels, found a table without lines
    cards/m.csv:1: expected measured pixels, found a table without lines
    cards/m.csv:2: expected a measured code, found none
    cards/m.csv:2: expected a line of measured pixels: field 3: invalid digit found in string
    cards/m.csv:2: expected 4 fields, found 2
    cards/m.csv:2: expected a line of measured pixels: unknown field `hue`, expected one of `case`, `column`, `row`, `red`, `green`, `blue`, `alpha`, `depth`
    cards/m.csv:2: expected a line of measured pixels: missing field `row`
    "
    );
}

proptest::proptest! {
    /// Any text gives a table or an error.
    #[test]
    fn no_text_panics(text in "(case,column,row,red\n)?[a-z0-9,\n#\" ]{0,60}") {
        let _ = parse(&text);
    }
}
