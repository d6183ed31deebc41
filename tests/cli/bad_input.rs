//! Errors for programs that read them, and output that cannot be written.

use crate::crossbar;

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
    for argument in ["devices", "--help"] {
        let full = std::fs::File::create("/dev/full").expect("the device that is always full");
        let output = std::process::Command::new(crate::program::path()).arg(argument).stdout(full).output();
        let output = output.expect("the program runs to its end");
        assert_eq!(output.status.code(), Some(2), "{argument}");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(stderr.contains("standard output cannot be written"), "{stderr}");
    }
}
