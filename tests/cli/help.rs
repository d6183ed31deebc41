//! Help texts: required parts of each. Their layout is clap's.

use crate::{crossbar, tree};

/// All commands, in alphabetical order.
pub(crate) fn commands() -> Vec<String> {
    ::crossbar::cli::program().get_subcommands().map(|command| command.get_name().to_owned()).collect()
}

/// Commands, and commands with their verbs.
pub(crate) fn names() -> Vec<String> {
    let verbs = tree::commands().into_iter().map(|(name, _)| name).filter(|name| name.contains(' '));
    commands().into_iter().chain(verbs).collect()
}

#[test]
fn every_command_is_listed_here() {
    let help = crossbar(&["--help"], "").stdout;
    // A line of the list: two spaces, the name, its description.
    let list = help.lines().skip_while(|line| *line != "Start here:").take_while(|line| *line != "Options:");
    let names = list.filter_map(|line| line.strip_prefix("  ").filter(|rest| !rest.starts_with(' ')));
    let mut listed: Vec<&str> = names.filter_map(|line| line.split(' ').next()).filter(|n| *n != "help").collect();
    listed.sort_unstable();
    assert_eq!(listed, commands());
}

/// `-o`, `-d` and `-f` are short for the most common options.
#[test]
fn short_options() {
    let long = crossbar(&["alu", "add", "--format", "fp16"], "3C00 4000\n");
    assert_eq!((long.code, long.stdout.starts_with("4200")), (Some(0), true), "{}", long.transcript());
    assert_eq!(crossbar(&["alu", "add", "-f", "fp16", "-q"], "3C00 4000\n").stdout, long.stdout);
    let check = |option| crossbar(&["check", "docs/examples/intersect.psa", option, "Radeon 8500"], "").stdout;
    assert_eq!(check("-d"), check("--device"));
    let folder = tempfile::tempdir().expect("a folder for the test");
    assert_eq!(crate::crossbar_in(folder.path(), &["man", "-o", "pages"], "").code, Some(0));
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

#[test]
fn version() {
    let ran = crossbar(&["--version"], "");
    let optional = [("wgpu", cfg!(feature = "wgpu")), ("wgsl", cfg!(feature = "wgsl"))];
    let features = optional.iter().filter(|(_, has)| *has).fold("cli".to_owned(), |all, (name, _)| all + ", " + name);
    let commit = option_env!("CROSSBAR_COMMIT").map(|commit| format!("{commit}, ")).unwrap_or_default();
    assert_eq!(ran.stdout, format!("crossbar {} ({commit}features {features})\n", env!("CARGO_PKG_VERSION")));
    assert_eq!((ran.code, &ran.stdout), (Some(0), &crossbar(&["-V"], "").stdout));
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
        assert!(page.contains("threads"), "{command}: {page}");
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
        // Two spaces or the end of the line end the command.
        let command = line.split("  ").next().unwrap_or_default();
        let words: Vec<&str> = command.split(' ').chain(["--help"]).collect();
        assert_eq!(crossbar(&words, "").code, Some(0), "{command}");
    }
    assert_eq!(crossbar(&["--json"], "").code, Some(2));
}
