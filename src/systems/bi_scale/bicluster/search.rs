//! Algorithm 1 by influence values (section V, Precomputation Optimization): the gain of each insertion or deletion is
//! updated incrementally, because an operation changes only the lines that it crosses.
//!
//! With r rows and l columns inside, inserting a row gains 2 (matches + non-zeros) - 2l - 1, inserting a column 2 (most
//! frequent + non-zeros) - 2r - 2, and a deletion gains the negative of that. So the key of a line is the sum in
//! parentheses, which depends on the entries of the line, but not on r or l.

use super::draw::{Counts, start};
use super::lines::{ColumnTally, Lines, transposed};
use super::queue::BucketQueue;
use super::{Bicluster, Biclustering};
use crate::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crate::error::{InputError, ensure, input_error};

/// Biclusters of a matrix, identical to the result of [`paper::biclusters`](crate::bi_scale::paper::biclusters).
/// `seed` chooses the non-zeros at which biclusters start. `found` is called after each bicluster with the number of
/// remaining non-zeros.
///
/// Besides the biclusters, the search needs 16 bytes per non-zero and about 80 bytes per row and column. Fails with
/// [`InputError`] for more than 2^32 non-zeros, or if a residual does not fit into 32 bits.
pub fn bicluster(matrix: &SparseMatrix, seed: u64, found: &mut dyn FnMut(u64)) -> Result<Biclustering, InputError> {
    let nonzeros = matrix.nonzeros() as u64;
    ensure!(u32::try_from(nonzeros).is_ok(), "expected at most {} non-zeros, found {nonzeros}", u32::MAX);
    let biclustering = Search::new(matrix.to_rows(), matrix.columns(), seed).run(matrix, found);
    biclustering.ok_or_else(|| input_error!("expected residuals that fit into 32 bits, found larger residuals"))
}

/// State of the lines of one direction: rows or columns.
#[derive(Debug)]
struct SearchSide {
    lines: Lines,
    /// Key of each line: within the submatrix, matches (for a column outside, the count of its most frequent value)
    /// plus non-zeros.
    keys: Vec<u32>,
    /// Index of the line in `inside`, or [`OUTSIDE`].
    places: Vec<u32>,
    inside: Vec<u32>,
    /// Lines whose key may differ from 0.
    touched: Vec<u32>,
    insertions: BucketQueue,
    deletions: BucketQueue,
    /// Scratch of [`Self::subtract`]: `true` for crossing lines that have an entry, by index in `inside`.
    met: Vec<bool>,
}

const OUTSIDE: u32 = u32::MAX;

/// An operation: its gain, and the line that it inserts or deletes.
#[derive(Clone, Copy, Debug)]
struct Operation {
    gain: i64,
    line: u32,
}

impl Operation {
    /// The better of two operations on lines of one direction: the larger gain, then the lower line.
    fn better(first: Option<Self>, second: Option<Self>) -> Option<Self> {
        match (first, second) {
            (Some(a), Some(b)) => Some(if (b.gain, a.line) > (a.gain, b.line) { b } else { a }),
            (a, b) => a.or(b),
        }
    }
}

impl SearchSide {
    fn new(lines: Lines) -> Self {
        let count = lines.len();
        Self {
            lines,
            keys: vec![0; count],
            places: vec![OUTSIDE; count],
            inside: Vec::new(),
            touched: Vec::new(),
            insertions: BucketQueue::default(),
            deletions: BucketQueue::default(),
            met: Vec::new(),
        }
    }

    /// Sets the key of a line, and queues the line, if it is inside or its insertion may gain (`key` at least `least`).
    #[inline]
    fn set_key(&mut self, line: u32, key: u32, least: u32) {
        let old = std::mem::replace(&mut self.keys[line as usize], key);
        if old == 0 {
            self.touched.push(line);
        }
        if self.places[line as usize] != OUTSIDE {
            self.deletions.push(key, line);
        } else if key >= least {
            self.insertions.push(key, line);
        }
    }

    fn insert(&mut self, line: u32) {
        self.places[line as usize] = self.inside.len() as u32;
        self.inside.push(line);
        self.deletions.push(self.keys[line as usize], line);
    }

    fn delete(&mut self, line: u32) {
        let place = std::mem::replace(&mut self.places[line as usize], OUTSIDE);
        self.inside.swap_remove(place as usize);
        if let Some(&moved) = self.inside.get(place as usize) {
            self.places[moved as usize] = place;
        }
    }

    /// Queues all lines outside with a key of at least `least`, after the deletion of a crossing line has lowered
    /// `least`.
    fn queue_again(&mut self, least: u32) {
        self.insertions.clear();
        for &line in &self.touched {
            if self.places[line as usize] == OUTSIDE && self.keys[line as usize] >= least {
                self.insertions.push(self.keys[line as usize], line);
            }
        }
    }

