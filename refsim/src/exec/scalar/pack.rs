//! Packing of numbers into a 32-bit word (`PK2H`, `PK2US`, `PK4B`, `PK4UB`), and unpacking. Source:
//! GL_NV_fragment_program.

use super::registers::Components;
use crate::exec::{FragmentFormats, unorm_steps};
use crate::isa::Opcode;
use crate::num::{self, Format, ops};

/// Packs a full-precision vector. Integers are rounded to nearest, halves up; NaN gives 0 (the extension leaves both
/// open).
pub(super) fn pack(formats: &FragmentFormats, opcode: Opcode, value: &Components) -> u32 {
    let single = |i: usize| ops::convert(&formats.full, Format::FP32, value[i]).bits;
    match opcode {
        Opcode::Pk2h => {
            let half = |i: usize| ops::convert(&formats.full, formats.half, value[i]).bits & 0xffff;
            half(0) | half(1) << 16
        }
        Opcode::Pk2us => unorm_steps(single(0), 65535) | unorm_steps(single(1), 65535) << 16,
        Opcode::Pk4ub => (0..4).fold(0, |word, i| word | unorm_steps(single(i), 255) << (8 * i)),
        _ => (0..4).fold(0, |word, i| word | signed_byte(single(i)) << (8 * i)),
    }
}

/// Contents of a register after a word is written to it: the word, if `format` is a 32-bit float, else the number
/// encoded by the word's lower bits.
pub(super) fn stored_word(format: Format, word: u32) -> u32 {
    if format.width() == 32 && !format.is_fixed() {
        word
    } else {
        ops::convert(&format, format, word & format.mask()).bits
    }
}

/// Computes `128 + 127 x`, with x clamped to [-128/127, 1], rounded to nearest, halves up.
fn signed_byte(bits: u32) -> u32 {
    let (negative, magnitude) = (bits >> 31 == 1, bits & 0x7fff_ffff);
    if magnitude > 0x7f80_0000 {
        return 128;
    }
    if !negative {
        return 128 + unorm_steps(magnitude, 127);
    }
    let field = magnitude >> 23;
    if field >= 128 {
        return 0; // -2 and beyond
    }
    // |x| = significand / 2^down; floor(1/2 - 127 |x|) is -floor((2 * 127 * significand + 2^down - 1) / 2^(down + 1)).
    let (significand, down) = match field {
        0 => (magnitude, 149),
        _ => ((magnitude & 0x007f_ffff) | 0x0080_0000, 150 - field),
    };
    let doubled = 254 * u128::from(significand);
    let down_steps = match down {
        ..100 => (doubled + (1u128 << down) - 1) >> (down + 1),
        _ => 0,
    };
    128 - u32::try_from(down_steps).unwrap_or(128).min(128)
}

/// Unpacks a register's bits into a full-precision vector.
pub(super) fn unpack(formats: &FragmentFormats, opcode: Opcode, word: u32) -> Components {
    let full = formats.full;
    let ratio = |k: u32, steps: u128| num::from_ratio(full, false, k.into(), steps).bits;
    match opcode {
        Opcode::Up2h => {
            let half =
                |shift: u32| ops::convert(&formats.half, full, word >> shift & formats.half.mask() & 0xffff).bits;
            [half(0), half(16), half(0), half(16)]
        }
        Opcode::Up2us => {
            let short = |shift: u32| ratio(word >> shift & 0xffff, 65535);
            [short(0), short(16), short(0), short(16)]
        }
        Opcode::Up4ub => [0, 8, 16, 24].map(|shift| ratio(word >> shift & 0xff, 255)),
        _ => [0, 8, 16, 24].map(|shift| {
            let k = word >> shift & 0xff;
            num::from_ratio(full, k < 128, k.abs_diff(128).into(), 127).bits
        }),
    }
}
