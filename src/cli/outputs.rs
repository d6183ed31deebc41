//! Options that all commands share.

use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{ArgMatches, Command};

use super::Problem;

/// The options whose value is the path of an output.
const OUTPUTS: [&str; 5] = ["out", "csv", "matrix", "sheet", "perfetto"];

/// Rejects two outputs with the same path, since one would overwrite the other. Fails with [`Problem::Usage`].
pub(super) fn require_different(program: &Command, matches: &ArgMatches) -> Result<(), Problem> {
    let (command, matches) = obeyed(program, matches);
    let mut seen: Vec<(&str, PathBuf)> = Vec::new();
    for id in command.get_arguments().map(|arg| arg.get_id().as_str()).filter(|id| OUTPUTS.contains(id)) {
        if matches.value_source(id) != Some(ValueSource::CommandLine) {
            continue;
        }
        let Ok(Some(path)) = matches.try_get_one::<PathBuf>(id) else { continue };
        let Some(place) = place(path) else { continue };
        if let Some((other, _)) = seen.iter().find(|(_, known)| *known == place) {
            let what = format!(
                "expected different files, found `--{other}` and `--{id}` that both write `{}`",
                path.display()
            );
            return Err(Problem::usage(what, "give each its own path"));
        }
        seen.push((id, place));
    }
    Ok(())
}

/// The command that runs, below the program and its subcommands, with its matches.
pub(super) fn obeyed<'a>(program: &'a Command, matches: &'a ArgMatches) -> (&'a Command, &'a ArgMatches) {
    let inner = matches.subcommand().and_then(|(name, inner)| Some((program.find_subcommand(name)?, inner)));
    inner.map_or((program, matches), |(command, inner)| obeyed(command, inner))
}

/// Final path of a file, with links followed; `None` for a device or pipe, which may take any number of outputs.
fn place(path: &Path) -> Option<PathBuf> {
    if let Ok(whole) = path.canonicalize() {
        return (whole.is_file() || whole.is_dir()).then_some(whole);
    }
    let absolute = std::path::absolute(path).ok()?;
    let (parent, name) = (absolute.parent()?, absolute.file_name()?);
    Some(parent.canonicalize().map_or_else(|_| absolute.clone(), |parent| parent.join(name)))
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
