//! Where a batch keeps its values: one array of 256 lanes for each component that is live.

use super::lane::LANES;

/// Index of a slot.
pub(crate) type Slot = u16;

/// All lanes of one value. What the 32 bits mean is the business of whoever reads them: host bits of a lane
/// arithmetic's numbers, a mask (0 or all ones), an integer.
pub(crate) type Row = [u32; LANES];

/// The value of a mask where it holds.
pub(crate) const TRUE: u32 = u32::MAX;

/// The slots of one batch, and a spare row that results are made in before they change places with what they replace.
#[derive(Clone, Debug)]
pub(crate) struct Slots {
    #[expect(clippy::vec_box, reason = "a row changes places with the spare one by its pointer, not by its 1 KiB")]
    pub(crate) rows: Vec<Box<Row>>,
    pub(crate) scratch: Box<Row>,
    /// Doubles on their way from one format to another.
    pub(crate) wide: Box<[f64; LANES]>,
}

impl Slots {
    pub(crate) fn new(count: usize) -> Self {
        Self { rows: vec![Box::new([0; LANES]); count], scratch: Box::new([0; LANES]), wide: Box::new([0.0; LANES]) }
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

    pub(crate) fn fill(&mut self, slot: Slot, raw: u32) {
        self.row_mut(slot).fill(raw);
    }
}
