//! Options that all commands share.

use clap::{ArgMatches, Command};

/// The innermost subcommand that was requested, with its matches.
pub(super) fn obeyed<'a>(program: &'a Command, matches: &'a ArgMatches) -> (&'a Command, &'a ArgMatches) {
    let inner = matches.subcommand().and_then(|(name, inner)| Some((program.find_subcommand(name)?, inner)));
    inner.map_or((program, matches), |(command, inner)| obeyed(command, inner))
}

/// Short names of options that many commands have.
const SHORT: [(&str, char); 3] = [("out", 'o'), ("device", 'd'), ("format", 'f')];

/// Gives common options their short names, and lets every option take `-1` as its value, so that the option's own error
/// message appears.
pub(super) fn with_common_settings(program: Command) -> Command {
    let commands: Vec<String> = program.get_subcommands().map(|command| command.get_name().to_owned()).collect();
    let program = program.mut_args(|arg| {
        let short = SHORT.into_iter().find(|(long, _)| arg.get_long() == Some(long));
        let arg = short.map_or(arg.clone(), |(_, short)| arg.short(short));
        match arg.get_action().takes_values() && !arg.is_positional() {
            // An option that accepts everything after a hyphen already accepts numbers.
            true if !arg.is_allow_hyphen_values_set() => arg.allow_negative_numbers(true),
            _ => arg,
        }
    });
    commands.into_iter().fold(program, |program, name| program.mut_subcommand(name, with_common_settings))
}
