//! Table of the arithmetic operations: operands and definition of each.
//!
//! The batch executor and the shader generator refer to operations by this table; `crossbar alu` and the GPU probe
//! evaluate operations through it.

use super::env::Env;
use super::flags::Outcome;
use super::unit::UnitOperation;
use super::{ops, unit};

macro_rules! operations {
    ($($(#[doc = $doc:literal])* $variant:ident($($operand:ident),+) $(= $definition:expr)? $(=> $unit:expr)?;)*) => {
        /// An operation on numbers of one format, on the words that packing instructions write, or on masks.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u32)]
        pub enum NumberOperation { $($(#[doc = $doc])* $variant,)* }

        impl NumberOperation {
            /// Every operation, in the order of the table.
            pub const ALL: [Self; [$(stringify!($variant)),*].len()] = [$(Self::$variant),*];

            /// Number of operands, 1 to 3.
            pub const fn operands(self) -> usize {
                match self { $(Self::$variant => [$(stringify!($operand)),+].len(),)* }
            }

            /// Evaluates the operation on bit patterns of the format; surplus operands are ignored. `None` for
            /// operations whose operands or results are not all numbers of the format, and for operations of a card's
            /// unit in other formats. Comparisons return 1 or 0.
            pub fn evaluate(self, env: impl Into<Env>, operands: [u32; 3]) -> Option<Outcome> {
                let env = env.into();
                match self { $(Self::$variant => operations!(@ self env operands ($($operand),+) $($definition)? $(=> $unit)?),)* }
            }
        }
    };
    (@ $operation:ident $env:ident $operands:ident ($($operand:ident),+) => $unit:expr) => {
        unit::evaluate(&$env.format, $unit, &$operands[..$operation.operands()])
    };
    (@ $operation:ident $env:ident $operands:ident ($($operand:ident),+) $definition:expr) => {{
        let [$($operand,)+ ..] = $operands;
        Some($definition($env, $($operand),+))
    }};
    (@ $operation:ident $env:ident $operands:ident ($($operand:ident),+)) => { None };
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
    /// `a`, or 0 where one of `a`, `b` is zero and the other isn't finite (so that 0 times anything is 0).
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
    /// `a ? b : c`, where `a` is a mask.
    Select(a, b, c);
    /// Bitwise `a & b`.
    And(a, b);
    /// Bitwise `a | b`.
    Or(a, b);
    /// Bitwise `!a & b`.
    AndNot(a, b);
    /// Square root.
    Sqrt(a) = ops::sqrt;
    /// Converts `a` from another format, given by `b`, into this one.
    Convert(a, b);
    /// Clamps single-precision `a` to [0, 1], rounds it to a multiple of `1/b`, halves up, and rounds that fraction
    /// into the format.
    Steps(a, b);
    /// Decodes a bit pattern into a number.
    Decode(a);
    /// Encodes a number as a bit pattern.
    Encode(a);
    /// Sine, radians.
    Sin(a) = ops::sin;
    /// Cosine, radians.
    Cos(a) = ops::cos;
    /// Inserts `b`'s pattern of up to 16 bits into word `a` at bit `c`, where `a` is zero.
    JoinPattern(a, b, c);
    /// Inserts single-precision `b`, clamped to [0, 1] and rounded to a multiple of 1/65535, like `JoinPattern`.
    JoinShort(a, b, c);
    /// Inserts `b`, clamped to [0, 1] and rounded to a multiple of 1/255, like `JoinPattern`.
    JoinByte(a, b, c);
    /// Inserts `128 + 127 b`, `b` from -128/127 to 1, like `JoinPattern`; NaN gives 128.
    JoinSignedByte(a, b, c);
    /// Extracts the number whose pattern is at bit `b` of word `a`.
    SplitPattern(a, b);
    /// Extracts the fraction that [`Self::JoinShort`] stored at bit `b` of word `a`.
    SplitShort(a, b);
    /// Extracts a fraction stored by [`Self::JoinByte`].
    SplitByte(a, b);
    /// Extracts a number stored by [`Self::JoinSignedByte`].
    SplitSignedByte(a, b);
    /// x of the vertex units' EXP: `2^floor(a)`.
    ExpFloor(a) => UnitOperation::ExpFloor;
    /// y of EXP: `a - floor(a)`.
    ExpFraction(a) => UnitOperation::ExpFraction;
    /// z of EXP: `2^a`, to about 11 bits.
    ExpPower(a) => UnitOperation::ExpPower;
    /// x of the vertex units' LOG: the exponent of `|a|`.
    LogExponent(a) => UnitOperation::LogExponent;
    /// y of LOG: the significand of `a`, in [1, 2).
    LogMantissa(a) => UnitOperation::LogMantissa;
    /// z of LOG: `log2 |a|`, to about 11 bits.
    LogPower(a) => UnitOperation::LogPower;
    /// y of the vertex units' LIT: `a`, or 0 if its sign is set.
    LitDiffuse(a) => UnitOperation::LitDiffuse;
    /// z of LIT: `a > 0 ? b^c : 0`.
    LitSpecular(a, b, c) => UnitOperation::LitSpecular;
    /// 1 if `a < b`, else 0, by the unit of a card; modern NV3x gives NaN for NaN.
    SetLess(a, b) => UnitOperation::SetLess;
    /// 1 if `a <= b`, else 0; NaN as in `SetLess`.
    SetLessEqual(a, b) => UnitOperation::SetLessEqual;
    /// 1 if `a == b`, else 0; NaN as in `SetLess`.
    SetEqual(a, b) => UnitOperation::SetEqual;
    /// 1 if `a != b`, else 0; NaN as in `SetLess`.
    SetNotEqual(a, b) => UnitOperation::SetNotEqual;
    /// -1, 0 or 1 as `a` compares with +0 (SSG of the vertex units).
    Sign(a) => UnitOperation::Sign;
}

impl NumberOperation {
    /// Returns `true` if the last operand is an integer constant known before the program runs: an exponent, or a bit
    /// position.
    pub const fn has_immediate(self) -> bool {
        matches!(self, Self::Scale)
            || self as u32 >= Self::JoinPattern as u32 && self as u32 <= Self::SplitSignedByte as u32
    }

    /// Returns `true` if only units of cards have this operation.
    pub const fn is_of_units(self) -> bool {
        self as u32 >= Self::ExpFloor as u32
    }

    /// Returns `true` if only vertex units of cards have this operation.
    pub const fn is_of_vertex_units(self) -> bool {
        let number = self as u32;
        matches!(self, Self::Sign) || number >= Self::ExpFloor as u32 && number <= Self::LitSpecular as u32
    }

    /// Returns `true` if the operation is bitwise, the same in every format.
    pub const fn is_of_masks(self) -> bool {
        matches!(self, Self::Select | Self::And | Self::Or | Self::AndNot)
    }
}

/// Names of the operations in shaders. Values are raw; comparisons return masks.
impl NumberOperation {
    /// Number of the operation in shaders.
    pub const fn word(self) -> u32 {
        self as u32
    }

    /// Name of the operation's constant in shaders: `N_`, then the operation's name in capitals.
    pub fn constant(self) -> String {
        let mut name = String::from("N");
        for (i, c) in format!("{self:?}").chars().enumerate() {
            if c.is_ascii_uppercase() || i == 0 {
                name.push('_');
            }
            name.push(c.to_ascii_uppercase());
        }
        name
    }
}
