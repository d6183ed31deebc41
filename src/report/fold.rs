//! Rows that found the same as one above: one row stands for them.

/// What stands in place of rows that found the same as one above.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Folded {
    /// What the rows are, one and several of them: `switch`, `switches`.
    pub rows: [&'static str; 2],
    /// What they have in common with the row above: `the same bits`.
    pub same: &'static str,
    /// The name of the row above.
    pub first: String,
    /// Their names.
    pub names: Vec<String>,
}

impl Folded {
    /// How many there are and what they have in common: `17 switches: the same bits`.
    pub fn text(&self) -> String {
        let rows = self.rows[usize::from(self.names.len() != 1)];
        format!("{} {rows}: {}", self.names.len(), self.same)
    }

    /// A sentence with their names, for under a table.
    pub fn note(&self) -> String {
        let mut same = self.same.chars();
        let capital = same.next().map(|first| first.to_ascii_uppercase()).into_iter();
        let same: String = capital.chain(same).collect();
        format!("{same} as {}: {}", self.first, self.names.join(", "))
    }
}

/// The fewest rows that are worth a row that stands for them.
const FEWEST: usize = 2;

/// Rows by what they found, in the order of their first: each with the rows after it that found the same, if those are
/// enough to be folded. `first[i]` is the first row that found what row i did.
pub(super) fn groups(first: &[usize]) -> Vec<(usize, Vec<usize>)> {
    let same = |row: usize| -> Vec<usize> { (row + 1..first.len()).filter(|other| first[*other] == row).collect() };
    let folds = |row: &usize| same(first[*row]).len() >= FEWEST;
    (0..first.len())
        .filter(|row| first[*row] == *row || !folds(row))
        .map(|row| (row, if first[row] == row && folds(&row) { same(row) } else { Vec::new() }))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_found_the_same_stand_once() {
        assert_eq!(groups(&[0, 0, 2, 0, 4]), [(0, vec![1, 3]), (2, vec![]), (4, vec![])]);
        assert_eq!(groups(&[0, 0, 2]), [(0, vec![]), (1, vec![]), (2, vec![])], "one row more folds nothing");
    }
}
