//! Tests that everything mentioned in prose exists: commands and options of the program, source files.

use std::process::Command;

use super::texts::pages;
use crate::answers::words;
use crate::{crossbar, help};

/// Text in backquotes, outside of fenced blocks.
fn quoted(text: &str) -> Vec<String> {
    let sentences: String = text.split("```").step_by(2).collect();
    sentences.split('`').skip(1).step_by(2).map(words).collect()
}

/// A message if a command line has a command or an option that does not exist; words in capitals are placeholders.
fn fault(program: &clap::Command, line: &str) -> Option<String> {
    let mut command = program;
    for word in line.split(' ').skip(1).take_while(|word| !word.starts_with(['#', '>', '|', '('])) {
        let is_name = word.bytes().all(|byte| byte.is_ascii_lowercase() || byte == b'-');
        if let Some(option) = word.strip_prefix("--") {
            let name = option.split('=').next();
            let known = ["help", "version"].map(Some).contains(&name);
            if !known && !command.get_arguments().any(|arg| arg.get_long() == name) {
                return Some(format!("`{line}`: no option `{word}`"));
            }
        } else if let Some(inner) = command.find_subcommand(word) {
            command = inner;
        } else if is_name && command.has_subcommands() {
            return Some(format!("`{line}`: no command `{word}`"));
        }
    }
    None
}

#[test]
fn commands_in_sentences_exist() {
    let mut program = ::crossbar::cli::program();
    program.build();
    let of_help = |name: String| {
        let arguments: Vec<&str> = name.split(' ').filter(|name| !name.is_empty()).chain(["--help"]).collect();
        (format!("crossbar {name} --help"), crossbar(&arguments, "").stdout)
    };
    let texts = pages().into_iter().filter(|(name, _)| name != "CHANGELOG.md");
    let mut faults = Vec::new();
    for (name, text) in texts.chain(std::iter::once(String::new()).chain(help::names()).map(of_help)) {
        let lines = quoted(&text).into_iter().filter(|span| span.starts_with("crossbar "));
        faults.extend(lines.filter_map(|line| Some(format!("{name}: {}", fault(&program, &line)?))));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    for line in ["crossbar prt texture", "crossbar check --colour", "crossbar bi-scale textures"] {
        assert!(fault(&program, line).is_some(), "{line}");
    }
}

/// Source files exist that pages name by a path, from the root or from a folder below it.
#[test]
fn source_files_on_pages_exist() {
    let git = Command::new("git").args(["ls-files"]).current_dir(env!("CARGO_MANIFEST_DIR")).output().expect("git");
    let files = String::from_utf8(git.stdout).expect("names");
    let is_there = |path: &str| files.lines().any(|file| file == path || file.ends_with(&format!("/{path}")));
    let is_path = |span: &String| span.ends_with(".rs") && span.contains('/') && !span.contains([' ', '{', '*']);
    let of = |(name, text): (String, String)| {
        let missing =
            quoted(&text).into_iter().filter(is_path).filter(|path| !path.contains("NAME") && !is_there(path));
        missing.map(|path| format!("{name}: {path}")).collect::<Vec<_>>()
    };
    let missing: Vec<String> = pages().into_iter().filter(|(name, _)| name != "CHANGELOG.md").flat_map(of).collect();
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}
