//! Arithmetic in WGSL: the text of the library and the words by which a shader is told a format.
//!
//! The definition is [`crate::num`]: the exact result, rounded once. The text computes with integers of 32 bits alone,
//! for every format, so its results are the same on every adapter that conforms to WGSL, whatever its own floating
//! point does.

use crate::num::{Denormals, Format, Kind, Overflow, Rounding, Specials};

/// What `n_alu` computes, by number: `operation as u32`. As [`crate::num::ops`] defines it, on raw values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u32)]
pub enum Operation {
    /// `a + b`
    Add,
    /// `a - b`
    Sub,
    /// `a b`
    Mul,
    /// `a / b`
    Div,
    /// Product and sum, each rounded: in shaders two operations.
    Mad,
    /// Product and sum, rounded once.
    FusedMad,
    /// `a < b ? a : b`
    Min,
    /// `a >= b ? a : b`
    Max,
    /// `-a`
    Neg,
    /// `|a|`
    Abs,
    /// The integer below.
    Floor,
    /// `a - floor a`
    Frc,
    /// `1 / a`
    Rcp,
    /// `1 / sqrt a`
    Rsq,
    /// `2^a`
    Exp2,
    /// Logarithm to base 2.
    Log2,
    /// Clamped to [0, 1].
    Saturate,
    /// `a 2^b`, `b` an `i32`.
    Scale,
    /// `a`, or 0 where one of `a`, `b` is zero and the other isn't finite.
    Factor,
    /// `a >= 0 ? b : c`
    SelectNonNegative,
    /// `a > 1/2 ? b : c`
    SelectAboveHalf,
    /// Mask (all ones or zero) of `a < b`.
    Less,
    /// Mask of `a <= b`.
    LessEqual,
    /// Mask of `a == b`.
    Equal,
    /// `a` rounded down in the format, as a saturated `i32`.
    AddressFloor,
    /// `a` rounded to the nearest even integer in the format, as a saturated `i32`.
    AddressNearest,
    /// Mask `a ? b : c`.
    Select,
    /// Bits.
    And,
    /// Bits.
    Or,
    /// `b` and not `a`.
    AndNot,
    /// Square root.
    Sqrt,
    /// `a` of another format into this one; `b` is [`source_word`] of that format.
    Convert,
    /// Single precision `a` clamped to [0, 1], rounded to `b` steps, halves up, and that fraction rounded into the
    /// format.
    Steps,
    /// Bit pattern to raw value.
    Decode,
    /// Raw value to bit pattern.
    Encode,
    /// Sine, radians.
    Sin,
    /// Cosine, radians.
    Cos,
    /// Word `a` with `b`'s pattern of up to 16 bits at bit `c`, which was zero there.
    JoinPattern,
    /// Likewise single precision `b` clamped to [0, 1], to the nearest of 65535 steps.
    JoinShort,
    /// Likewise of 255 steps.
    JoinByte,
    /// Likewise `128 + 127 b`, `b` from -128/127 to 1; 128 for NaN.
    JoinSignedByte,
    /// The number whose pattern is at bit `b` of word `a`.
    SplitPattern,
    /// What [`Self::JoinShort`] put at bit `b` of word `a`.
    SplitShort,
    /// What [`Self::JoinByte`] put there.
    SplitByte,
    /// What [`Self::JoinSignedByte`] put there.
    SplitSignedByte,
}

impl Operation {
    /// All operations, in the order of their numbers.
    pub const ALL: [Operation; 45] = [
        Self::Add,
        Self::Sub,
        Self::Mul,
        Self::Div,
        Self::Mad,
        Self::FusedMad,
        Self::Min,
        Self::Max,
        Self::Neg,
        Self::Abs,
        Self::Floor,
        Self::Frc,
        Self::Rcp,
        Self::Rsq,
        Self::Exp2,
        Self::Log2,
        Self::Saturate,
        Self::Scale,
        Self::Factor,
        Self::SelectNonNegative,
        Self::SelectAboveHalf,
        Self::Less,
        Self::LessEqual,
        Self::Equal,
        Self::AddressFloor,
        Self::AddressNearest,
        Self::Select,
        Self::And,
        Self::Or,
        Self::AndNot,
        Self::Sqrt,
        Self::Convert,
        Self::Steps,
        Self::Decode,
        Self::Encode,
        Self::Sin,
        Self::Cos,
        Self::JoinPattern,
        Self::JoinShort,
        Self::JoinByte,
        Self::JoinSignedByte,
        Self::SplitPattern,
        Self::SplitShort,
        Self::SplitByte,
        Self::SplitSignedByte,
    ];

    /// Its number in the shader.
    pub const fn word(self) -> u32 {
        self as u32
    }

    /// The constant that means it in the shader: `N_` and its name in capitals.
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

/// A format as the shader's `struct Format` has it: kind, integer or exponent bits, fraction or mantissa bits,
/// rounding, overflow, denormals, special values, and a word to spare.
///
/// Rules without meaning for the kind are replaced by the kind's default, as [`Format`] has it.
pub fn format_words(format: &Format) -> [u32; 8] {
    let (kind, upper, frac) = match format.kind {
        Kind::Fixed { int_bits, frac_bits } => (0, int_bits, frac_bits),
        Kind::Float { exp_bits, man_bits } => (1, exp_bits, man_bits),
    };
    let rounding = match format.rounding {
        Rounding::NearestEven => 0,
        Rounding::NearestAway => 1,
        Rounding::TowardZero => 2,
        Rounding::Down => 3,
    };
    let overflow = match (format.overflow, format.is_fixed()) {
        (Overflow::Wrap, true) => 1,
        (Overflow::Saturate, _) | (_, true) => 0,
        (Overflow::Infinity | Overflow::Wrap, false) => 2,
        (Overflow::Nv30, false) => 3,
    };
    let flush = u32::from(format.denormals == Denormals::Flush);
    let special = u32::from(format.specials == Specials::Nv);
    [kind, upper.into(), frac.into(), rounding, overflow, flush, special, 0]
}

/// The operand `b` by which [`Operation::Convert`] knows the format that `a` comes from.
pub fn source_word(format: &Format) -> u32 {
    match format.kind {
        Kind::Fixed { frac_bits, .. } => 1 + u32::from(frac_bits),
        Kind::Float { .. } => 0,
    }
}

/// The text of the library: `struct Format`, the functions `n_...` for any format and `s_...` for single precision.
pub fn library() -> String {
    let constants =
        Operation::ALL.map(|operation| format!("const {}: u32 = {}u;\n", operation.constant(), operation.word()));
    let parts = [
        include_str!("number/format.wgsl"),
        include_str!("number/arithmetic.wgsl"),
        include_str!("number/circle.wgsl"),
        include_str!("number/packing.wgsl"),
        include_str!("number/alu.wgsl"),
        include_str!("number/dot.wgsl"),
        include_str!("number/single.wgsl"),
    ];
    constants.concat() + &parts.join("\n")
}
