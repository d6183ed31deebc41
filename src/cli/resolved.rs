//! The resolved command line: every option that affects the result, including defaults.

use std::ffi::{OsStr, OsString};
use std::fmt::Write as _;

use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command};

/// Options that change no result: the output folder, the executor and its adapter, messages.
const WITHOUT_EFFECT: [&str; 7] = ["out", "executor", "json", "threads", "quiet", "help", "resume"];

#[derive(Debug)]
pub(super) struct CommandLine {
    pub(super) text: String,
}

/// `crossbar NAME`, or `crossbar NAME VERB`, with positional arguments, then options in the order of the help. Omits a
/// default if a given option replaces it.
pub(super) fn command_line(program: &Command, matches: &ArgMatches) -> CommandLine {
    let mut line = CommandLine { text: program.get_name().to_owned() };
    let (mut command, mut matches) = (program, matches);
    while let Some((name, inner)) = matches.subcommand() {
        // Writing to a string cannot fail.
        let _ = write!(line.text, " {name}");
        let Some(found) = command.find_subcommand(name) else { return line };
        (command, matches) = (found, inner);
    }
    if std::ptr::eq(command, program) {
        return line;
    }
    let (positional, options): (Vec<&Arg>, Vec<&Arg>) = command.get_arguments().partition(|arg| arg.is_positional());
    for arg in positional.into_iter().chain(options) {
        if WITHOUT_EFFECT.contains(&arg.get_id().as_str()) || replaced(command, arg, matches) {
            continue;
        }
        for value in values(arg, matches) {
            let shown = value.as_deref().map(quoted);
            // Writing to a string cannot fail.
            let _ = match (arg.get_long(), shown) {
                (Some(long), Some(value)) => write!(line.text, " --{long} {value}"),
                (Some(long), None) => write!(line.text, " --{long}"),
                (None, value) => write!(line.text, " {}", value.unwrap_or_default()),
            };
        }
    }
    line
}

fn quoted(value: &OsStr) -> String {
    let text = value.to_string_lossy();
    let plain = |c: char| c.is_alphanumeric() || "_-+=:,./@%".contains(c);
    if !text.is_empty() && text.chars().all(plain) {
        text.into_owned()
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

/// Returns `true` if the argument only has its default, and a given argument excludes it.
fn replaced(command: &Command, arg: &Arg, matches: &ArgMatches) -> bool {
    let given = |other: &&Arg| matches.value_source(other.get_id().as_str()) == Some(ValueSource::CommandLine);
    let default = matches.value_source(arg.get_id().as_str()) == Some(ValueSource::DefaultValue);
    default && command.get_arguments().filter(given).any(|other| command.get_arg_conflicts_with(other).contains(&arg))
}

/// The values of each occurrence; `None`, once, for a given flag.
fn values(arg: &Arg, matches: &ArgMatches) -> Vec<Option<OsString>> {
    let id = arg.get_id().as_str();
    if matches!(arg.get_action(), ArgAction::SetTrue) {
        return matches.get_flag(id).then_some(None).into_iter().collect();
    }
    let raw: Vec<OsString> = matches.get_raw(id).into_iter().flatten().map(OsStr::to_owned).collect();
    match arg.get_value_delimiter() {
        Some(delimiter) if !raw.is_empty() => vec![Some(raw.join(OsStr::new(&delimiter.to_string())))],
        _ => raw.into_iter().map(Some).collect(),
    }
}
