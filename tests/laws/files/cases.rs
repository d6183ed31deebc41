//! The case parser: any bytes yield a case or an error, and every error can be rendered.

use std::path::Path;

use crossbar::case::{self, CaseError, Setup};
use miette::{GraphicalReportHandler, GraphicalTheme};
use proptest::prelude::*;
use proptest::sample::Index;
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

/// Draws the case if it is small: drawing must report invalid state as an error, too.
fn draw(setup: &Setup) {
    if setup.size[0] * setup.size[1] <= 64 * 64 {
        case::run(setup, ExecutorKind::Scalar).ok();
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

/// Words and numbers, some with a meaning in a case.
const WORDS: &str = r#"0 -1 1e39 nan -inf 4294967295 4294967296 9223372036854775807 true [] [[]] {} """ "" "0x7fc00001"
"rgba32f" "l6v5u5" "d32f" "ideal-s1.2:rtz" "ps_1_3" "vs_2_0" "cube" "volume" "linear" "automatic" "mirror" "less"
"../.." "add.psa" "\u0000" [1] [0,0] [65536,65536] [1,2,3,4,5] é"#;
const TABLES: [&str; 3] = ["\n[[texture]]\n", "\n[blend]\nsource = \"one\"\ndestination = \"one\"\n", "\n[geometry]\n"];

/// A good case with bytes replaced or removed, words inserted or in place of values, or lines exchanged.
fn mutated() -> impl Strategy<Value = Vec<u8>> {
    let pieces: Vec<&str> = WORDS.split_whitespace().chain(TABLES).collect();
    let edit = (0..5_u8, any::<[Index; 2]>(), prop::sample::select(pieces));
    (prop::sample::select(&CASES[..]), prop::collection::vec(edit, 1..6)).prop_map(|((_, good), edits)| {
        let mut text = good.as_bytes().to_vec();
        for (kind, [at, other], piece) in edits {
            let length = text.len();
            let place = at.index(length + 1);
            let until = |count: usize| place..(place + count).min(length);
            match kind {
                0 => drop(text.splice(until(1), [other.index(256) as u8])),
                1 => drop(text.drain(until(1 + other.index(40)))),
                2 => drop(text.splice(place..place, piece.bytes())),
                _ => {
                    let mut lines: Vec<Vec<u8>> = text.split(|&b| b == b'\n').map(<[u8]>::to_vec).collect();
                    let [line, other] = [at, other].map(|at| at.index(lines.len()));
                    if kind == 3 {
                        lines.swap(line, other);
                    } else if let Some(equals) = lines[line].iter().position(|&b| b == b'=') {
                        lines[line].truncate(equals + 1);
                        lines[line].extend(piece.bytes());
                    }
                    text = lines.join(&b'\n');
                }
            }
        }
        text
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_cases_do_not_panic(text in mutated()) {
        if let Some(setup) = read(&text) {
            draw(&setup);
        }
    }

    #[test]
    fn arbitrary_bytes_do_not_panic(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        read(&bytes);
    }
}
