//! THE table of arithmetic operations: which there are, how many operands they take, and what defines them.
//!
//! The batch executor and the shaders name operations by it, `crossbar alu` and the GPU probe compute by it; none keeps
//! a list of its own.

use super::env::Env;
use super::flags::Outcome;
use super::ops;

macro_rules! operations {
    ($($(#[doc = $doc:literal])* $variant:ident($($operand:ident),+) $(= $definition:expr)?;)*) => {
        /// An operation on numbers of one format, on the words that packing instructions make, or on masks.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u32)]
        pub enum NumberOperation { $($(#[doc = $doc])* $variant,)* }

        impl NumberOperation {
            /// Every operation, in the order of the table.
            pub const ALL: [Self; [$(stringify!($variant)),*].len()] = [$(Self::$variant),*];

            /// How many operands it takes, 1 to 3.
            pub const fn operands(self) -> usize {
                match self { $(Self::$variant => [$(stringify!($operand)),+].len(),)* }
            }

            /// What it makes of bit patterns of the format, operands that it lacks ignored; `None` for operations whose
            /// operands or results are not all numbers of the format. Comparisons give 1 or 0.
            pub fn evaluate(self, env: impl Into<Env>, operands: [u32; 3]) -> Option<Outcome> {
                let env = env.into();
                match self { $(Self::$variant => operations!(@ env operands ($($operand),+) $($definition)?),)* }
            }
        }
    };
    (@ $env:ident $operands:ident ($($operand:ident),+) $definition:expr) => {{
        let [$($operand,)+ ..] = $operands;
        Some($definition($env, $($operand),+))
    }};
    (@ $env:ident $operands:ident ($($operand:ident),+)) => { None };
}

operations! {
    /// `a + b`
    Add(a, b) = ops::add;
    /// `a - b`
    Sub(a, b) = ops::sub;
    /// `a b`
    Mul(a, b) = ops::mul;
    /// `a / b`
    Div(a, b) = ops::div;
    /// `a b + c`, product and sum each rounded.
    Mad(a, b, c) = ops::mad;
    /// `a b + c`, rounded once.
    FusedMad(a, b, c) = ops::fused_mad;
    /// `a < b ? a : b`
    Min(a, b) = ops::min;
    /// `a >= b ? a : b`
    Max(a, b) = ops::max;
    /// `-a`
    Neg(a) = ops::neg;
    /// `|a|`
    Abs(a) = ops::abs;
    /// The largest integer not above `a`.
    Floor(a) = ops::floor;
    /// `a - floor(a)`
    Frc(a) = ops::frc;
    /// `1 / a`
    Rcp(a) = ops::rcp;
    /// `1 / sqrt(a)`
    Rsq(a) = ops::rsq;
    /// `2^a`
    Exp2(a) = ops::exp2;
    /// The logarithm of `a` to base 2.
    Log2(a) = ops::log2;
    /// `a` clamped to [0, 1].
    Saturate(a) = ops::saturate01;
    /// `a 2^b`, `b` an `i32`.
    Scale(a, b) = |env, a, b: u32| ops::scale(env, a, b.cast_signed());
    /// `a`, or 0 where one of `a`, `b` is zero and the other isn't finite.
    Factor(a, b);
    /// `a >= 0 ? b : c`
    SelectNonNegative(a, b, c) = ops::cmp;
    /// `a > 1/2 ? b : c`
    SelectAboveHalf(a, b, c) = ops::cnd;
    /// Mask (all ones or zero) of `a < b`.
    Less(a, b) = ops::lt;
    /// Mask of `a <= b`.
    LessEqual(a, b) = ops::le;
    /// Mask of `a == b`.
    Equal(a, b) = ops::eq;
    /// `a` rounded down in the format, as a saturated `i32`.
    AddressFloor(a);
    /// `a` rounded to the nearest even integer in the format, as a saturated `i32`.
    AddressNearest(a);
    /// Mask `a ? b : c`.
    Select(a, b, c);
    /// Bits of `a` and `b`.
    And(a, b);
    /// Bits of `a` or `b`.
    Or(a, b);
    /// Bits of `b` and not `a`.
    AndNot(a, b);
    /// Square root.
    Sqrt(a) = ops::sqrt;
    /// `a` of another format into this one; `b` says which.
    Convert(a, b);
    /// Single precision `a` clamped to [0, 1], rounded to `b` steps, halves up, and that fraction rounded into the
    /// format.
    Steps(a, b);
    /// The number behind a bit pattern.
    Decode(a);
    /// The bit pattern of a number.
    Encode(a);
    /// Sine, radians.
    Sin(a) = ops::sin;
    /// Cosine, radians.
    Cos(a) = ops::cos;
    /// Word `a` with `b`'s pattern of up to 16 bits at bit `c`, which was zero there.
    JoinPattern(a, b, c);
    /// Likewise single precision `b` clamped to [0, 1], to the nearest of 65535 steps.
    JoinShort(a, b, c);
    /// Likewise of 255 steps.
    JoinByte(a, b, c);
    /// Likewise `128 + 127 b`, `b` from -128/127 to 1; 128 for NaN.
    JoinSignedByte(a, b, c);
    /// The number whose pattern is at bit `b` of word `a`.
    SplitPattern(a, b);
    /// What [`Self::JoinShort`] put at bit `b` of word `a`.
    SplitShort(a, b);
    /// What [`Self::JoinByte`] put there.
    SplitByte(a, b);
    /// What [`Self::JoinSignedByte`] put there.
    SplitSignedByte(a, b);
}

impl NumberOperation {
    /// Whether its last operand is a plain integer, known before a program runs: a power of two, a place in a word.
    pub const fn has_immediate(self) -> bool {
        matches!(self, Self::Scale) || matches!(self as u32, first if first >= Self::JoinPattern as u32)
    }

    /// Whether it is one of masks, the same in every format.
    pub const fn is_of_masks(self) -> bool {
        matches!(self, Self::Select | Self::And | Self::Or | Self::AndNot)
    }
}
