//! Overview of all rows: conclusion, tally, and a line per paper.

use strum::VariantArray as _;

use super::{EntryFindings, MissClass, Paper, PaperRow, ReproduceEntry, Reproduced, RowSource, RowVerdict};
use crate::report::words::{counted, listed};
use crate::report::{Findings, SummaryLine, TallyEntry, Tone};

pub(super) fn overview(all: &mut Findings, found: &Reproduced) {
    let rows: Vec<&PaperRow> = rows(found).collect();
    let evidence = chose_none(found);
    let of = |of: &dyn Fn(&PaperRow) -> bool| count(&evidence, of);
    let sentences = [
        judged(&evidence).map(|judged| format!("{judged}.")),
        differ(&rows),
        classes(&evidence),
        counts(&[
            ("Recorded at full size", of(&is_recorded)),
            ("recomputed with the same bits", of(&|row| row.source == RowSource::Confirmed)),
        ]),
        counts(&[("Met only because the printed value is rounded", of(&needs_rounding))]),
        counts(&[
            ("Used for calibration, so not evidence", rows.len() - evidence.len()),
            ("of these, missed", count(&rows, |row| row.is_calibrated() && row.verdict() == RowVerdict::Missed)),
        ]),
    ];
    sentences.into_iter().flatten().for_each(|sentence| all.conclusion(sentence));
    for entry in tally(rows.into_iter()) {
        all.tally(entry.count, [&entry.what, &entry.what], entry.tone);
    }
}

pub(super) fn rows(found: &Reproduced) -> impl Iterator<Item = &PaperRow> {
    found.iter().flat_map(|(_, found)| &found.rows)
}

/// Joins the nonzero counts into a sentence `label: count; ...`; `None` if the first is 0.
fn counts(parts: &[(&str, usize)]) -> Option<String> {
    let (_, first) = parts.first()?;
    let shown = parts.iter().filter(|(_, count)| *count > 0).map(|(what, count)| format!("{what}: {count}"));
    (*first > 0).then(|| shown.collect::<Vec<_>>().join("; ") + ".")
}

fn is_recorded(row: &PaperRow) -> bool {
    row.source != RowSource::Computed
}

fn needs_rounding(row: &PaperRow) -> bool {
    row.verdict() != RowVerdict::Contradictory && row.holds_by_rounding()
}

pub(super) fn tally<'a>(rows: impl Iterator<Item = &'a PaperRow>) -> Vec<TallyEntry> {
    let verdicts: Vec<RowVerdict> = rows.map(PaperRow::verdict).collect();
    let entry = |verdict: &RowVerdict| TallyEntry {
        count: verdicts.iter().filter(|found| *found == verdict).count() as u64,
        what: verdict.to_string(),
        tone: tone(*verdict),
    };
    RowVerdict::VARIANTS.iter().map(entry).collect()
}

const fn tone(verdict: RowVerdict) -> Tone {
    match verdict {
        RowVerdict::Predicted => Tone::Good,
        RowVerdict::Missed => Tone::Bad,
        RowVerdict::OrderOnly | RowVerdict::Consistent => Tone::Fair,
        RowVerdict::ByConstruction | RowVerdict::Calibrated | RowVerdict::TooVague => Tone::Neutral,
        RowVerdict::Explained => Tone::Excused,
        RowVerdict::Contradictory => Tone::Odd,
    }
}

fn count(rows: &[&PaperRow], of: impl Fn(&PaperRow) -> bool) -> usize {
    rows.iter().filter(|row| of(row)).count()
}

/// Rows whose printed value did not determine a constant of a model.
fn chose_none(found: &Reproduced) -> Vec<&PaperRow> {
    rows(found).filter(|row| !row.is_calibrated()).collect()
}

/// Sentence about rows whose printed value did not determine a constant of a model: how many rows there are, and how
/// many have each verdict. `None` if there are no rows.
fn judged(rows: &[&PaperRow]) -> Option<String> {
    let of = |verdict: RowVerdict| (count(rows, |row| row.verdict() == verdict), verdict);
    let parts = RowVerdict::VARIANTS.iter().map(|verdict| of(*verdict)).filter(|(count, _)| *count > 0);
    let parts = parts.enumerate().map(|(n, (count, verdict))| {
        // The verb agrees with the first count.
        let verb = ["are ", "is "][usize::from(count == 1)];
        format!("{count} {}{}", if n == 0 { verb } else { "" }, verdict.of_rows())
    });
    let parts = listed(&parts.collect::<Vec<_>>());
    let all = counted(rows.len() as u64, "figure", "figures");
    (!rows.is_empty()).then(|| format!("Of {all} not used for calibration, {parts}"))
}

/// Formats the tally of the rows whose printed value did not determine a constant, and the number of recorded ones.
pub fn evidence_line(found: &Reproduced) -> String {
    let rows = chose_none(found);
    format!("{}; recorded at full size: {}", judged(&rows).unwrap_or_default(), count(&rows, is_recorded))
}

/// Number of missed rows by cause; `None` if no row is missed for a known cause.
fn classes(rows: &[&PaperRow]) -> Option<String> {
    let of = |class: MissClass| (count(rows, |row| row.missed() == Some(class)), class);
    let counts = MissClass::VARIANTS.iter().copied().map(of).filter(|(count, _)| *count > 0);
    let counts: Vec<String> = counts.map(|(count, class)| format!("{class} {count}")).collect();
    (!counts.is_empty()).then(|| format!("Causes of misses: {}.", counts.join(", ")))
}

fn differ(rows: &[&PaperRow]) -> Option<String> {
    let names: Vec<&str> = rows.iter().filter(|row| row.differs()).map(|row| row.target.id.as_str()).collect();
    (!names.is_empty()).then(|| format!("Values that differ from their records: {}.", names.join(", ")))
}

type Part = (ReproduceEntry, EntryFindings);

/// Maximum number of entries in a line.
const NAMED: usize = 3;

/// One line per paper with an entry, each with the counts of its verdicts.
pub fn summary_lines(found: &Reproduced) -> Vec<SummaryLine> {
    let line = |paper: &Paper| {
        let parts: Vec<&Part> = found.iter().filter(|(entry, _)| entry.paper == *paper).collect();
        let (first, _) = parts.first()?;
        Some(SummaryLine {
            title: capital(&paper.to_string()),
            heading: first.title.to_owned(),
            tally: tally(parts.iter().flat_map(|(_, found)| &found.rows)),
            text: text(&parts),
        })
    };
    Paper::VARIANTS.iter().filter_map(line).collect()
}

/// Sentence about the entries that have the most missed rows.
fn text(parts: &[&Part]) -> String {
    let mut worst: Vec<(usize, String)> = Vec::new();
    for (entry, found) in parts {
        let missed = found.rows.iter().filter(|row| row.verdict() == RowVerdict::Missed).count();
        worst.push((missed, format!("{} ({missed} of {})", entry.id, found.rows.len())));
    }
    worst.retain(|(missed, _)| *missed > 0);
    worst.sort_by_key(|(missed, _)| std::cmp::Reverse(*missed));
    let names: Vec<&String> = worst.iter().take(NAMED).map(|(_, name)| name).collect();
    let most = if worst.len() > NAMED { "Most missed rows are in" } else { "Rows are missed in" };
    if parts.iter().all(|(_, found)| found.rows.is_empty()) {
        String::new()
    } else if names.is_empty() {
        "No row is missed.".to_owned()
    } else {
        format!("{most} {}.", listed(&names))
    }
}

fn capital(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map(|first| first.to_ascii_uppercase()).into_iter().chain(rest).collect()
}
