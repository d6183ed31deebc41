//! Storage of a batch: an array of 256 lanes per live component, and scalars for uniform values.

use super::code::Slot;
use crate::lanes::{LANES, LaneRow};

/// A row aligned so that 64-byte vectors don't straddle cache lines.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct Aligned(LaneRow);

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

/// The slots of one batch, and a scratch row in which results are computed before it is swapped with their slot's row.
#[derive(Clone, Debug)]
pub struct Slots {
    #[expect(clippy::vec_box, reason = "rows are swapped by pointer, not by copying 1 KiB")]
    pub(super) rows: Vec<Box<Aligned>>,
    pub(super) scratch: Box<Aligned>,
    pub(super) values: Vec<u32>,
    /// `false` for slots of which only the uniform value is read.
    as_rows: Vec<bool>,
    /// Doubles passed from one conversion step to the next.
    pub(super) wide: Box<[f64; LANES]>,
}

impl Slots {
    /// Creates `count` slots, all zero.
    pub fn new(count: usize) -> Self {
        Self {
            rows: std::iter::repeat_with(Aligned::zeros).take(count).collect(),
            scratch: Aligned::zeros(),
            values: vec![0; count],
            as_rows: vec![true; count],
            wide: Box::new([0.0; LANES]),
        }
    }

    /// Marks a slot of which only the uniform value is read.
    pub fn without_row(&mut self, slot: Slot) {
        self.as_rows[usize::from(slot)] = false;
    }

    /// The row of a slot.
    pub fn row(&self, slot: Slot) -> &LaneRow {
        &self.rows[usize::from(slot)]
    }

    /// The row of a slot, to be written.
    pub fn row_mut(&mut self, slot: Slot) -> &mut LaneRow {
        &mut self.rows[usize::from(slot)]
    }

    /// The doubles passed from one conversion step to the next.
    pub fn wide_mut(&mut self) -> &mut [f64; LANES] {
        &mut self.wide
    }

    /// Swaps the rows of two slots.
    pub fn swap(&mut self, a: Slot, b: Slot) {
        self.rows.swap(a.into(), b.into());
    }

    /// Swaps the scratch row with the slot's row.
    pub(super) fn commit(&mut self, slot: Slot) {
        std::mem::swap(&mut self.rows[usize::from(slot)], &mut self.scratch);
    }

    /// Sets a slot to a uniform value.
    pub fn fill(&mut self, slot: Slot, raw: u32) {
        self.values[usize::from(slot)] = raw;
        self.row_mut(slot).fill(raw);
    }

    /// [`Slots::fill`] for a slot that nothing else writes. It is cheap if the slot already has the value, or if its
    /// row is never read.
    pub fn give(&mut self, slot: Slot, raw: u32) {
        let i = usize::from(slot);
        if self.values[i] != raw {
            self.values[i] = raw;
            if self.as_rows[i] {
                self.rows[i].fill(raw);
            }
        }
    }
}
