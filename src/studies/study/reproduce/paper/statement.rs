//! Statements of bounds: a digest per date, and the changes since.
//!
//! A figure's value, unit, section, bound and reading are stated once. A later change is in the figure's `changed`,
//! with its date, its reason and the old value. With all changes undone, the figures must have the digest of their
//! date. So nobody can move a bound or a reading after a result exists without saying so.

use sha2::{Digest, Sha256};

use super::file::{FigureGroup, FileFigure, PaperFile};

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
    for (group, figure) in file.entries() {
        if !figure.stated.iter().all(dated) {
            return Err(format!("`{}` is stated on a date that `stated` does not list", figure.id));
        }
        let has_reasons = figure.changes(group).all(|change| !change.why.is_empty());
        if !has_reasons || !figure.changes(group).map(|change| &change.date).is_sorted() {
            return Err(format!("each change of `{}` needs a reason, and the oldest change comes first", figure.id));
        }
    }
    Ok(())
}

/// Digest of the figures stated on a date, in their original form: 16 hexadecimal digits.
fn digest(file: &PaperFile, first: &str, date: &str) -> String {
    let mut hash = Sha256::new();
    let stated = |(_, figure): &(&FigureGroup, &FileFigure)| figure.stated.as_deref().unwrap_or(first) == date;
    file.entries().filter(stated).for_each(|(group, figure)| hash.update(as_stated(group, figure)));
    hash.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}

/// Line of a figure with its changes undone.
fn as_stated(group: &FigureGroup, figure: &FileFigure) -> String {
    let (mut terms, mut value) = (figure.terms(group), figure.value.clone());
    for change in figure.changes(group).rev() {
        let before = change.before.clone();
        value = change.value.clone().or(value);
        if before.bound.is_some() || before.unjudged.is_some() {
            (terms.bound, terms.unjudged) = (before.bound, before.unjudged);
        }
        terms.unit = before.unit.or(terms.unit);
        terms.reading = before.reading.or(terms.reading).filter(|reading| !reading.is_empty());
    }
    // Reasons for not judging are prose, and their wording may change.
    let unjudged = terms.unjudged.map(|_| "unjudged");
    format!(
        "{}|{value:?}|{:?}|{:?}|{:?}|{}|{:?}|{unjudged:?}|{:?}\n",
        figure.id, figure.ratio, figure.scale, terms.unit, group.place, terms.bound, terms.reading,
    )
}
