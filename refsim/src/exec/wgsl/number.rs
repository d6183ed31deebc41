//! Arithmetic in WGSL: the text of the library and the words by which a shader is told a format.
//!
//! The definition is [`crate::num`]: the exact result, rounded once. The text computes with integers of 32 bits alone,
//! for every format, so its results are the same on every device that conforms to WGSL, whatever the device's own
//! floating point does. [`NumberMode::Native`] replaces single precision operations by the device's own where a probe
//! has found them exact.

use std::fmt::Write;

use bitflags::bitflags;
use serde::{Deserialize, Serialize};

use crate::num::{Denormals, Format, FormatKind, NumberOperation, Overflow, Rounding, Specials};

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

/// How shaders name the operations of the table. Values are raw; comparisons give masks.
impl NumberOperation {
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

/// The operand `b` by which [`NumberOperation::Convert`] knows the format that `a` comes from.
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
    for operation in NumberOperation::ALL {
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
