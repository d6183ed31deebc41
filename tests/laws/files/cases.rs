//! The case parser: any bytes give a case or an error, and every error can be rendered.

use std::path::Path;

use crossbar::case::{self, CaseError, Setup};
use miette::{GraphicalReportHandler, GraphicalTheme};
use proptest::prelude::*;
use refsim::machine::ExecutorKind;

/// The good cases, which the mutations start from.
const CASES: [(&str, &str); 3] = [
    ("modulate", include_str!("../../../fixtures/cases/modulate.toml")),
    ("two_triangles", include_str!("../../../fixtures/cases/two_triangles.toml")),
    ("transform", include_str!("../../../fixtures/cases/transform.toml")),
];

fn folder() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/cases"))
}

/// Reads the bytes as a case; renders the error if there is one.
fn read(bytes: &[u8]) -> Option<Setup> {
    let shown = |error: CaseError| {
        let mut text = String::new();
        let handler = GraphicalReportHandler::new_themed(GraphicalTheme::none());
        handler.render_report(&mut text, &error).expect("every error can be rendered");
        assert!(!text.is_empty(), "an error has something to say");
    };
    Setup::from_bytes("case.toml", bytes, folder()).map_err(shown).ok()
}

/// Draws small cases: invalid state must come back as an error too.
fn draw(setup: &Setup) {
    if setup.size[0] * setup.size[1] <= 64 * 64 {
        case::run(setup, ExecutorKind::Scalar).ok();
    }
}

#[test]
fn the_good_cases_pass() {
    for (name, text) in CASES {
        let setup = read(text.as_bytes()).unwrap_or_else(|| panic!("{name} is a good case"));
        let outcome = case::run(&setup, ExecutorKind::Scalar).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(outcome.passed(), "{name}: {:?}", outcome.probes);
    }
}

#[test]
fn deep_nesting_does_not_overflow_the_stack() {
    for (open, close) in [("[", "]"), ("{a=", "}")] {
        let text = format!("device = {}{}", open.repeat(200_000), close.repeat(200_000));
        assert!(read(text.as_bytes()).is_none(), "no case is that deep");
        assert!(read(format!("{}\n", "a.".repeat(100_000) + "b = 1").as_bytes()).is_none(), "nor its keys");
    }
}

/// Words and numbers, some of which mean something in a case.
const PIECES: &[&str] = &[
    "0",
    "-1",
    "1e39",
    "nan",
    "-inf",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "true",
    "[]",
    "[[]]",
    "{}",
    "\"\"",
    "\"0x7fc00001\"",
    "\"rgba32f\"",
    "\"l6v5u5\"",
    "\"d32f\"",
    "\"ideal-s1.2:rtz\"",
    "\"ps_1_3\"",
    "\"vs_2_0\"",
    "\"cube\"",
    "\"volume\"",
    "\"linear\"",
    "\"automatic\"",
    "\"mirror\"",
    "\"less\"",
    "\"../..\"",
    "\"add.psa\"",
    "\"\\u0000\"",
    "[1]",
    "[0, 0]",
    "[65536, 65536]",
    "[1, 2, 3, 4, 5]",
    "\n[[texture]]\n",
    "\n[blend]\nsource = \"one\"\ndestination = \"one\"\n",
    "\n[geometry]\n",
    "é",
    "\"\"\"",
];

/// A mutation of the text at a place, given as a fraction of the text's length.
#[derive(Clone, Debug)]
enum Mutation {
    Replace(usize, u8),
    Remove(usize, usize),
    Insert(usize, usize),
    ReplaceValue(usize, usize),
    SwapLines(usize, usize),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let at = any::<usize>();
    prop_oneof![
        (at, any::<u8>()).prop_map(|(at, byte)| Mutation::Replace(at, byte)),
        (at, 1..40_usize).prop_map(|(at, length)| Mutation::Remove(at, length)),
        (at, at).prop_map(|(at, piece)| Mutation::Insert(at, piece)),
        (at, at).prop_map(|(line, piece)| Mutation::ReplaceValue(line, piece)),
        (at, at).prop_map(|(a, b)| Mutation::SwapLines(a, b)),
    ]
}

fn mutate(text: &mut Vec<u8>, mutation: &Mutation) {
    let length = text.len().max(1);
    match *mutation {
        Mutation::Replace(at, byte) => {
            if let Some(place) = text.get_mut(at % length) {
                *place = byte;
            }
        }
        Mutation::Remove(at, count) => {
            let start = (at % length).min(text.len());
            text.drain(start..(start + count).min(text.len()));
        }
        Mutation::Insert(at, piece) => {
            let start = (at % length).min(text.len());
            text.splice(start..start, PIECES[piece % PIECES.len()].bytes());
        }
        Mutation::ReplaceValue(line, piece) => {
            let mut lines: Vec<Vec<u8>> = text.split(|&b| b == b'\n').map(<[u8]>::to_vec).collect();
            let count = lines.len();
            let line = &mut lines[line % count];
            if let Some(equals) = line.iter().position(|&b| b == b'=') {
                line.truncate(equals + 1);
                line.extend(PIECES[piece % PIECES.len()].bytes());
            }
            *text = lines.join(&b'\n');
        }
        Mutation::SwapLines(a, b) => {
            let mut lines: Vec<&[u8]> = text.split(|&b| b == b'\n').collect();
            let count = lines.len();
            lines.swap(a % count, b % count);
            *text = lines.join(&b'\n');
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arbitrary_bytes_do_not_panic(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        read(&bytes);
    }

    #[test]
    fn mutated_cases_do_not_panic(
        case in 0..CASES.len(),
        mutations in proptest::collection::vec(mutation(), 1..6),
    ) {
        let mut text = CASES[case].1.as_bytes().to_vec();
        for mutation in &mutations {
            mutate(&mut text, mutation);
        }
        if let Some(setup) = read(&text) {
            draw(&setup);
        }
    }
}
