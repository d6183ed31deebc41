//! The program's tree of commands, verbs and options, read from clap.

use clap::{Arg, ArgAction};

/// Options that every command has.
pub(crate) const GLOBAL: &[&str] = &["--json", "--threads", "--quiet"];

/// Commands without verbs and the verbs of the others, as typed: `check`, `cpca render`.
pub(crate) fn commands() -> Vec<(String, clap::Command)> {
    fn walk(name: &str, command: &clap::Command, found: &mut Vec<(String, clap::Command)>) {
        let inner: Vec<&clap::Command> = command.get_subcommands().collect();
        if inner.is_empty() {
            found.push((name.trim_start().to_owned(), command.clone()));
        }
        inner.iter().for_each(|inner| walk(&format!("{name} {}", inner.get_name()), inner, found));
    }
    let mut found = Vec::new();
    walk("", &crossbar::cli::program(), &mut found);
    found
}

/// The options of a command, except those that every command has, and whether they take a value.
pub(crate) fn options(command: &clap::Command) -> Vec<(String, bool)> {
    let takes = |arg: &Arg| matches!(arg.get_action(), ArgAction::Set | ArgAction::Append);
    let own = command.get_arguments().filter_map(|arg| Some((format!("--{}", arg.get_long()?), takes(arg))));
    own.filter(|(name, _)| !GLOBAL.contains(&name.as_str()) && name != "--help" && name != "--version").collect()
}

pub(crate) fn command_of<'a>(line: &str, commands: &'a [(String, clap::Command)]) -> &'a (String, clap::Command) {
    let is_of = |name: &str| line.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with(' '));
    commands.iter().find(|(name, _)| is_of(name)).unwrap_or_else(|| panic!("no command in `{line}`"))
}
