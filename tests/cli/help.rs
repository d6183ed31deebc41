//! Every help text, word for word: whoever changes one sees what a user will see.

use crate::crossbar;

const COMMANDS: &str =
    "alu check compare devices diff intersect leaky-teapot radiosity render reproduce run scene timeline";

#[test]
fn program() {
    insta::assert_snapshot!(crossbar(&["--help"], "").transcript());
}

#[test]
fn commands() {
    for command in COMMANDS.split(' ') {
        insta::assert_snapshot!(command, crossbar(&[command, "--help"], "").transcript());
    }
}

#[test]
fn every_command_is_listed_here() {
    let help = crossbar(&["--help"], "").stdout;
    let listed: Vec<&str> = help
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1)
        .take_while(|line| !line.is_empty())
        // A description that runs over several lines is set further in.
        .filter(|line| !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|name| *name != "help")
        .collect();
    assert_eq!(listed.join(" "), COMMANDS);
}

#[test]
fn every_command_has_an_example_and_speaks_json() {
    for command in COMMANDS.split(' ') {
        let help = crossbar(&[command, "--help"], "").stdout;
        assert!(help.contains("Example"), "{command} shows an example");
        assert!(help.contains(&format!("crossbar {command}")), "{command}'s example can be copied");
        assert!(help.contains("--json"), "{command} speaks JSON");
    }
}

#[test]
fn version() {
    let ran = crossbar(&["--version"], "");
    assert_eq!(ran.stdout, format!("crossbar {}\n", env!("CARGO_PKG_VERSION")));
    assert_eq!(ran.code, Some(0));
}

#[test]
fn nothing_asked_for_is_a_usage_error() {
    let ran = crossbar(&[], "");
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains("Usage: crossbar"), "the usage is shown: {}", ran.stderr);
}
