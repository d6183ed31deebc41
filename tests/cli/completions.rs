//! Completion scripts.

use std::process::Command;

use crate::crossbar;
use crate::help;

#[test]
fn scripts_for_five_shells_name_every_command() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let ran = crossbar(&["completions", shell], "");
        assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""), "{shell}");
        for word in help::commands().into_iter().chain(["rays-per-edge".to_owned()]) {
            assert!(ran.stdout.contains(&word), "{shell}: {word}");
        }
        let json = crossbar(&["completions", shell, "--json"], "").stdout;
        let json: serde_json::Value = serde_json::from_str(&json).expect("one JSON document");
        assert_eq!(json["script"], ran.stdout);
    }
}

/// A shell uses the completion script; `program` is the program under test.
#[cfg(target_os = "linux")]
#[test]
fn bash_completes() {
    let program = crate::program::path();
    let text = format!(
        "source <({program} completions bash); COMP_WORDS=(crossbar check x.psa --dev); COMP_CWORD=3; \
         _crossbar crossbar --dev x.psa; echo \"${{COMPREPLY[@]}}\""
    );
    let output = Command::new("bash").args(["--norc", "-c", &text]).output().expect("bash is everywhere");
    assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), "--device");
}
