//! Lane operations.

use crate::lanes::drops_small_halves;
use crate::num::{Format, NumberOperation};

/// The number of a row.
pub type Slot = u16;

/// Code of a lane operation: an operation of the table, or several of them fused into one pass over the lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LaneCode {
    /// An operation on rows.
    Plain(NumberOperation),
    /// An operation whose last operand is this integer.
    Immediate(NumberOperation, i8),
    /// Right minus left neighbour, or (if `true`) lower minus upper; both lanes get the difference.
    Neighbors(bool),
    /// Copies `a` to the wide row.
    Widen,
    /// Copies `a` to the wide row, to be converted to half floats by a unit that flushes small numbers.
    WidenToHalf,
    /// Rounds the wide row to the destination.
    Narrow,
    /// 2 to 4 products, summed exactly and rounded once.
    Dot(u8),
    /// 2 to 4 products, added in order, each product and each sum rounded.
    Sum(u8),
    /// [`Self::Sum`] with uniform first factors, of 1 to 4 products.
    SumBy(u8),
    /// `a b - c d`, each step rounded.
    Difference,
    /// `a + b`; in this and the next operations `a` is uniform.
    AddTo,
    /// `a - b`
    SubFrom,
    /// `b - a`
    SubOff,
    /// `a b + c` with two roundings.
    MadBy,
    /// Bitwise or of the mask `a` and the mask of `b < c`.
    OrLess,
}

impl LaneCode {
    /// The code that copies numbers of one format to the wide row, from which they are rounded to another format.
    pub fn widen(from: &Format, to: &Format) -> Self {
        if drops_small_halves(from, to) { Self::WidenToHalf } else { Self::Widen }
    }

    /// Number of slots read.
    pub fn arity(self) -> usize {
        match self {
            Self::Plain(operation) => operation.operands(),
            Self::Immediate(operation, _) => operation.operands() - 1,
            Self::Neighbors(_) | Self::Widen | Self::WidenToHalf | Self::Narrow => 1,
            Self::AddTo | Self::SubFrom | Self::SubOff => 2,
            Self::MadBy | Self::OrLess => 3,
            Self::Difference => 4,
            Self::Dot(terms) | Self::Sum(terms) | Self::SumBy(terms) => 2 * usize::from(terms),
        }
    }

    /// Returns `true` if the operand is read as a uniform value instead of a row.
    pub fn is_shared(self, operand: usize) -> bool {
        match self {
            Self::SumBy(_) => operand.is_multiple_of(2),
            Self::AddTo | Self::SubFrom | Self::SubOff | Self::MadBy => operand == 0,
            _ => false,
        }
    }

    /// Returns `true` if a fast arithmetic may get infinite or NaN results of this operation wrong.
    pub(super) fn is_guarded(self) -> bool {
        use NumberOperation::{Add, Div, Mad, Mul, Rcp, Sub};
        match self {
            Self::Plain(operation) => matches!(operation, Add | Sub | Mul | Mad | Div | Rcp),
            Self::Immediate(..) | Self::Widen | Self::WidenToHalf => false,
            Self::Narrow | Self::Dot(_) | Self::OrLess => false,
            _ => true,
        }
    }
}

/// Maximum number of slots read by an operation.
pub const OPERANDS: usize = 8;

/// An operation on whole rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LaneOp {
    /// The operation.
    pub code: LaneCode,
    /// The row of the results.
    pub to: Slot,
    /// The operands `a`, `b`, `c`, or the factors of one product after the other.
    pub args: [Slot; OPERANDS],
    /// `true` if a product with a zero factor is always zero.
    pub zero_wins: bool,
}

impl LaneOp {
    /// An operation on one row.
    pub fn of_one(code: LaneCode, to: Slot, a: Slot) -> Self {
        Self { code, to, args: [a; OPERANDS], zero_wins: false }
    }
}
