//! Where a batch keeps its values: one array of 256 lanes for each component that is live, and plain numbers for what is
//! the same in all lanes.

use super::lane::LANES;

/// Index of a slot.
pub(crate) type Slot = u16;

/// All lanes of one value. What the 32 bits mean is the business of whoever reads them: host bits of a lane
/// arithmetic's numbers, a mask (0 or all ones), an integer.
pub(crate) type Row = [u32; LANES];

/// The value of a mask where it holds.
pub(crate) const TRUE: u32 = u32::MAX;

/// The slots of one batch, and a spare row that results are made in before they change places with what they replace.
///
/// They may be used for one block after another ([`Slots::prepare`]); rows are allocated once.
#[derive(Clone, Debug)]
pub(crate) struct Slots {
    #[expect(clippy::vec_box, reason = "a row changes places with the spare one by its pointer, not by its 1 KiB")]
    pub(crate) rows: Vec<Box<Row>>,
    pub(crate) scratch: Box<Row>,
    /// What slots of constants and given values hold in every lane.
    pub(crate) values: Vec<u32>,
    /// Slots whose value is wanted as a row too.
    as_rows: Vec<bool>,
    /// Doubles on their way from one format to another.
    pub(crate) wide: Box<[f64; LANES]>,
}

impl Slots {
    /// So many slots, all zero, every one with a row.
    pub(crate) fn new(count: usize) -> Self {
        let zeros = Box::new([0; LANES]);
        let mut slots = Self {
            rows: Vec::new(),
            scratch: zeros,
            values: Vec::new(),
            as_rows: Vec::new(),
            wide: Box::new([0.0; LANES]),
        };
        slots.resize(count);
        slots
    }

    /// Makes the slots those of another block: all that are given a value are zero, the others hold anything.
    /// `as_rows` says of each slot whether anybody reads it as a row.
    pub(crate) fn prepare(&mut self, count: usize, as_rows: &[bool]) {
        self.resize(count);
        for (slot, &wanted) in as_rows.iter().enumerate().take(count) {
            self.as_rows[slot] = wanted;
            if wanted {
                self.rows[slot].fill(0);
            }
        }
    }

    fn resize(&mut self, count: usize) {
        while self.rows.len() < count {
            self.rows.push(Box::new([0; LANES]));
        }
        self.values.clear();
        self.values.resize(count, 0);
        self.as_rows.clear();
        self.as_rows.resize(count, true);
    }

    pub(crate) fn row(&self, slot: Slot) -> &Row {
        &self.rows[usize::from(slot)]
    }

    pub(crate) fn row_mut(&mut self, slot: Slot) -> &mut Row {
        &mut self.rows[usize::from(slot)]
    }

    /// The scratch row becomes the slot's row.
    pub(crate) fn commit(&mut self, slot: Slot) {
        std::mem::swap(&mut self.rows[usize::from(slot)], &mut self.scratch);
    }

    /// Puts a value that is the same in all lanes into a slot.
    pub(crate) fn fill(&mut self, slot: Slot, raw: u32) {
        self.values[usize::from(slot)] = raw;
        self.row_mut(slot).fill(raw);
    }

    /// As [`Slots::fill`], for a slot that nothing else writes: cheap where it holds the value already or where nobody reads
    /// the row.
    pub(crate) fn give(&mut self, slot: Slot, raw: u32) {
        let i = usize::from(slot);
        if self.values[i] != raw {
            self.values[i] = raw;
            if self.as_rows[i] {
                self.rows[i].fill(raw);
            }
        }
    }
}
