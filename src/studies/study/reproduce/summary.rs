//! The lines at the top of the page that summarize each paper.

use std::fmt::Write as _;

use strum::VariantArray as _;

use super::overview::tally;
use super::{EntryFindings, Paper, ReproduceEntry, Reproduced, RowVerdict};
use crate::report::SummaryLine;
use crate::report::words::listed;

type Part = (ReproduceEntry, EntryFindings);

/// Maximum number of entries that a line names.
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

fn missed(found: &EntryFindings) -> usize {
    found.rows.iter().filter(|row| row.verdict() == RowVerdict::Missed).count()
}

/// Sentence about the entries without a missed row, and the entries with the most.
fn text(parts: &[&Part]) -> String {
    let judged = || parts.iter().filter(|(_, found)| !found.rows.is_empty());
    let whole = judged().filter(|(_, found)| missed(found) == 0).count();
    let mut text = match (whole, judged().count()) {
        (_, 0) => return String::new(),
        (all, count) if all == count => "No row is missed.".to_owned(),
        (0, _) => "Every entry has missed rows".to_owned(),
        (whole, count) => format!("No row is missed in {whole} of {count} entries"),
    };
    let mut worst: Vec<(usize, usize, &str)> = judged()
        .map(|(entry, found)| (missed(found), found.rows.len(), entry.id))
        .filter(|(missed, ..)| *missed > 0)
        .collect();
    worst.sort_by_key(|(missed, ..)| std::cmp::Reverse(*missed));
    let names: Vec<String> =
        worst.iter().take(NAMED).map(|(missed, rows, id)| format!("{id} ({missed} of {rows})")).collect();
    if !names.is_empty() {
        let most = if worst.len() > NAMED { "the most in" } else { "missed in" };
        _ = write!(text, "; {most} {}.", listed(&names));
    }
    text
}

fn capital(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map(|first| first.to_ascii_uppercase()).into_iter().chain(rest).collect()
}
