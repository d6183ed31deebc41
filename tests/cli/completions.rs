//! Completions, asked as the scripts of shells ask, and by the shells themselves.

use std::path::Path;
use std::process::Command;

use crate::crossbar;
use crate::help::COMMANDS;

/// Completions of the last of some words after `crossbar`, a line each.
pub(crate) fn completed(words: &[&str]) -> String {
    let output = Command::new(crate::program::path())
        .env("CROSSBAR_COMPLETE", "bash")
        .env("_CLAP_COMPLETE_INDEX", words.len().to_string())
        .env("_CLAP_IFS", "\n")
        .args(["--", "crossbar"])
        .args(words)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("the program that this test was built with");
    assert!(output.status.success() && output.stderr.is_empty(), "{words:?}: {output:?}");
    String::from_utf8(output.stdout).expect("the program writes text")
}

#[test]
fn every_command_and_its_options_are_completed() {
    let commands = completed(&[""]);
    for command in COMMANDS.split(' ') {
        assert!(commands.lines().any(|line| line == command), "{command}: {commands}");
    }
    assert_eq!(completed(&["leaky-teapot", "--rays-per"]), "--rays-per-edge");
    assert_eq!(completed(&["cpca", "comp"]), "compress");
}

#[test]
fn names_are_completed() {
    for (words, expected) in [
        ("check x.psa --device nv3", "nv30 nv35"),
        ("devices r2", "r200"),
        ("compare x.toml --left-device ideal-fp3", "ideal-fp32"),
        ("compare x.toml --right-format fp", "fp16 fp24 fp32"),
        ("check x.psa --device r200 --switch dot=t", "dot=tree"),
        ("subsurface x.obj --material mar", "marble"),
        ("materials Ske", ""),
        ("scene corn", "cornell-box cornell-room cornell-room-blocks"),
        ("render office", "office office-floor"),
        ("reproduce cpca-table", "cpca-table-1"),
        ("reproduce equation-11 figure-7", "figure-7"),
        ("render office --renderer ph", "photon"),
    ] {
        let words: Vec<&str> = words.split(' ').collect();
        assert_eq!(completed(&words).lines().collect::<Vec<_>>().join(" "), expected, "{words:?}");
    }
}

/// Models are names or files.
#[test]
fn names_do_not_hide_files() {
    let models = completed(&["atlas", "docs/examples/te"]);
    assert_eq!(models, "docs/examples/teapot.obj");
    assert!(completed(&["atlas", ""]).lines().any(|line| line == "stand-in-bunny"));
}

/// Runs a text in a shell that finds the program; `None` if the shell is not installed, which CI does not allow.
#[expect(clippy::print_stderr, reason = "says that a test does not run")]
fn in_shell(shell: &str, options: &[&str], text: &str) -> Option<String> {
    let program = Path::new(crate::program::path()).parent().expect("the program lies in a folder");
    let path = std::env::var("PATH").unwrap_or_default();
    let mut command = Command::new(shell);
    command.args(options).args(["-c", text]).env("PATH", format!("{}:{path}", program.display()));
    match command.output() {
        Ok(output) => Some(String::from_utf8_lossy(&output.stdout).trim().to_owned()),
        Err(error) if std::env::var_os("CI").is_none() => {
            eprintln!("{shell} is not there ({error}): its script is not tested");
            None
        }
        Err(error) => panic!("{shell}: {error}"),
    }
}

#[cfg(target_os = "linux")]
#[test]
fn bash_completes() {
    let text = "source <(crossbar completions bash); COMP_WORDS=(crossbar check x.psa --device nv3); COMP_CWORD=4; \
                COMP_TYPE=9; _clap_complete_crossbar crossbar nv3 --device; echo \"${COMPREPLY[@]}\"";
    assert_eq!(in_shell("bash", &["--norc"], text).expect("bash is everywhere"), "nv30 nv35");
}

#[cfg(target_os = "linux")]
#[test]
fn zsh_completes() {
    // Outside of its line editor zsh has neither of the two functions.
    let text = "compdef() { : }; _describe() { print -l ${(P)3} }; source <(crossbar completions zsh); \
                words=(crossbar check x.psa --device nv3); CURRENT=5; _clap_dynamic_completer_crossbar";
    if let Some(found) = in_shell("zsh", &["--no-rcs"], text) {
        assert_eq!(found.lines().collect::<Vec<_>>(), ["nv30", "nv35"]);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn fish_completes() {
    let text = "crossbar completions fish | source; complete -C 'crossbar check x.psa --device nv3'";
    if let Some(found) = in_shell("fish", &["--no-config"], text) {
        assert_eq!(found.lines().collect::<Vec<_>>(), ["nv30", "nv35"]);
    }
}

#[test]
fn scripts_for_five_shells() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let ran = crossbar(&["completions", shell], "");
        assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""), "{shell}");
        assert!(ran.stdout.contains("CROSSBAR_COMPLETE"), "{shell}: {}", ran.stdout);
        let json = crossbar(&["completions", shell, "--json"], "").stdout;
        let json: serde_json::Value = serde_json::from_str(&json).expect("one JSON document");
        assert_eq!(json["script"], ran.stdout);
    }
    assert_eq!(crossbar(&["completions", "abacus"], "").code, Some(2));
}
