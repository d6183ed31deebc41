//! Errors for options that another option makes useless, and for words that are neither names nor files.

use std::path::Path;

use super::Problem;
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

/// Rejects a word that is neither the name of a `what` nor a file; a path without a dot or a folder counts as a name.
/// Fails with [`Problem::Usage`], which lists the names.
pub(super) fn require_file(path: &Path, what: &str, names: &[&str], ending: &str) -> Result<(), Problem> {
    let name = path.to_str().unwrap_or_default();
    if path.exists() || path.components().count() != 1 || name.contains('.') {
        return Ok(());
    }
    let meant = did_you_mean(name, names.iter().copied());
    let help = format!("{meant}there are {}; a file needs its ending, as in `{name}.{ending}`", names.join(", "));
    Err(Problem::usage(format!("there is no {what} `{name}`"), help))
}
