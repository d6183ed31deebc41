//! Counts of outcomes, and the lines at the top of a page.

use std::fmt;

/// Evaluation of an outcome in a tally.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum Tone {
    /// Desirable.
    Good,
    /// Desirable, with less weight.
    Fair,
    /// Neither desirable nor undesirable.
    Neutral,
    /// Undesirable, with a known cause.
    Excused,
    /// Contradictory.
    Odd,
    /// Undesirable.
    Bad,
}

impl Tone {
    /// CSS class.
    pub(super) fn class(self) -> &'static str {
        self.into()
    }
}

/// Number of counted items with the same outcome.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TallyEntry {
    /// The number.
    pub count: u64,
    /// Noun for the items, singular or plural: `row missed`, `rows missed`.
    pub what: String,
    /// Evaluation of the outcome.
    pub tone: Tone,
}

/// One line about a part of a study, at the top of its page: title and counts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SummaryLine {
    /// Title.
    pub title: String,
    /// Heading of the page that the title links to; no link if no heading has this text.
    pub heading: String,
    /// Counts of outcomes; zero counts are not shown.
    pub tally: Vec<TallyEntry>,
    /// Sentence that summarises the part.
    pub text: String,
}

impl fmt::Display for SummaryLine {
    /// Title and counts: `Radiosity: 1 predicted, 3 calibrated.`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let found = self.tally.iter().filter(|entry| entry.count > 0);
        let counts: Vec<String> = found.map(|entry| format!("{} {}", entry.count, entry.what)).collect();
        write!(f, "{}: {}.", self.title, counts.join(", "))
    }
}
