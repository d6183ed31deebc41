//! `crossbar all-frequency factor`: its output and its files.

use std::fs;

use serde_json::Value;

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