    /// The best operation on a line of this direction; a key of `cost / 2` has gain 0.
    fn best(&mut self, cost: i64) -> Option<Operation> {
        let (keys, places) = (&self.keys, &self.places);
        let is_outside = |key: u32, line: u32| keys[line as usize] == key && places[line as usize] == OUTSIDE;
        let is_inside = |key: u32, line: u32| keys[line as usize] == key && places[line as usize] != OUTSIDE;
        let gain = |key: u32| 2 * i64::from(key) - cost;
        let insertion = self.insertions.highest(is_outside).map(|(key, line)| Operation { gain: gain(key), line });
        // The last line stays, because a bicluster has at least one row and one column.
        if self.inside.len() == 1 {
            return insertion;
        }
        let deletion = self.deletions.lowest(is_inside).map(|(key, line)| Operation { gain: -gain(key), line });
        Operation::better(insertion, deletion)
    }

    /// Subtracts the bicluster's values from the entries `all` of a line inside; `places` are the crossing lines'
    /// indices in `inside`, and `t` their values. Returns the change of the number of entries, or `None` if a residual
    /// does not fit into 32 bits.
    fn subtract(
        &mut self,
        line: u32,
        all: impl ExactSizeIterator<Item = MatrixEntry>,
        places: &[u32],
        t: impl Fn(u32) -> i32,
    ) -> Option<i64> {
        let entries = &mut self.lines[line as usize];
        let before = entries.len().cast_signed() as i64;
        self.met.clear();
        self.met.resize(all.len(), false);
        let (met, mut has_all) = (&mut self.met, true);
        let mut subtract = |entry: MatrixEntry| {
            let place = places[entry.index as usize];
            if place == OUTSIDE {
                return Some(entry);
            }
            met[place as usize] = true;
            let residual = entry.value.checked_sub(t(entry.index));
            has_all &= residual.is_some();
            let value = residual.unwrap_or(0);
            (value != 0).then_some(MatrixEntry { value, ..entry })
        };
        entries.retain_mut(|entry| subtract(*entry).map(|left| *entry = left).is_some());
        if !has_all {
            return None;
        }
        // Elements of the line that were 0 become -t.
        let is_new = |entry: &MatrixEntry| !self.met[places[entry.index as usize] as usize];
        for entry in all.filter(is_new) {
            entries.push(MatrixEntry { value: entry.value.checked_neg()?, ..entry });
        }
        Some(entries.len().cast_signed() as i64 - before)
    }

    /// Resets everything but the entries.
    fn reset(&mut self) {
        self.touched.iter().for_each(|&line| self.keys[line as usize] = 0);
        self.inside.iter().for_each(|&line| self.places[line as usize] = OUTSIDE);
        self.touched.clear();
        self.inside.clear();
        self.insertions.clear();
        self.deletions.clear();
    }
}

#[derive(Debug)]
struct Search {
    seed: u64,
    rows: SearchSide,
    columns: SearchSide,
    /// Counts of each column's values in the rows inside.
    tallies: Vec<ColumnTally>,
    /// The value of each column inside.
    values: Vec<i32>,
    /// Remaining non-zeros per row.
    left: Counts,
}

impl Search {
    fn new(rows: Lines, width: usize, seed: u64) -> Self {
        let columns = transposed(&rows, width);
        let left = Counts::new(rows.iter().map(|row| row.len() as u64));
        Self {
            seed,
            rows: SearchSide::new(rows),
            columns: SearchSide::new(columns),
            tallies: vec![ColumnTally::default(); width],
            values: vec![0; width],
            left,
        }
    }

    /// Lines 2 to 21 of Algorithm 1; `None` if a residual does not fit into 32 bits.
    fn run(&mut self, matrix: &SparseMatrix, found: &mut dyn FnMut(u64)) -> Option<Biclustering> {
        let mut biclustering = Biclustering::empty(matrix.rows(), matrix.columns(), matrix.fraction_bits());
        while self.left.total() > 0 {
            self.begin(start(self.seed, biclustering.len() as u64, self.left.total()));
            while self.step() {}
            biclustering.push(&self.end()?);
            found(self.left.total());
        }
        Some(biclustering)
    }

    /// The least key with which the insertion of a row, and of a column, may gain.
    fn least_keys(&self) -> [u32; 2] {
        [self.columns.inside.len() as u32 + 1, self.rows.inside.len() as u32 + 2]
    }

    /// Lines 5 and 6 of Algorithm 1: begins with a submatrix of one element.
    fn begin(&mut self, element: u64) {
        let (row, number) = self.left.find(element);
        let mut columns: Vec<u32> = self.rows.lines[row].iter().map(|entry| entry.index).collect();
        let (_, &mut column, _) = columns.select_nth_unstable(number as usize);
        self.insert_row(row as u32);
        self.insert_column(column);
    }

