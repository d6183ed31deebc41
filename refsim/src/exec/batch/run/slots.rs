//! Where a batch keeps its values: one array of 256 lanes for each component that is live, and plain numbers for what
//! is the same in all lanes.

use crate::exec::batch::lanes::{LANES, LaneRow};
use crate::exec::lower::Slot;

/// A row where vectors of 64 bytes don't straddle cache lines.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(crate) struct Aligned(LaneRow);

impl Aligned {
    fn zeros() -> Box<Self> {
        Box::new(Self([0; LANES]))
    }
}

impl std::ops::Deref for Aligned {
    type Target = LaneRow;

    fn deref(&self) -> &LaneRow {
        &self.0
    }
}

impl std::ops::DerefMut for Aligned {
    fn deref_mut(&mut self) -> &mut LaneRow {
        &mut self.0
    }
}

/// The slots of one batch, and a spare row that results are made in before they change places with what they replace.
#[derive(Clone, Debug)]
pub(crate) struct Slots {
    #[expect(clippy::vec_box, reason = "a row changes places with the spare one by its pointer, not by its 1 KiB")]
    pub(crate) rows: Vec<Box<Aligned>>,
    pub(crate) scratch: Box<Aligned>,
    /// What slots of constants and given values hold in every lane.
    pub(crate) values: Vec<u32>,
    /// Slots whose value is wanted as a row too.
    as_rows: Vec<bool>,
    /// Doubles on their way from one format to another.
    pub(crate) wide: Box<[f64; LANES]>,
}

impl Slots {
    /// So many slots, all zero.
    pub(crate) fn new(count: usize) -> Self {
        Self {
            rows: std::iter::repeat_with(Aligned::zeros).take(count).collect(),
            scratch: Aligned::zeros(),
            values: vec![0; count],
            as_rows: vec![true; count],
            wide: Box::new([0.0; LANES]),
        }
    }

    /// Marks a slot that is read only as a number, never as a row.
    pub(crate) fn without_row(&mut self, slot: Slot) {
        self.as_rows[usize::from(slot)] = false;
    }

    pub(crate) fn row(&self, slot: Slot) -> &LaneRow {
        &self.rows[usize::from(slot)]
    }

    pub(crate) fn row_mut(&mut self, slot: Slot) -> &mut LaneRow {
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

    /// As [`Slots::fill`], for a slot of a given value, which nothing else writes: cheap where it holds the value
    /// already, and where the row is not read.
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
