//! Numbers, counts and names in prose, external text, digests, lines of texts, traces for viewers.

use std::borrow::Cow;

use crossbar_studies::report::digits::{Quantity, count, shown};
use crossbar_studies::report::trace::{Arrow, Slice, Trace};
use crossbar_studies::report::visible::{is_hidden, visible, visible_json, visible_line};
use crossbar_studies::report::words::{counted, listed, percent};
use crossbar_studies::report::{SourceText, sha256};
use miette::SourceCode as _;
use serde_json::Map;

#[test]
fn digits_follow_from_what_a_number_is() {
    let cases = [
        (177_693.910_2, Quantity::Measured, "177,694"),
        (99.225_1, Quantity::Measured, "99.23"),
        (0.000_123_456, Quantity::Measured, "0.0001235"),
        (1.234_56e-7, Quantity::Measured, "1.235e-7"),
        (1.234_56e17, Quantity::Measured, "1.235e17"),
        (7.0, Quantity::Measured, "7"),
        (0.805_6, Quantity::Ratio, "0.806"),
        (12.345, Quantity::Percent, "12.3"),
        (0.004_56, Quantity::Percent, "0.0046"),
        (-26.35, Quantity::Percent, "-26.4"),
        (4.6e-5, Quantity::Error, "4.60e-5"),
        (9.999_6, Quantity::Error, "10.0"),
        (527.3, Quantity::Decimals(1), "527.3"),
        (-0.04, Quantity::Decimals(1), "0.0"),
        (206_905.0, Quantity::Decimals(0), "206,905"),
        (1024.5, Quantity::Exact, "1,024.5"),
        (1.5e-7, Quantity::Exact, "1.5e-7"),
        (-1234.0, Quantity::Exact, "-1,234"),
        (0.0, Quantity::Percent, "0"),
        (f64::NEG_INFINITY, Quantity::Ratio, "-inf"),
    ];
    for (value, quantity, text) in cases {
        assert_eq!(shown(value, quantity), text, "{value:e}, {quantity:?}");
    }
    assert_eq!([0, 999, 1000, u64::MAX].map(count), ["0", "999", "1,000", "18,446,744,073,709,551,615"]);
}

#[test]
fn one_is_singular_and_nothing_else_is() {
    let leaks = |count| counted(count, "leak", "leaks");
    assert_eq!([0, 1, 2, 21].map(leaks), ["0 leaks", "1 leak", "2 leaks", "21 leaks"]);
}

#[test]
fn small_shares_keep_their_digits() {
    let texts = [0.0, 0.24639, -0.05098, 0.00963, 1.9e-7].map(percent);
    assert_eq!(texts, ["0 %", "24.6 %", "-5.1 %", "0.96 %", "1.9e-5 %"]);
}

#[test]
fn lists_end_with_and() {
    assert_eq!(listed(&[""; 0]), "");
    assert_eq!(listed(&["a"]), "a");
    assert_eq!(listed(&["a", "b", "c"]), "a, b and c");
}

#[test]
fn what_acts_is_escaped_and_what_is_seen_stays() {
    assert_eq!(visible("a\x1b[31mb\u{202e}c\nd\te"), "a\\u{1b}[31mb\\u{202e}c\nd\\te");
    assert_eq!(visible_line("a\nb\r"), "a\\nb\\r");
    for plain in ["Grüße, Größe", "\u{65e5}\u{672c}", "r0.xyz \\u{1b} 'x'", "e\u{301}", "\u{1f600}", ""] {
        assert!(matches!(visible_line(plain), Cow::Borrowed(same) if same == plain), "{plain:?}");
    }
}

#[test]
fn every_control_character_is_hidden() {
    assert!(('\0'..=char::MAX).filter(|c| c.is_control()).all(is_hidden));
}