    /// Lines 7 to 20 of Algorithm 1: applies the operation with the largest gain; returns `false` if no gain is
    /// positive.
    fn step(&mut self) -> bool {
        let (r, l) = (self.rows.inside.len().cast_signed() as i64, self.columns.inside.len().cast_signed() as i64);
        let row = self.rows.best(2 * l + 1).filter(|operation| operation.gain > 0);
        let column = self.columns.best(2 * r + 2).filter(|operation| operation.gain > 0);
        let gain = |operation: Option<Operation>| operation.map_or(0, |operation| operation.gain);
        match (row, column) {
            // Gains of rows are odd and gains of columns even, so a row and a column never tie.
            (Some(Operation { line, .. }), _) if gain(row) > gain(column) => {
                if self.rows.places[line as usize] == OUTSIDE { self.insert_row(line) } else { self.delete_row(line) }
            }
            (_, Some(Operation { line, .. })) => {
                if self.columns.places[line as usize] == OUTSIDE {
                    self.insert_column(line);
                } else {
                    self.delete_column(line);
                }
            }
            _ => return false,
        }
        true
    }

    fn insert_row(&mut self, row: u32) {
        self.rows.insert(row);
        self.cross_columns(row, ColumnTally::add);
    }

    fn delete_row(&mut self, row: u32) {
        self.rows.delete(row);
        self.cross_columns(row, ColumnTally::remove);
        // With one row fewer inside, the insertion of further columns may gain.
        let [_, least] = self.least_keys();
        self.columns.queue_again(least);
    }

    /// Updates the tallies and keys of the columns that a row crosses.
    #[inline(always)]
    fn cross_columns(&mut self, row: u32, change: impl Fn(&mut ColumnTally, i32)) {
        let [_, least] = self.least_keys();
        let Self { rows, columns, tallies, values, .. } = self;
        for &MatrixEntry { index: column, value } in &rows.lines[row as usize] {
            let tally = &mut tallies[column as usize];
            change(tally, value);
            let key = column_key(tally, columns.places[column as usize], values[column as usize]);
            columns.set_key(column, key, least);
        }
    }

    fn insert_column(&mut self, column: u32) {
        self.values[column as usize] = self.tallies[column as usize].most_frequent();
        self.columns.insert(column);
        self.cross_rows(column, u32::wrapping_add);
    }

    fn delete_column(&mut self, column: u32) {
        self.columns.delete(column);
        let [least, least_column] = self.least_keys();
        // If it is inserted again, the column may gain with a different value.
        self.columns.set_key(column, self.tallies[column as usize].most_and_nonzeros(), least_column);
        self.cross_rows(column, u32::wrapping_sub);
        self.rows.queue_again(least);
    }

    /// Changes the keys of the rows that a column crosses: by 2 in rows with the column's value, by 1 in others.
    #[inline(always)]
    fn cross_rows(&mut self, column: u32, change: impl Fn(u32, u32) -> u32) {
        let ([least, _], t) = (self.least_keys(), self.values[column as usize]);
        let Self { rows, columns, .. } = self;
        for &MatrixEntry { index: row, value } in &columns.lines[column as usize] {
            rows.set_key(row, change(rows.keys[row as usize], 1 + u32::from(value == t)), least);
        }
    }

    /// Lines 15 and 16 of Algorithm 1: the finished bicluster, subtracted from the remaining matrix; `None` if a
    /// residual does not fit into 32 bits.
    fn end(&mut self) -> Option<Bicluster> {
        let bicluster = self.bicluster();
        for &MatrixEntry { index: column, value: t } in &bicluster.columns {
            let all = bicluster.rows.iter().map(|&row| MatrixEntry { index: row, value: t });
            self.columns.subtract(column, all, &self.rows.places, |_| t)?;
        }
        for &row in &bicluster.rows {
            let (places, values) = (&self.columns.places[..], &self.values);
            let all = bicluster.columns.iter().copied();
            let more = self.rows.subtract(row, all, places, |column| values[column as usize])?;
            self.left.add(row as usize, more);
        }
        self.columns.touched.iter().for_each(|&column| self.tallies[column as usize].clear());
        for side in [&mut self.rows, &mut self.columns] {
            side.reset();
        }
        Some(bicluster)
    }

    fn bicluster(&self) -> Bicluster {
        let entry = |&index: &u32| MatrixEntry { index, value: self.values[index as usize] };
        let mut rows = self.rows.inside.clone();
        let mut columns: Vec<MatrixEntry> = self.columns.inside.iter().map(entry).collect();
        rows.sort_unstable();
        columns.sort_unstable();
        Bicluster { rows, columns }
    }
}

/// Key of a column: for a column inside by its value, otherwise by its most frequent value.
#[inline]
fn column_key(tally: &ColumnTally, place: u32, value: i32) -> u32 {
    if place == OUTSIDE { tally.most_and_nonzeros() } else { tally.matches_and_nonzeros(value) }
}
