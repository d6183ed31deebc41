//! Lane operations: what scheduled blocks consist of.

use crate::exec::lower::Slot;
use crate::num::NumberOperation;

/// What a lane operation computes: an operation of the table, or several in one pass over the lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LaneCode {
    Plain(NumberOperation),
    /// An operation whose last operand is this integer.
    Immediate(NumberOperation, i8),
    /// Right neighbour less left one, or (if true) lower less upper, for both.
    Neighbors(bool),
    /// `a` into the wide row; the wide row, rounded, into the destination.
    Widen,
    Narrow,
    /// So many products, 2 to 4, summed exactly and rounded once.
    Dot(u8),
    /// So many products, 2 to 4, added in order, each product and each sum rounded.
    Sum(u8),
    /// Likewise, 1 to 4, with the first factor of each the same in all lanes.
    SumBy(u8),
    /// `a b - c d`, every step rounded.
    Difference,
    /// Operations whose `a` is the same in all lanes: `a + b`, `a - b`, `b - a`, `a b + c` in two roundings.
    AddTo,
    SubFrom,
    SubOff,
    MadBy,
    /// `a`, or the mask of `b < c`.
    OrLess,
}

impl LaneCode {
    /// How many slots the operation reads.
    pub(crate) fn arity(self) -> usize {
        match self {
            Self::Plain(operation) => operation.operands(),
            Self::Immediate(operation, _) => operation.operands() - 1,
            Self::Neighbors(_) | Self::Widen | Self::Narrow => 1,
            Self::AddTo | Self::SubFrom | Self::SubOff => 2,
            Self::MadBy | Self::OrLess => 3,
            Self::Difference => 4,
            Self::Dot(terms) | Self::Sum(terms) | Self::SumBy(terms) => 2 * usize::from(terms),
        }
    }

    /// Whether the operand is read as a number that all lanes share, and not as a row.
    pub(crate) fn is_shared(self, operand: usize) -> bool {
        match self {
            Self::SumBy(_) => operand.is_multiple_of(2),
            Self::AddTo | Self::SubFrom | Self::SubOff | Self::MadBy => operand == 0,
            _ => false,
        }
    }

    /// Whether a guarded arithmetic may be wrong about an infinite result or a NaN of this operation.
    pub(crate) fn is_guarded(self) -> bool {
        use NumberOperation::{Add, Div, Mad, Mul, Rcp, Sub};
        match self {
            Self::Plain(operation) => matches!(operation, Add | Sub | Mul | Mad | Div | Rcp),
            Self::Immediate(..) | Self::Widen | Self::Narrow | Self::Dot(_) | Self::OrLess => false,
            _ => true,
        }
    }
}

/// Slots that an operation reads at most.
pub(crate) const OPERANDS: usize = 8;

/// One operation on whole rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LaneOp {
    pub(crate) code: LaneCode,
    pub(crate) to: Slot,
    /// The operands `a`, `b`, `c`, or the factors of one product after the other.
    pub(crate) args: [Slot; OPERANDS],
    /// Whether products with a zero are zero, whatever the other factor is.
    pub(crate) zero_wins: bool,
}

impl LaneOp {
    /// An operation on one row.
    pub(crate) fn of_one(code: LaneCode, to: Slot, a: Slot) -> Self {
        Self { code, to, args: [a; OPERANDS], zero_wins: false }
    }
}