#[test]
fn json_reads_back_to_the_same_text() {
    let said = "a\x1b\u{85}\u{202e}\u{e0041}\n\"\\";
    let document = serde_json::to_string_pretty(&[said]).expect("text");
    let shown = visible_json(&document);
    assert!(!shown.contains(|c| c != '\n' && is_hidden(c)), "{shown}");
    assert_eq!(serde_json::from_str::<Vec<String>>(&shown).expect("JSON"), [said]);
}

/// The examples of FIPS 180-2.
#[test]
fn digests_that_are_known() {
    let known = [
        ("", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"),
        ("abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"),
    ];
    for (text, digest) in known {
        assert_eq!(sha256(text.as_bytes()).expect("bytes"), digest);
    }
}

#[test]
fn places() {
    let text = SourceText::new("x", "ab\nü = 1\r\n\nend");
    assert_eq!([0, 2, 3, 4, 10, 11, 12, 15].map(|byte| text.line_of(byte)), [0, 0, 1, 1, 1, 2, 3, 3]);
    assert_eq!([0, 2, 3, 5, 6, 12, 15].map(|byte| text.column_of(byte)), [0, 2, 0, 1, 2, 0, 3]);
    assert_eq!((text.line_range(1), text.line_range(3), text.line_range(9)), (3..11, 12..15, 15..15));
    assert!(text.read_span(&(15, 1).into(), 1, 1).is_err());
    let read = |span: (usize, usize), around| {
        let contents = text.read_span(&span.into(), around, around).expect("inside");
        (String::from_utf8_lossy(contents.data()).into_owned(), contents.line(), contents.column())
    };
    assert_eq!(read((6, 1), 0), ("=".to_owned(), 1, 2));
    assert_eq!(read((6, 1), 1), ("ab\nü = 1\r\n\n".to_owned(), 0, 0));
    assert_eq!(read((15, 0), 1), ("\nend".to_owned(), 2, 0));
}

#[test]
fn a_small_trace_word_for_word() {
    let slice = |lane, name: &str, start, duration| Slice {
        lane,
        name: name.to_owned(),
        category: "work".to_owned(),
        start,
        duration,
        details: Map::new(),
    };
    let trace = Trace {
        title: "two \"units\"".to_owned(),
        lanes: vec!["host".to_owned(), "card".to_owned()],
        slices: vec![slice(1, "b", 2_500_900, 1_200), slice(0, "a", 0, 2_500_900)],
        arrows: vec![Arrow { from: (0, 2_500_900), to: (1, 2_500_900) }],
        about: Map::new(),
    };
    let mut text = Vec::new();
    trace.write(&mut text).expect("memory takes everything");
    let expected = r#"{"displayTimeUnit":"ns","otherData":{},
"traceEvents":[
{"ph":"M","name":"process_name","pid":1,"tid":0,"args":{"name":"two \"units\""}},
{"ph":"M","name":"thread_name","pid":1,"tid":1,"args":{"name":"host"}},
{"ph":"M","name":"thread_sort_index","pid":1,"tid":1,"args":{"sort_index":1}},
{"ph":"M","name":"thread_name","pid":1,"tid":2,"args":{"name":"card"}},
{"ph":"M","name":"thread_sort_index","pid":1,"tid":2,"args":{"sort_index":2}},
{"ph":"X","name":"a","cat":"work","ts":0.0,"dur":2.5,"pid":1,"tid":1,"args":{"duration_ps":2500900,"start_ps":0}},
{"ph":"X","name":"b","cat":"work","ts":2.5,"dur":0.002,"pid":1,"tid":2,"args":{"duration_ps":1200,"start_ps":2500900}},
{"ph":"s","name":"critical path","cat":"path","id":0,"ts":2.5,"pid":1,"tid":1},
{"ph":"f","name":"critical path","cat":"path","id":0,"ts":2.5,"pid":1,"tid":2,"bp":"e"}
]}
"#;
    assert_eq!(String::from_utf8(text).expect("text"), expected);
}
