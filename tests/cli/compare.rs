//! `crossbar compare` and `crossbar run --trace`: equal sides, differences derived by hand.

use serde_json::{Value, json};

use crate::answers::{folder_with, listed};
use crate::{ProgramOutput, case::CASES, case::example, crossbar_in};

/// Runs the program on `text` as `case.toml` in a new folder.
fn on(text: &str, arguments: &[&str]) -> ProgramOutput {
    crossbar_in(folder_with(&[("case.toml", text)]).path(), arguments, "")
}

/// The JSON report of a comparison that finds a difference.
fn difference(text: &str, arguments: &[&str]) -> Value {
    let ran = on(text, &[&["compare", "case.toml", "--json"], arguments].concat());
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(1), ""), "{}", ran.stdout);
    let report = ran.json();
    assert_eq!(report["equal"], false);
    report["first"].clone()
}

#[test]
fn both_executors_are_equal_on_every_example() {
    for name in CASES.iter() {
        for scope in [&[][..], &["--registers"], &["--pixel", "1,1"]] {
            let folder = tempfile::tempdir().expect("a folder for the test");
            let ran = crossbar_in(folder.path(), &[&["compare", &example(name)], scope].concat(), "");
            assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""), "{name}: {}", ran.stdout);
            assert!(ran.stdout.contains("\nequal: every stored bit of "), "{name}: {}", ran.stdout);
        }
    }
}

#[test]
fn two_formats_of_an_example() {
    let ran = crossbar_in(&fixtures(), &["compare", "transform.toml", "--right-format", "fp32"], "");
    assert_eq!(ran.code, Some(1));
    insta::assert_snapshot!(ran.transcript());
}

fn fixtures() -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/cases")
}

/// A pixel program on a 4x4 single-precision target; tests replace parts of it.
const PLAIN: &str = r#"title = "plain"
shader_model = "ps_2_a"
format = "fp32"
[pixel]
source = """
ps_2_a
dcl t0
PROGRAM
"""
[constants]
c0 = [0.1, 0.1, 0.1, 0.1]
[geometry]
full_screen = true
attributes = { }
[target]
size = [4, 4]
format = "rgba32f"
"#;

const TWO_ROUNDINGS: &str = include_str!("two_roundings.toml");

/// 1.5 units in the last place of s3.12 are a tie: 2 rounded to even, 1 toward zero.
#[test]
fn two_roundings() {
    let first = difference(TWO_ROUNDINGS, &["--right-format", "s3.12:rtz"]);
    assert_eq!(first["draw"], json!({ "index": 0, "name": "case" }));
    assert_eq!(first["pixel"], json!([0, 0]));
    let found = &first["difference"];
    assert_eq!(found["stage"], "instruction");
    assert_eq!(found["pass"], json!({ "index": 0, "instance": 0, "triangle": 0, "part": 0 }));
    assert_eq!(found["instruction"]["index"], 1);
    assert_eq!(found["instruction"]["source"]["line"], 3);
    assert_eq!(found["instruction"]["source"]["text"], "mul r0, r1, c1");
    assert_eq!(
        found["values"],
        json!([{ "name": "r0.y", "left": "0.00048828125", "left_bits": "0x0002", "right": "0.000244140625", "right_bits": "0x0001",
            "ulps": 1.0, "unit": "s3.12" }])
    );
    assert!(
        found["operands"].as_array().is_some_and(|all| all.len() == 2 && all.iter().all(|o| o["differs"] == false))
    );
}

#[test]
fn a_device_without_a_switch_of_the_case() {
    let ran = crossbar_in(&fixtures(), &["compare", "modulate.toml", "--right-device", "r300"], "");
    insta::assert_snapshot!(ran.transcript());
}

#[test]
fn a_trace() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let arguments = ["run", &example("two_triangles"), "--trace", "7,4", "--out", "out"];
    let ran = crossbar_in(folder.path(), &arguments, "");
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    let (_, trace) = ran.stdout.split_once("failed\n\n").expect("the trace comes last");
    insta::assert_snapshot!(trace);
}

/// 2 * 0.7 in s3.12: 0.7 is 2867 / 4096, and doubled 5734 / 4096; c1 is an eighth, and the product, 716.75 / 4096,
/// rounds to 717 / 4096.
#[test]
fn a_trace_for_machines() {
    let text = r#"shader_model = "ps_1_4"
format = "s3.12"
[pixel]
source = "ps_1_4\nmov_x2 r0.rgb, c0\n+mov r0.a, c1\nmul r0, r0, c1"
[constants]
c0 = [0.7, 0.7, 0.7, 1]
c1 = [0.125, 0.125, 0.125, 0.125]
[geometry]
full_screen = true
[target]
size = [2, 2]
format = "rgba16f"
"#;
    let trace = |executor: &str| {
        let ran = on(text, &["run", "case.toml", "--trace", "1,0", "--json", "--executor", executor]);
        assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
        let report = ran.json();
        report["trace"].clone()
    };
    let scalar = trace("scalar");
    let steps = scalar["passes"][0]["steps"].as_array().cloned().unwrap_or_default();
    assert_eq!(steps.len(), 3);
    assert_eq!((&steps[0]["mask"], &steps[0]["register"]), (&json!("xyz"), &json!("r0")));
    assert_eq!(steps[0]["written"][0], json!({ "name": "r0.x", "value": "1.39990234375", "bits": "0x1666" }));
    assert_eq!(
        steps[1]["source"],
        json!({ "file": "case.toml [pixel]", "line": 3, "column": 1, "text": "+mov r0.a, c1" })
    );
    assert_eq!((&steps[2]["written"][0]["bits"], &steps[2]["flags"]), (&json!("0x02cd"), &json!(["inexact"])));
    assert_eq!(trace("batch"), scalar, "the batch executor's pixels are followed by the scalar one");
}

#[test]
fn nothing_to_trace() {
    let text = PLAIN.replace("PROGRAM", "mov r0, c0\nmov oC0, r0").replace("size = [4, 4]", "size = [64, 64]");
    let corner = "vertices = [{ position = [-1, 1] }, { position = [-0.9, 1] }, { position = [-1, 0.9] }]";
    let text = text.replace("full_screen = true\nattributes = { }", corner);
    let said = listed([("near", "5,4"), ("far", "60,60"), ("outside", "64,0")].map(|(name, pixel)| {
        let ran = on(&text, &["run", "case.toml", "--trace", pixel]);
        assert_eq!(ran.code, Some(if name == "outside" { 2 } else { 0 }), "{}", ran.stderr);
        (name, ran.transcript())
    }));
    insta::assert_snapshot!(said);
}
