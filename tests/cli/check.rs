//! `crossbar check`: legal and illegal programs, and text that is not a program.

use std::fs;

use crate::answers::folder_with;
use crate::{ProgramOutput, crossbar_in};

/// Checks `text` as `shader.psa` in a new folder.
fn check(text: &[u8], arguments: &[&str]) -> ProgramOutput {
    crossbar_in(folder_with(&[("shader.psa", text)]).path(), &[&["check", "shader.psa"], arguments].concat(), "")
}

#[test]
fn a_legal_program() {
    let ran = check(b"ps_1_4\ntexld r0, t0\nmul r0, r0, c0\n", &["--device", "r200"]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    insta::assert_snapshot!(ran.stdout);
}

#[test]
fn all_violations_with_their_places() {
    let ran = check(b"ps_1_4\nmul r0, r0, c9\nadd r7, c0, c1\n", &["--device", "r200"]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(1), ""));
    insta::assert_snapshot!(ran.stdout);
}

#[test]
fn violations_for_machines() {
    let ran = check(b"ps_1_4\nmov r0, c9\n", &["--device", "r200", "--json"]);
    let report = ran.json();
    assert_eq!(ran.code, Some(1));
    assert_eq!(report["legal"], false);
    let violation = &report["violations"][0];
    assert_eq!(violation["rule"], "V07");
    assert_eq!(violation["key"], "limits.constants");
    assert_eq!(violation["limit"], 8);
    assert!(violation["start"].as_u64() < violation["end"].as_u64(), "{violation}");
    let ran = check(b"ps_1_4\nmov r0, c1\n", &["--device", "r200", "--json"]);
    let report = ran.json();
    assert_eq!((ran.code, &report["legal"]), (Some(0), &serde_json::Value::Bool(true)));
}

/// The runtime clamps constants outside [-1, 1]: a warning, and exit code 0.
#[test]
fn warnings() {
    let clamped = b"ps_1_4\ndef c2, -0.5, 1.25, 2, 1\nmov r0, c2\n";
    let ran = check(clamped, &["--device", "r200"]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    insta::assert_snapshot!(ran.stdout);
    let ran = check(clamped, &["--device", "r200", "--json"]);
    let report = ran.json();
    assert_eq!((ran.code, &report["legal"]), (Some(0), &serde_json::Value::Bool(true)));
    assert_eq!(report["warnings"][0]["code"], "W01");
    assert_eq!((&report["warnings"][0]["start"], &report["warnings"][0]["end"]), (&7.into(), &31.into()));
    let illegal = check(b"ps_1_4\ndef c2, 2, 0, 0, 1\nmov r0, c9\n", &["--device", "r200", "--json"]);
    let report = illegal.json();
    assert_eq!((illegal.code, &report["warnings"][0]["code"]), (Some(1), &"W01".into()));
}

/// Fog and points are not drawn; OpenGL's pixel programs can read the fog coordinate.
#[test]
fn outputs_that_change_no_pixel() {
    let vertex = "vs_1_1\ndcl_position v0\nmov oPos, v0\nmov oFog, v0.z\nmov oPts, v0.w\nmov oFog.x, v0.w\n";
    let ran = check(vertex.as_bytes(), &["--device", "r300", "--json"]);
    let report = ran.json();
    assert_eq!((ran.code, &report["legal"]), (Some(0), &serde_json::Value::Bool(true)));
    let codes: Vec<&str> =
        report["warnings"].as_array().expect("a list").iter().filter_map(|w| w["code"].as_str()).collect();
    assert_eq!(codes, ["W02", "W03"], "once each");
    let folder = tempfile::tempdir().expect("a folder for the test");
    let said = |pixel: &str| {
        let case = format!(
            "device = \"r300\"\n[vertex]\nsource = '''\n{vertex}'''\n[pixel]\nsource = '''\n{pixel}'''\n[geometry]\nprimitive = \
             \"triangles\"\nvertices = [{{ v0 = [0, 0] }}, {{ v0 = [0, 1] }}, {{ v0 = [1, 0] }}]\n[target]\nsize = [2, 2]\n\
             format = \"bgra8\"\n"
        );
        fs::write(folder.path().join("case.toml"), case).expect("a file");
        let ran = crossbar_in(folder.path(), &["run", "case.toml"], "");
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        ["W02", "W03"].map(|code| ran.stderr.contains(code))
    };
    assert_eq!(said("ps_2_0\nmov r0, c0\nmov oC0, r0\n"), [true, true]);
    assert_eq!(said("!!ARBfp1.0\nMOV result.color, fragment.fogcoord;\nEND\n"), [false, true]);
}

#[test]
fn what_is_no_program() {
    let ran = check(b"ps_1_4\nmov r0 c0 garbage\nfrobnicate r1\n", &["--device", "r200"]);
    assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""));
    insta::assert_snapshot!(ran.stderr);
}

#[test]
fn opengl_programs() {
    let nv = "!!FP1.0\nMOVX H0, f[COL0];\nADDH o[COLH], H0, f[WPOS];\nEND\n";
    let illegal = "!!FP1.0\nEX2X R40, f[TEX0].x;\nPK2H H0, R0;\nEND\n";
    let no_program = "!!ARBfp1.0\nOPTION ARB_fog_linear;\nMOV result.color, state.fog.color;\nMOVR a, b;\n";
    let ran = [
        check(nv.as_bytes(), &["--device", "nv35"]),
        check(nv.as_bytes(), &["--device", "gt200"]),
        check(illegal.as_bytes(), &["--device", "nv30"]),
        check(no_program.as_bytes(), &["--device", "r300"]),
    ];
    assert_eq!(ran.each_ref().map(|r| r.code), [Some(0), Some(1), Some(1), Some(2)]);
    insta::assert_snapshot!(ran.map(|r| r.stdout + &r.stderr).join("----\n"));
}

#[test]
fn more_slots_than_sixteen_bits_count() {
    // Each instruction takes three slots.
    let text = format!("ps_2_a\nmov r0, c0\n{}mov oC0, r0\n", "nrm r1, r0\n".repeat(30_000));
    let ran = check(text.as_bytes(), &["--device", "ideal-fp32", "--json"]);
    let report = ran.json();
    assert_eq!((ran.code, &report["arithmetic_slots"]), (Some(0), &serde_json::Value::from(90_002)));
    let ran = check(text.as_bytes(), &["--device", "ideal-fp32"]);
    assert!(ran.stdout.contains("90002 arithmetic slots"), "{}", ran.stdout);
}
