//! Errors for options that another option makes useless, and for words that are neither names nor files.

use std::collections::BTreeSet;
use std::path::Path;

use clap::{Arg, ArgAction, ArgMatches, Command};

use super::{Problem, outputs};
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
/// Lights add up, and A and B of a product may have the same type. Fails with [`Problem::Usage`].
pub(super) fn refuse_repeated(program: &Command, matches: &ArgMatches) -> Result<(), Problem> {
    let (command, matches) = outputs::obeyed(program, matches);
    let is_list = |arg: &&Arg| matches!(arg.get_action(), ArgAction::Append);
    for arg in command.get_opts().filter(is_list).filter(|arg| !["light", "types"].contains(&arg.get_id().as_str())) {
        let mut known = BTreeSet::new();
        let values = matches.get_raw(arg.get_id().as_str()).into_iter().flatten().map(|value| value.to_string_lossy());
        let is_named = arg.get_value_names().into_iter().flatten().any(|name| name.contains('='));
        let end = |value: &str| value.find('=').filter(|_| is_named).unwrap_or(value.len());
        let names = values.map(|value| value[..end(&value)].to_owned());
        if let Some(name) = names.into_iter().find(|name| !known.insert(name.clone())) {
            let what = format!(
                "expected different values of `--{}`, found `{name}` twice",
                arg.get_long().unwrap_or_default()
            );
            return Err(Problem::usage(what, "remove one of the two"));
        }
    }
    Ok(())
}

/// Rejects an output file that is also one of `others`, which the command reads or writes. Fails with
/// [`Problem::Usage`].
pub(super) fn refuse_overwriting<'a>(
    option: &str,
    output: Option<&Path>,
    others: impl IntoIterator<Item = &'a Path>,
) -> Result<(), Problem> {
    let whole = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_owned());
    // Devices such as /dev/null can be written twice.
    let is_same = |output: &Path, other: &Path| whole(other) == whole(output) && (output.is_file() || !output.exists());
    match output.and_then(|output| others.into_iter().find(|other| is_same(output, other))) {
        Some(other) => {
            Err(Problem::usage(format!("`{option}` would overwrite {}", other.display()), "give another file"))
        }
        None => Ok(()),
    }
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
