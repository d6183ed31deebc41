//! Lane operations: what scheduled blocks consist of.

use crate::exec::lower::{NodeOperation, Slot};

/// Slots that an operation reads at most.
pub(crate) const OPERANDS: usize = 8;

/// One operation on whole rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LaneOp {
    pub(crate) code: NodeOperation,
    pub(crate) to: Slot,
    /// The operands `a`, `b`, `c`, or the factors of one product after the other.
    pub(crate) args: [Slot; OPERANDS],
}
