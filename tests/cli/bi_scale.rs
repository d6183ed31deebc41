//! `crossbar prt` on bi-scale transfer, from the command line.

use std::fs;

use approx::assert_relative_eq;
use serde_json::Value;

use crate::crossbar;
use crate::prt::{number, place};

const STEP: &str = "docs/examples/step.obj";
const BICLUSTERS: &str = "docs/examples/step_biclusters.prt";

fn document(arguments: &str) -> Value {
    let arguments: Vec<&str> = arguments.split(' ').chain(["--json"]).collect();
    let ran = crossbar(&arguments, "");
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""), "{arguments:?}");
    serde_json::from_str(&ran.stdout).expect("one JSON document")
}

/// Red, green and blue of each row.
fn values(path: &str) -> Vec<[f64; 3]> {
    let text = fs::read_to_string(path).expect("written");
    let row = |line: &str| {
        let fields: Vec<f64> = line.split(',').map(|field| field.parse().expect("a number")).collect();
        *fields.last_chunk().expect("three channels")
    };
    text.lines().skip(1).map(row).collect()
}

/// From the model to the light in its local directions: by rows, by the same from text, by biclusters; the same bits in
/// any number of threads.
#[test]
fn light_takes_every_way() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [matrix, text, biclusters] = ["t.prt", "t.mtx", "b.prt"].map(|name| place(folder.path(), name));
    let mut before: Option<Vec<Vec<u8>>> = None;
    for threads in [1, 3] {
        let options = format!("--kind bi-scale --matrix {text} --out {matrix} --threads {threads}");
        let made = document(&format!("prt precompute {STEP} {options}"));
        assert_eq!((&made["rows"], &made["columns"]), (&Value::from(70 * 64), &Value::from(6144)));
        let found = document(&format!("prt bicluster {matrix} --out {biclusters} --threads {threads}"));
        assert_eq!((&found["residual"], &found["nonzeros"]), (&Value::from(0), &made["nonzeros"]));
        assert!(10.0 * number(&found["flops_after"]) < number(&found["flops_before"]), "flat steps are coherent");
        let counts = found["values"].as_array().expect("a histogram");
        assert_eq!(counts.iter().map(|value| number(&value["count"])).sum::<f64>(), number(&made["nonzeros"]));
        assert!(counts.iter().all(|value| (4.0 * number(&value["value"])).fract() == 0.0), "quarters");
        let files = [&matrix, &text, &biclusters].map(|path| fs::read(path).expect("written")).to_vec();
        assert!(before.get_or_insert_with(|| files.clone()) == &files, "{threads} threads");
    }
    if std::env::var_os("CROSSBAR_BLESS").is_some() {
        fs::copy(&biclusters, BICLUSTERS).expect("written");
    }
    assert!(fs::read(&biclusters).expect("written") == fs::read(BICLUSTERS).expect("an example"), "CROSSBAR_BLESS=1");
    let product = |file: &str| {
        let out = place(folder.path(), "y.csv");
        let said = document(&format!("prt multiply {file} --light sky:1,-1,1 --rotate 30 --values {out}"));
        (said["way"].as_str().expect("a word").to_owned(), values(&out))
    };
    let [(rows, expected), (from_text, same), (by_biclusters, found)] =
        [&matrix, &text, &biclusters].map(|f| product(f));
    assert_eq!([rows, from_text, by_biclusters], ["rows", "rows", "biclusters"]);
    assert_eq!((&expected, expected.len()), (&same, 70 * 64));
    for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
        assert_relative_eq!(found, expected, max_relative = 1e-5, epsilon = 1e-7);
    }
}

/// Every line of the table is a bicluster, and their costs are what the summary says.
#[test]
fn biclusters_are_dumped() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let dump = place(folder.path(), "b.csv");
    for options in ["--seed 3", "--no-deletion"] {
        let found = document(&format!("prt bicluster docs/examples/quarters.mtx {options} --dump {dump}"));
        let text = fs::read_to_string(&dump).expect("written");
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("bicluster,cost,rows,columns,values"));
        let mut costs = 0.0;
        for (number, line) in lines.enumerate() {
            let fields: Vec<&str> = line.split(',').collect();
            let [rows, columns, values] = [2, 3, 4].map(|at| fields[at].split(' ').count());
            assert_eq!((fields[0], values), (number.to_string().as_str(), columns));
            let cost: usize = fields[1].parse().expect("a number");
            assert_eq!(cost, rows + 2 * columns - 1);
            costs += cost as f64;
        }
        assert_eq!(costs, number(&found["flops_after"]));
        assert!(costs < number(&found["flops_before"]));
    }
}

