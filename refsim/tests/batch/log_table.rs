//! The batch executor's logarithms for levels of detail.

#[path = "../../src/exec/batch/run/log_table.rs"]
mod table;

use refsim::texture::{Image, TexelFormat, TextureKind, lod_from_derivatives};
use table::LogTable;

use crate::environment::by_form;

/// Compares with `texture`: derivatives of every magnitude, along the only axis of a one-texel texture. The squares
/// cover few single-precision significands; the next test covers all.
#[test]
fn levels_are_those_of_the_texture_room() {
    let image = Image::new(TexelFormat::L8, TextureKind::D1, [1, 1, 1], 1).unwrap();
    for bits in 0..=8 {
        let table = LogTable::new(bits);
        for pattern in (0..=0x7f80_0001u32).step_by(9973).chain([0, 1, 0x7f7f_ffff, 0x7f80_0000, 0x7fc0_0000]) {
            let expected = lod_from_derivatives(&image, [0; 4], [pattern, 0, 0, 0], [0; 4], bits);
            let length = f32::from_bits(pattern);
            assert_eq!(table.half_log2(length * length).to_bits(), expected, "{pattern:#x}, {bits} bits");
        }
    }
}

/// Compares with squaring in integers with 62 bits kept, for all significands (by default for one in eleven).
#[test]
fn every_significand_has_its_logarithm() {
    let step = by_form(11, 1);
    let table = LogTable::new(8);
    assert_eq!([0.0, f32::INFINITY, f32::NAN].map(|x| table.half_log2(x)), [-127.0, 127.0, 0.0]);
    for fraction in (0..1u32 << 23).step_by(step) {
        let mut mantissa = u128::from(fraction | 1 << 23) << (62 - 23);
        let mut expected = 0;
        for _ in 0..8 {
            mantissa = (mantissa * mantissa) >> 62;
            let carry = mantissa >> 63;
            mantissa >>= carry;
            expected = 2 * expected + carry as i32;
        }
        for exponent in [0, 1] {
            let x = f32::from_bits(fraction | (127 + exponent) << 23);
            let found = table.half_log2(x) * 256.0;
            assert_eq!(found as i32, (expected + (exponent << 8).cast_signed()) >> 1, "{x}");
        }
    }
}
