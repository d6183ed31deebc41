//! Errors for options that another option makes useless, and for words that are neither names nor files.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command};

use super::{Problem, outputs};
use crate::io::require_writable;
use crate::names::did_you_mean;

/// Rejects the first option that was given; each option is paired with `true` if it was. `only_for` completes the
/// phrase "is for". Fails with [`Problem::Usage`].
pub(super) fn refuse<'a>(
    options: impl IntoIterator<Item = (&'a str, bool)>,
    only_for: &str,
    help: &str,
) -> Result<(), Problem> {
    match options.into_iter().find(|(_, given)| *given) {
        Some((option, _)) => Err(Problem::usage(format!("`{option}` is for {only_for}"), help)),
        None => Ok(()),
    }
}

/// Rejects an option that is given twice with the same value, or with the same name if its values are `NAME=VALUE`.
/// Numbers are compared by value: `sor:1.1` is `sor:1.10`. Lights add up, and A and B of a product may have the same
/// type. Fails with [`Problem::Usage`].
pub(super) fn refuse_repeated(program: &Command, matches: &ArgMatches) -> Result<(), Problem> {
    let (command, matches) = outputs::obeyed(program, matches);
    let is_list = |arg: &&Arg| matches!(arg.get_action(), ArgAction::Append);
    for arg in command.get_opts().filter(is_list).filter(|arg| !["light", "types"].contains(&arg.get_id().as_str())) {
        let mut known = BTreeSet::new();
        let values = matches.get_raw(arg.get_id().as_str()).into_iter().flatten().map(|value| value.to_string_lossy());
        let is_named = arg.get_value_names().into_iter().flatten().any(|name| name.contains('='));
        let end = |value: &str| value.find('=').filter(|_| is_named).unwrap_or(value.len());
        let mut names = values.map(|value| value[..end(&value)].to_owned());
        if let Some(name) = names.find(|name| !known.insert(by_value(name))) {
            let what = format!(
                "expected different values of `--{}`, found `{name}` again",
                arg.get_long().unwrap_or_default()
            );
            return Err(Problem::usage(what, "remove one of the two"));
        }
    }
    Ok(())
}

/// Options that name a file to write. A folder (`DIR`) is checked by its command.
const WRITTEN: [&str; 4] = ["out", "perfetto", "sheet", "matrix"];

/// Rejects, before long work, a file to write that another argument names, and one whose folder is not writable. Fails
/// with a [`Problem`]. [`crate::io::protect_inputs`] protects files that no argument names.
pub(super) fn refuse_places(program: &Command, matches: &ArgMatches) -> Result<(), Problem> {
    let (command, matches) = outputs::obeyed(program, matches);
    let given = |arg: &&Arg| matches.value_source(arg.get_id().as_str()) == Some(ValueSource::CommandLine);
    let paths = |arg: &Arg| {
        let values = matches.get_raw(arg.get_id().as_str()).into_iter().flatten();
        values.map(|value| place_of(Path::new(value))).collect::<Vec<PathBuf>>()
    };
    let is_folder = |arg: &Arg| arg.get_value_names().into_iter().flatten().any(|name| name == "DIR");
    let is_written = |arg: &Arg| WRITTEN.contains(&arg.get_id().as_str()) && !is_folder(arg);
    let named: Vec<&Arg> = command.get_arguments().filter(given).collect();
    for arg in named.iter().filter(|arg| is_written(arg)) {
        let option = arg.get_long().unwrap_or_default();
        let others = || named.iter().filter(|other| other.get_id() != arg.get_id());
        // Devices and pipes are written to directly.
        for path in paths(arg).into_iter().filter(|path| path.is_file() || !path.exists()) {
            // Where there is no file yet, other arguments are words, unless they are outputs, too.
            if others().any(|other| (path.is_file() || is_written(other)) && paths(other).contains(&path)) {
                let message = format!("`--{option}` names a file that the command also reads or writes");
                return Err(Problem::usage(message, "give another file"));
            }
            require_writable(folder_of(&path))?;
        }
    }
    Ok(())
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."))
}

/// The same path for all names of a file, which need not exist. A link is followed.
fn place_of(path: &Path) -> PathBuf {
    let in_folder = || Some(folder_of(path).canonicalize().ok()?.join(path.file_name()?));
    path.canonicalize().ok().or_else(in_folder).unwrap_or_else(|| path.into())
}

/// A value in which every number between colons has its shortest form.
fn by_value(text: &str) -> String {
    let parts = text.split(':').map(|part| part.parse::<f64>().map_or_else(|_| part.to_owned(), |x| x.to_string()));
    parts.collect::<Vec<_>>().join(":")
}

/// Rejects a word that is neither the name of a `what` nor a file; a path without a dot or a folder counts as a name.
/// Fails with [`Problem::Usage`], which lists the names.
pub(super) fn require_file(path: &Path, what: &str, names: &[&str], ending: &str) -> Result<(), Problem> {
    let name = path.to_str().unwrap_or_default();
    if path.exists() || path.components().count() != 1 || name.contains('.') {
        return Ok(());
    }
    let meant = did_you_mean(name, names.iter().copied());
    let help = format!("{meant}the names are {}; files need an ending, as in `{name}.{ending}`", names.join(", "));
    Err(Problem::usage(format!("there is no {what} `{name}`"), help))
}
