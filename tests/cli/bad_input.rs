//! Bad input: one clear error, exit code 2, nothing half-written.

use crate::answers::listed;
use crate::{ProgramOutput, crossbar, crossbar_in};

/// Runs in an empty folder, which must stay empty, and expects a single error.
fn refused(arguments: &[&str], input: &str) -> ProgramOutput {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let ran = crossbar_in(folder.path(), arguments, input);
    assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""), "{arguments:?}: {}", ran.stderr);
    assert!(!ran.stderr.contains("panicked"), "{arguments:?}: {}", ran.stderr);
    let errors = ran.stderr.lines().filter(|line| line.to_lowercase().starts_with("error:")).count();
    assert_eq!(errors, 1, "{arguments:?}: one error, not {errors}:\n{}", ran.stderr);
    let left = std::fs::read_dir(folder.path()).expect("the folder of the test").count();
    assert_eq!(left, 0, "{arguments:?} left something behind");
    ran
}

#[test]
fn messages() {
    let cases: [(&str, &[&str], &str); 5] = [
        ("bad_format", &["alu", "add", "--format", "fp17"], ""),
        ("convert_without_to", &["alu", "convert", "--format", "fp16"], ""),
        ("unknown_device", &["devices", "r2000"], ""),
        ("bad_ideal_format", &["devices", "ideal-fp17"], ""),
        ("bad_hex", &["alu", "sqrt", "--format", "fp16"], "0x3C00\n"),
    ];
    let said = listed(cases.map(|(name, arguments, input)| (name, refused(arguments, input).stderr)));
    insta::assert_snapshot!(said);
}

#[test]
fn errors_for_machines() {
    let ran = crossbar(&["alu", "sqrt", "--format", "fp16", "--json"], "nonsense\n");
    let error: serde_json::Value = serde_json::from_str(&ran.stderr).expect("one JSON document");
    assert_eq!(error["code"], "crossbar::alu::hex");
    assert_eq!(error["severity"], "error");
    assert_eq!(ran.code, Some(2));
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk() {
    let full = std::fs::File::create("/dev/full").expect("the device that is always full");
    let output = std::process::Command::new(crate::program::path())
        .arg("devices")
        .stdout(full)
        .output()
        .expect("the program runs to its end");
    assert_eq!(output.status.code(), Some(2));
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(stderr.contains("standard output cannot be written"), "{stderr}");
}
