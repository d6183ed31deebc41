//! Arithmetic in WGSL: the text of the library and the words by which a shader is told a format.
//!
//! The definition is [`crate::num`]: the exact result, rounded once. The text computes with integers of 32 bits alone,
//! for every format, so its results are the same on every device that conforms to WGSL, whatever the device's own
//! floating point does. [`NumberMode::Native`] replaces single precision operations by the device's own where a probe
//! has found them exact.

use std::fmt::Write;

use bitflags::bitflags;
use serde::{Deserialize, Serialize};

use crate::num::{Denormals, Format, FormatKind, Overflow, Rounding, Specials};

/// How a shader computes in single precision.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum NumberMode {
    /// Integers alone: the same bits on every conforming device.
    #[default]
    Integer,
    /// The device's `f32` where [`NativeOperations`] says so; every other format as in integer mode.
    Native,
}

bitflags! {
    /// Single precision operations that a device's own `f32` carries out.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub struct NativeOperations: u32 {
        /// Addition and subtraction.
        const ADD = 1;
        /// Multiplication.
        const MUL = 2;
        /// Product and sum, each rounded (`a * b + c` that the compiler doesn't contract).
        const MUL_ADD = 4;
        /// Division and reciprocal.
        const DIV = 8;
        /// Square root.
        const SQRT = 16;
        /// From 32-bit integers.
        const CONVERT = 32;
        /// Minimum, maximum and comparisons.
        const MIN_MAX = 64;
        /// Floor.
        const FLOOR = 128;
    }
}

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
    /// Product and sum, each rounded.
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
    /// Single precision `a` clamped to [0, 1], rounded to `b` steps, halves up, and that fraction rounded into the format.
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
        FormatKind::Fixed { int_bits, frac_bits } => (0, int_bits, frac_bits),
        FormatKind::Float { exp_bits, man_bits } => (1, exp_bits, man_bits),
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
        FormatKind::Fixed { frac_bits, .. } => 1 + u32::from(frac_bits),
        FormatKind::Float { .. } => 0,
    }
}

/// The text of the library: `struct Format`, the functions `n_...` for any format and `s_...` for single precision.
///
/// Integer mode takes no notice of `native`. In native mode the operations in `native` are the device's own `f32` ones, for
/// binary32 with nearest even rounding, kept subnormals and infinities only.
pub fn library(mode: NumberMode, native: NativeOperations) -> String {
    let mut text = String::new();
    // Writing to a string can't fail.
    for operation in Operation::ALL {
        let _ = writeln!(text, "const {}: u32 = {}u;", operation.constant(), operation.word());
    }
    let mode_text = match mode {
        NumberMode::Integer => include_str!("number/integer.wgsl"),
        NumberMode::Native => {
            let _ = writeln!(text, "const N_NATIVE: u32 = {}u;", native.bits());
            for (name, flag) in NativeOperations::all().iter_names() {
                let _ = writeln!(text, "const N_NATIVE_{name}: u32 = {}u;", flag.bits());
            }
            include_str!("number/native.wgsl")
        }
    };
    for part in [
        include_str!("number/format.wgsl"),
        include_str!("number/arithmetic.wgsl"),
        include_str!("number/circle.wgsl"),
        include_str!("number/packing.wgsl"),
        mode_text,
        include_str!("number/alu.wgsl"),
        include_str!("number/named.wgsl"),
        include_str!("number/single.wgsl"),
    ] {
        text.push_str(part);
        text.push('\n');
    }
    text
}
