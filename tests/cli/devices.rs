//! `crossbar devices`: every figure is printed with its source.

use crate::crossbar;

#[test]
fn the_text_shows_figures_and_switches() {
    let text = crossbar(&["devices", "r200"], "").stdout;
    for expected in ["ATI Radeon 8500", "limits.temporaries", "documented", "guess", "texdepth-denominator", "raw min1"]
    {
        assert!(text.contains(expected), "`{expected}` stands in\n{text}");
    }
}

#[cfg(not(feature = "wgpu"))]
#[test]
fn adapters_need_the_feature() {
    let output = crossbar(&["devices", "--adapters"], "");
    assert_eq!(output.code, Some(2));
    assert!(output.stderr.contains("--features wgpu"), "{}", output.stderr);
}

#[cfg(feature = "wgpu")]
#[test]
fn an_unknown_adapter_is_refused() {
    let mut command = std::process::Command::new(crate::program::path());
    command.args(["leaky-teapot", "--executor", "wgpu"]).env("CROSSBAR_ADAPTER", "no such card");
    let output = command.output().expect("the program under test");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && said.contains("adapter"), "{said}");
}
