//! Statements of bounds: a digest per date, and the changes since.
//!
//! A figure's value, unit, section, bound and reading are stated once. A later change is in the figure's `changed`,
//! with its date, its reason and the old value. With all changes undone, the figures must have the digest of their
//! date. So nobody can move a bound or a reading after a result exists without saying so.

use sha2::{Digest, Sha256};

use super::file::{FileFigure, PaperFile};

/// Compares a file with its digests; the error includes advice.
pub(super) fn verify(file: &PaperFile) -> Result<(), String> {
    let first = file.stated.first().ok_or("expected at least one date in `stated`")?.date.as_str();
    for stated in &file.stated {
        let found = digest(file, first, &stated.date);
        if found != stated.digest {
            return Err(format!(
                "the statements of {} have digest {}, and the file now has {found}: a figure's value, bound or reading was changed. List what it was \
                 before in the figure's `changed`, with date and reason; give a new figure its own date",
                stated.date, stated.digest,
            ));
        }
    }
    let dated = |date: &String| file.stated.iter().any(|stated| stated.date == *date);
    for figure in &file.figures {
        if !figure.stated.iter().all(dated) {
            return Err(format!("`{}` is stated on a date that `stated` does not list", figure.id));
        }
        let has_reasons = figure.changed.iter().all(|change| !change.why.is_empty());
        if !has_reasons || !figure.changed.is_sorted_by_key(|change| &change.date) {
            return Err(format!("each change of `{}` needs a reason, and the oldest change comes first", figure.id));
        }
    }
    Ok(())
}

/// Digest of the figures stated on a date, in their original form: 16 hexadecimal digits.
fn digest(file: &PaperFile, first: &str, date: &str) -> String {
    let mut hash = Sha256::new();
    let stated = file.figures.iter().filter(|figure| figure.stated.as_deref().unwrap_or(first) == date);
    stated.for_each(|figure| hash.update(as_stated(figure.clone())));
    hash.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}

/// Line of a figure with its changes undone.
fn as_stated(mut figure: FileFigure) -> String {
    while let Some(before) = figure.changed.pop() {
        figure.value = before.value.or(figure.value);
        if before.bound.is_some() || before.unjudged.is_some() {
            (figure.bound, figure.unjudged) = (before.bound, before.unjudged);
        }
        figure.unit = before.unit.or(figure.unit);
        figure.reading = before.reading.or(figure.reading).filter(|reading| !reading.is_empty());
    }
    let FileFigure { id, value, ratio, scale, unit, place, bound, unjudged, reading, .. } = figure;
    // Reasons for not judging are prose, and their wording may change.
    let unjudged = unjudged.map(|_| "unjudged");
    format!("{id}|{value:?}|{ratio:?}|{scale:?}|{unit:?}|{place}|{bound:?}|{unjudged:?}|{reading:?}\n")
}