#[test]
fn what_is_lost_is_told() {
    let exact = document("prt bicluster docs/examples/quarters.mtx");
    assert_eq!((&exact["residual"], &exact["largest_residual"]), (&Value::from(0), &Value::from(0.0)));
    let [quarter, half] =
        ["0.25", "0.5"].map(|drop| document(&format!("prt bicluster docs/examples/quarters.mtx --drop {drop}")));
    assert_eq!(([&quarter, &half].map(|found| number(&found["largest_residual"]))), [0.25, 0.5]);
    let cost = |found: &Value| number(&found["flops_after"]);
    assert!(cost(&half) < cost(&quarter) && cost(&quarter) < cost(&exact));
    assert!(number(&quarter["squared_residual"]) < number(&half["squared_residual"]));
}

#[test]
fn what_cannot_be_done_is_said() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let tenths = place(folder.path(), "tenths.mtx");
    fs::write(&tenths, "%%MatrixMarket matrix coordinate real general\n1 2 1\n1 1 0.1\n").expect("written");
    for (arguments, said) in [
        ("prt multiply docs/examples/quarters.mtx".to_owned(), "expected a matrix of 6144 columns, found 32"),
        (format!("prt bicluster {BICLUSTERS}"), "expected a matrix, found biclusters alone"),
        (format!("prt bicluster {tenths}"), "expected multiples of 2^-30 in row 0, column 0"),
        ("prt bicluster docs/examples/step.prt".to_owned(), "conventions: expected 3 to 3, found 1"),
        ("prt compare docs/examples/quarters.mtx".to_owned(), "found 32"),
        (format!("prt compare {BICLUSTERS} --model cornell-box"), "expected transfer of"),
        ("prt compare docs/examples/quarters.mtx --model cornell-box".to_owned(), "found a matrix of no known one"),
        (format!("prt compare {BICLUSTERS} --sample 3"), "expected at least 32 rows to find 32 clusters from, found 3"),
        (format!("prt compare {BICLUSTERS} --memory-limit 1MB"), "of memory"),
        ("prt multiply docs/examples/step_all.prt".to_owned(), "conventions: expected 3 to 3, found 2"),
    ] {
        let ran = crossbar(&arguments.split(' ').collect::<Vec<_>>(), "");
        assert_eq!(ran.code, Some(2), "{}", ran.transcript());
        // Messages are wrapped.
        let words = ran.stderr.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ");
        assert!(words.contains(said), "{}", ran.transcript());
    }
}

/// Every way with its bytes and its error; what loses nothing has none, and what takes part in frames needs the model.
#[test]
fn ways_to_store_transfer_are_compared() {
    let small = "--clusters 4 --vectors 2 --sample 300 --rounds 2";
    let alone = document(&format!("prt compare {BICLUSTERS} {small}"));
    let all = document(&format!("prt compare {BICLUSTERS} {small} --model {STEP} --linear --order 3"));
    let ways = |found: &Value| found["ways"].as_array().expect("a list").clone();
    assert_eq!(ways(&all).len(), ways(&alone).len() + 3);
    for found in [&alone, &all] {
        let nonzeros = number(&found["nonzeros"]);
        for way in ways(found) {
            let name = way["way"].as_str().expect("a name");
            let [rms, largest, relative] = ["rms", "largest", "relative"].map(|field| number(&way[field]));
            let bytes = number(&way["bytes"][0]["bytes"]);
            match name {
                "rows of 3 bytes an entry" => assert_eq!(bytes, 3.0 * nonzeros + 4.0 * (70.0 * 64.0 + 1.0)),
                "rows of 8 bytes an entry" => assert_eq!(bytes, 8.0 * nonzeros + 4.0 * (70.0 * 64.0 + 1.0)),
                "biclusters" => assert!(bytes < nonzeros, "flat steps are coherent"),
                _ => assert!(relative > 1e-4 && largest >= rms && rms > 0.0, "{way}"),
            }
            if name.starts_with("rows") || name == "biclusters" {
                assert!(relative < 1e-12, "{way}");
            }
        }
    }
}
