//! Every help text, word for word: whoever changes one sees what a user will see.

use crate::{crossbar, tree};

/// All commands, in the order of the help.
pub(crate) const COMMANDS: &str = "all-frequency alu atlas bi-scale check compare completions cpca devices diff \
                        intersect leaky-teapot man materials measure merge page precision radiosity render reproduce \
                        run scene subsurface timeline";

/// The verbs of the commands that have some.
fn verbs() -> Vec<String> {
    tree::commands().into_iter().map(|(name, _)| name).filter(|name| name.contains(' ')).collect()
}

/// Commands and verbs.
pub(crate) fn names() -> Vec<String> {
    COMMANDS.split(' ').map(str::to_owned).chain(verbs()).collect()
}

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
fn verbs_of_commands() {
    for verb in verbs() {
        let arguments: Vec<&str> = verb.split(' ').chain(["--help"]).collect();
        insta::assert_snapshot!(verb.replace(' ', "_"), crossbar(&arguments, "").transcript());
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
    for command in names() {
        let help = crossbar(&command.split(' ').chain(["--help"]).collect::<Vec<_>>(), "").stdout;
        assert!(help.contains("Example"), "{command} shows an example");
        assert!(help.contains(&format!("crossbar {command}")), "{command}'s example can be copied");
        assert!(help.contains("--json"), "{command} speaks JSON");
    }
}

/// Which commit, where the program is not a development build, and which features.
#[test]
fn version() {
    let ran = crossbar(&["--version"], "");
    let number = env!("CARGO_PKG_VERSION");
    let features = if cfg!(feature = "wgpu") { "cli, wgpu" } else { "cli" };
    let (start, end) = (format!("crossbar {number} ("), format!(", features {features})\n"));
    let from = ran.stdout.strip_prefix(&start).and_then(|rest| rest.strip_suffix(&end));
    let from = from.unwrap_or_else(|| panic!("{}", ran.stdout));
    let commit =
        from.split(',').next().is_some_and(|hash| hash.len() >= 7 && hash.bytes().all(|b| b.is_ascii_hexdigit()));
    assert!(from == "development build" || from == "unknown commit" || commit, "{from}");
    assert_eq!(ran.code, Some(0));
    assert_eq!(ran.stdout, crossbar(&["-V"], "").stdout);
}

#[test]
fn every_command_has_a_manual_page() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let ran = crate::crossbar_in(folder.path(), &["man", "--out", "pages"], "");
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    let commands = names().into_iter().map(|c| format!("crossbar-{}", c.replace(' ', "-")));
    for command in std::iter::once("crossbar".to_owned()).chain(commands) {
        let path = folder.path().join(format!("pages/{command}.1"));
        let page = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{command}: {e}"));
        assert!(page.contains(&format!(".TH {command} 1")), "{command}: {page}");
        assert!(page.contains("Examples:"), "{command}: {page}");
        assert!(page.contains("memory\\-limit"), "{command}: {page}");
        assert!(ran.stdout.contains(&format!("{command}.1")), "{command}");
    }
    assert_eq!(crossbar(&["man"], "").code, Some(2), "--out is needed: nothing is written by surprise");
}

#[test]
fn without_arguments_there_are_three_things_to_try() {
    let ran = crossbar(&[], "");
    assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""));
    let tries: Vec<&str> = ran.stderr.lines().filter_map(|line| line.strip_prefix("  crossbar ")).collect();
    assert_eq!(tries.len(), 3, "{}", ran.stderr);
    for line in tries {
        // The command stands before two spaces or the end of the line.
        let command = line.split("  ").next().unwrap_or_default();
        let words: Vec<&str> = command.split(' ').chain(["--help"]).collect();
        assert_eq!(crossbar(&words, "").code, Some(0), "{command}");
    }
    insta::assert_snapshot!(ran.stderr);
    assert_eq!(crossbar(&["--json"], "").code, Some(2));
}
