//! Arithmetic in WGSL: the text of the number library, and the encoding of formats in words.
//!
//! It implements [`crate::num`]: the exact result, rounded once. It uses 32-bit integer arithmetic for every format, so
//! its results are the same on every adapter that conforms to WGSL, whatever the adapter's floating point.

mod unit_tables;

use crate::num::{Denormals, Encoding, Format, FormatKind, NumberOperation, Overflow, Rounding, Specials, Unit};

/// Encodes a format as the shader's `struct Format`: kind, integer or exponent bits, fraction or mantissa bits,
/// rounding, overflow, denormals, special values, and the denominator of a normalized format, else 0. Shaders treat a
/// normalized format as fixed point without fraction bits, and divide its numbers by the denominator. The field of
/// special values encodes the unit of GT200, from 2 on; no shader computes in the vertex units of cards.
///
/// Rules that do not apply to the kind are replaced by its default, as in [`Format`].
pub fn format_words(format: &Format) -> [u32; 8] {
    let (kind, upper, frac) = match format.kind {
        FormatKind::Fixed { int_bits, frac_bits } => (0, int_bits, frac_bits),
        FormatKind::Normalized { int_bits, frac_bits } => (0, int_bits + frac_bits, 0),
        FormatKind::Float { exp_bits, man_bits } => (float_word(format), exp_bits, man_bits),
    };
    let rounding = match format.rounding {
        Rounding::NearestEven => 0,
        Rounding::NearestAway => 1,
        // Devices reject stochastic rounding (`Format::for_registers`).
        Rounding::TowardZero | Rounding::Stochastic(_) => 2,
        Rounding::Down => 3,
        Rounding::Up => 4,
        Rounding::Odd => 5,
    };
    let overflow = match (format.overflow, format.is_fixed()) {
        (Overflow::Wrap, true) => 1,
        (Overflow::Saturate, _) | (_, true) => 0,
        (Overflow::Infinity | Overflow::Wrap, false) => 2,
        (Overflow::Nv30, false) => 3,
    };
    let flush = u32::from(format.denormals == Denormals::Flush);
    let special = match format.unit {
        Unit::Gt200 => 2,
        Unit::Gt200ZeroWins => 3,
        _ => u32::from(format.specials == Specials::Nv),
    };
    [kind, upper.into(), frac.into(), rounding, overflow, flush, special, denominator_word(format)]
}

/// The kind of a float: 1 for IEEE 754, 2 without infinity, 3 without infinity or NaN, 4 without -0.
fn float_word(format: &Format) -> u32 {
    match format.encoding {
        Encoding::Ieee => 1,
        Encoding::Finite if format.canonical_nan().is_some() => 2,
        Encoding::Finite => 3,
        Encoding::UnsignedZero | Encoding::Scale => 4,
    }
}

fn denominator_word(format: &Format) -> u32 {
    if let FormatKind::Normalized { .. } = format.kind { format.denominator() } else { 0 }
}

/// Operand `b` of [`NumberOperation::Convert`] that encodes the format of `a`.
pub fn source_word(format: &Format) -> u32 {
    match format.kind {
        FormatKind::Fixed { frac_bits, .. } => 1 + u32::from(frac_bits),
        FormatKind::Normalized { .. } => 1 | denominator_word(format) << 8,
        FormatKind::Float { .. } => match format.unit {
            Unit::Gt200 | Unit::Gt200ZeroWins => 1 << 31,
            _ => 0,
        },
    }
}

/// The text of the number library: `struct Format`, functions `n_...` for any format and `s_...` for single precision.
///
/// The text of GT200's unit is in a separate section ([`super::parts`]).
pub fn library() -> String {
    let constants = |of_units: bool| -> String {
        let operations = operations().filter(|operation| operation.is_of_units() == of_units);
        operations.map(|operation| format!("const {}: u32 = {}u;\n", operation.constant(), operation.word())).collect()
    };
    let parts = [
        include_str!("number/format.wgsl"),
        include_str!("number/arithmetic.wgsl"),
        include_str!("number/circle.wgsl"),
        include_str!("number/packing.wgsl"),
        include_str!("number/alu.wgsl"),
        concat!(include_str!("number/dot.wgsl"), include_str!("number/aligned.wgsl")),
        include_str!("number/single.wgsl"),
    ];
    let gt200 = concat!(include_str!("number/unit.wgsl"), include_str!("number/unit_gt200.wgsl"));
    let units = constants(true) + gt200 + &unit_tables::gt200();
    let section = format!("// begin HAS_UNITS\nconst HAS_UNITS: bool = true;\n{units}// end HAS_UNITS\n");
    constants(false) + &parts.join("\n") + &section
}

pub(super) fn operations() -> impl Iterator<Item = NumberOperation> {
    NumberOperation::ALL.into_iter().filter(|operation| !operation.is_of_vertex_units())
}
