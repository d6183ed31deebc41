//! The lines at the top of the page that summarize each paper.

use strum::VariantArray as _;

use super::overview::tally;
use super::{EntryFindings, Paper, ReproduceEntry, Reproduced, RowVerdict};
use crate::report::SummaryLine;
use crate::report::words::listed;

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
