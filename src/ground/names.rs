//! Suggestions for misspelt names.

/// Maximum length of a name for which a suggestion is made.
const LONGEST: usize = 80;

/// Returns the name nearest to `found` (on ties, the first), if at most one letter in three is wrong, missing,
/// superfluous or swapped with the next. Case is ignored.
pub fn nearest<'a>(found: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let letters = found.chars().take(LONGEST + 1).count();
    if letters > LONGEST {
        return None;
    }
    let found = found.to_lowercase();
    let distance = |name: &str| strsim::damerau_levenshtein(&found, &name.to_lowercase());
    let near = names.into_iter().map(|name| (distance(name), name)).filter(|(far, _)| *far <= letters / 3);
    near.min_by_key(|(far, _)| *far).map(|(_, name)| name)
}

/// Returns ``did you mean `r200`? ``, as a prefix of other help; empty if no name is near.
pub fn did_you_mean<'a>(found: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    nearest(found, names).map(|name| format!("did you mean `{name}`? ")).unwrap_or_default()
}

/// Like [`did_you_mean`], for serde's messages on unknown fields and variants, which quote the unknown name, then the
/// known names.
pub fn did_you_mean_field(message: &str) -> String {
    if !message.starts_with("unknown ") {
        return String::new();
    }
    let mut quoted = message.split('`').skip(1).step_by(2);
    quoted.next().map(|found| did_you_mean(found, quoted)).unwrap_or_default()
}
