//! Folding of table rows whose results equal those of an earlier row.

/// Cell that replaces folded rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Folded {
    /// Noun for the rows, singular and plural: `switch`, `switches`.
    pub rows: [&'static str; 2],
    /// Common property of these rows and the row above, such as `the same bits`.
    pub same: &'static str,
    /// Name of the row above.
    pub first: String,
    /// Names of the folded rows.
    pub names: Vec<String>,
}

impl Folded {
    /// Number of folded rows and their common property: `17 switches: the same bits`.
    pub fn text(&self) -> String {
        let rows = self.rows[usize::from(self.names.len() != 1)];
        format!("{} {rows}: {}", self.names.len(), self.same)
    }

    /// Sentence with the names of the folded rows, for the note below the table.
    pub fn note(&self) -> String {
        let mut same = self.same.chars();
        let capital = same.next().map(|first| first.to_ascii_uppercase()).into_iter();
        let same: String = capital.chain(same).collect();
        format!("{same} as {}: {}", self.first, self.names.join(", "))
    }
}

/// Minimum number of rows that are folded.
const FEWEST: usize = 2;

/// Returns the rows to show, in order, each with the rows folded into it: at least [`FEWEST`] later rows with equal
/// results. `first[i]` is the first row with the result of row i.
pub(super) fn groups(first: &[usize]) -> Vec<(usize, Vec<usize>)> {
    let same = |row: usize| -> Vec<usize> { (row + 1..first.len()).filter(|other| first[*other] == row).collect() };
    let folds = |row: &usize| same(first[*row]).len() >= FEWEST;
    (0..first.len())
        .filter(|row| first[*row] == *row || !folds(row))
        .map(|row| (row, if first[row] == row && folds(&row) { same(row) } else { Vec::new() }))
        .collect()
}
