//! The operations that nodes compute.

/// What an operation computes from up to three rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum NodeOperation {
    Add,
    Sub,
    Mul,
    Div,
    /// Product and sum, rounded one after the other.
    Mad,
    FusedMad,
    Min,
    Max,
    Neg,
    Abs,
    Floor,
    Frc,
    Rcp,
    Rsq,
    Exp2,
    Log2,
    Saturate,
    /// Times two to this power.
    Scale(i8),
    /// `a`, or 0 where the legacy rule for zero times anything replaces both factors `a` and `b`.
    Factor,
    /// `a >= 0 ? b : c`
    SelectNonNegative,
    /// `a > 1/2 ? b : c`
    SelectAboveHalf,
    /// Mask of `a < b`, `a <= b`, `a == b`.
    Less,
    LessEqual,
    Equal,
    /// Right neighbour less left one, for both; lower less upper.
    DifferenceX,
    DifferenceY,
    /// `a` rounded down or to the nearest even integer in the format, as a saturated integer.
    AddressFloor,
    AddressNearest,
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
    /// `a`, with `b` at this bit: its pattern of up to 16 bits; clamped to [0, 1] in 16 or 8 bits; from -1 to 1 in 8.
    JoinPattern(u8),
    JoinShort(u8),
    JoinByte(u8),
    JoinSignedByte(u8),
    /// What those put at this bit of `a`.
    SplitPattern(u8),
    SplitShort(u8),
    SplitByte(u8),
    SplitSignedByte(u8),
    /// The pattern of `a`, and the number of a pattern.
    ToBits,
    FromBits,
    /// Mask operations: `a ? b : c`, and, or, `b and not a`.
    Select,
    And,
    Or,
    AndNot,
}

impl NodeOperation {
    /// How many operands the operation reads.
    pub(crate) fn arity(self) -> usize {
        match self {
            NodeOperation::JoinPattern(_)
            | NodeOperation::JoinShort(_)
            | NodeOperation::JoinByte(_)
            | NodeOperation::JoinSignedByte(_) => 2,
            NodeOperation::Add
            | NodeOperation::Sub
            | NodeOperation::Mul
            | NodeOperation::Div
            | NodeOperation::Min
            | NodeOperation::Max
            | NodeOperation::Factor => 2,
            NodeOperation::Less
            | NodeOperation::LessEqual
            | NodeOperation::Equal
            | NodeOperation::And
            | NodeOperation::Or
            | NodeOperation::AndNot => 2,
            NodeOperation::Mad
            | NodeOperation::FusedMad
            | NodeOperation::SelectNonNegative
            | NodeOperation::SelectAboveHalf
            | NodeOperation::Select => 3,
            NodeOperation::AddTo | NodeOperation::SubFrom | NodeOperation::SubOff => 2,
            NodeOperation::MadBy | NodeOperation::OrLess => 3,
            NodeOperation::Difference => 4,
            NodeOperation::Dot(terms) | NodeOperation::Sum(terms) | NodeOperation::SumBy(terms) => {
                2 * usize::from(terms)
            }
            _ => 1,
        }
    }
}
