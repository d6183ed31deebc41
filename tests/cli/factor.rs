//! `crossbar all-frequency factor`: its output, its files, and refusals.

use std::fs;

use serde_json::Value;

use crate::answers::refusals;

const TABLE: &str = "docs/examples/reflectance.csv";

fn document(arguments: &[&str]) -> Value {
    crate::answers::document(&[&["all-frequency", "factor"], arguments].concat())
}

/// All files exist; their contents do not depend on the number of threads.
#[test]
fn a_table_is_factored_into_files() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [one, three] = ["1", "3"].map(|threads| {
        let out = folder.path().join(threads);
        let found =
            document(&["--table", TABLE, "--terms", "4", "--threads", threads, "--out", out.to_str().expect("UTF-8")]);
        assert_eq!(found["singular_values"].as_array().map(Vec::len), Some(16));
        for (name, lines) in [("view_factors.csv", 17), ("light_factors.csv", 17), ("singular_values.csv", 17)] {
            assert_eq!(fs::read_to_string(out.join(name)).expect("written").lines().count(), lines, "{name}");
        }
        for name in
            ["index.html", "view_factors.npy", "light_factors.npy", "terms.csv", "spectrum.svg", "difference.png"]
        {
            assert!(out.join(name).is_file(), "{name}");
        }
        ["view_factors.csv", "light_factors.csv", "singular_values.csv", "terms.csv", "approximation.png"]
            .map(|name| fs::read(out.join(name)).expect("written"))
    });
    assert!(one == three);
}

/// Bad input: the messages, word for word, and nothing is written.
#[test]
fn bad_input_is_refused() {
    let line = "0.5,0.25,0.125,0\n";
    let files = [
        ("ragged.csv", format!("{line}{line}1,2,3\n{line}")),
        ("nan.csv", format!("{line}{line}{line}1,nan,0,0\n")),
        ("negative.csv", format!("{line}{line}{line}1,-2,0,0\n")),
        ("three.csv", line.repeat(3)),
        ("equal.csv", line.repeat(4)),
        ("zero.csv", "0,0,0,0\n".repeat(4)),
    ];
    let cases = [
        ("ragged", &["--table", "ragged.csv"][..]),
        ("nan", &["--table", "nan.csv"]),
        ("negative", &["--table", "negative.csv"]),
        ("not_square", &["--table", "three.csv"]),
        ("above_rank", &["--table", "equal.csv", "--terms", "2"]),
        ("above_texels", &["--brdf", "cook-torrance", "--side", "48", "--terms", "2305"]),
        ("dark", &["--table", "zero.csv"]),
        ("roughness", &["--brdf", "schlick", "--roughness", "2"]),
    ];
    insta::assert_snapshot!(refusals(&["all-frequency", "factor"], &files, &cases));
}
