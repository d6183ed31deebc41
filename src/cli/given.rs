//! Options that other options make useless.

use super::Problem;

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
