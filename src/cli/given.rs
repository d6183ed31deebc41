//! Options that another option makes useless.

use super::Problem;

/// Refuses the first option that was given; each has `true` if it was. `only_for` completes "is for". Fails with
/// [`Problem::Usage`].
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
