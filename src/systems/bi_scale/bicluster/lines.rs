//! Rows or columns as lists of entries of variable length.

use crate::bi_scale::matrix::MatrixEntry;

/// Unordered lists of entries, one per line, in one array. A list that outgrows its capacity moves to the end.
#[derive(Debug)]
pub(super) struct Lines {
    entries: Vec<MatrixEntry>,
    begins: Vec<usize>,
    lengths: Vec<u32>,
    rooms: Vec<u32>,
}

/// Filler of unused capacity.
const NOTHING: MatrixEntry = MatrixEntry { index: u32::MAX, value: 0 };

impl Lines {
    /// Entries line by line, and the start of each line followed by the end of the last.
    pub(super) fn new(entries: Vec<MatrixEntry>, mut begins: Vec<usize>) -> Self {
        let lengths: Vec<u32> = begins.windows(2).map(|ends| (ends[1] - ends[0]) as u32).collect();
        begins.pop();
        Self { entries, begins, rooms: lengths.clone(), lengths }
    }

    /// The transposed lists, with `across` lines: columns from rows.
    pub(super) fn transposed(&self, across: usize) -> Self {
        let mut begins = vec![0; across + 1];
        self.entries.iter().for_each(|entry| begins[entry.index as usize + 1] += 1);
        (0..across).for_each(|line| begins[line + 1] += begins[line]);
        let mut ends = begins.clone();
        let mut entries = vec![NOTHING; self.entries.len()];
        for line in 0..self.begins.len() {
            for entry in self.get(line) {
                let end = &mut ends[entry.index as usize];
                entries[*end] = MatrixEntry { index: line as u32, value: entry.value };
                *end += 1;
            }
        }
        Self::new(entries, begins)
    }

    /// The number of lines.
    pub(super) fn len(&self) -> usize {
        self.begins.len()
    }

    /// The entries of a line.
    pub(super) fn get(&self, line: usize) -> &[MatrixEntry] {
        &self.entries[self.begins[line]..][..self.lengths[line] as usize]
    }

    /// Replaces each entry of a line by `change` of it, or removes it where that is `None`.
    pub(super) fn change(&mut self, line: usize, mut change: impl FnMut(MatrixEntry) -> Option<MatrixEntry>) {
        let begin = self.begins[line];
        let mut kept = begin;
        for at in begin..begin + self.lengths[line] as usize {
            if let Some(entry) = change(self.entries[at]) {
                self.entries[kept] = entry;
                kept += 1;
            }
        }
        self.lengths[line] = (kept - begin) as u32;
    }

    /// Adds entries to a line.
    pub(super) fn add(&mut self, line: usize, more: &[MatrixEntry]) {
        let old = self.begins[line]..self.begins[line] + self.lengths[line] as usize;
        let length = old.len() + more.len();
        if length > self.rooms[line] as usize {
            let room = length + length / 2;
            self.begins[line] = self.entries.len();
            self.rooms[line] = room as u32;
            self.entries.extend_from_within(old.clone());
            self.entries.resize(self.begins[line] + room, NOTHING);
        }
        self.entries[self.begins[line] + old.len()..][..more.len()].copy_from_slice(more);
        self.lengths[line] = length as u32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(index: u32, value: i32) -> MatrixEntry {
        MatrixEntry { index, value }
    }

    #[test]
    fn lines_change_and_grow() {
        let entries = vec![entry(0, 1), entry(2, 2), entry(1, 3), entry(2, 4)];
        let mut rows = Lines::new(entries, vec![0, 2, 2, 4]);
        let columns = rows.transposed(3);
        assert_eq!([0, 1, 2].map(|line| columns.get(line).len()), [1, 1, 2]);
        assert_eq!(columns.get(2), [entry(0, 2), entry(2, 4)]);
        rows.change(0, |old| (old.index != 0).then_some(entry(old.index, 9)));
        rows.add(0, &[entry(4, 5), entry(5, 6)]);
        rows.add(1, &[entry(7, 7)]);
        assert_eq!(rows.get(0), [entry(2, 9), entry(4, 5), entry(5, 6)]);
        assert_eq!((rows.get(1), rows.get(2)), (&[entry(7, 7)][..], &[entry(1, 3), entry(2, 4)][..]));
    }
}
