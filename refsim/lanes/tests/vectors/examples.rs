//! Examples of the rules; each line is one case that a rule decides.

use refsim_lanes::num::unit::{nv, nv_functions};
use refsim_lanes::num::{Flags, NumberOperation as Op, Unit, ops};

use super::table::{evaluate, format};

use Unit::{Gt200, Gt200ZeroWins, Nv2x, Nv3x, Nv3xLegacy};

/// An operation, the units that agree on it, operands and result.
type Example = (Op, &'static [Unit], [u32; 3], u32);

const ALL: &[Unit] = &[Nv2x, Nv3xLegacy, Nv3x];
const NEW: &[Unit] = &[Nv3xLegacy, Nv3x];
const BOTH: &[Unit] = &[Gt200, Gt200ZeroWins];

const EXAMPLES: [Example; 54] = [
    (Op::Mul, ALL, [0x3fff_ffff, 0x3fff_ffff, 0], 0x407f_fffe),
    (Op::Mul, &[Nv2x], [0x7f00_0000, 0xc000_0000, 0], 0xff7f_ffff),
    (Op::Mul, NEW, [0x7f00_0000, 0xc000_0000, 0], 0xff80_0000),
    (Op::Mul, ALL, [0x0080_0000, 0xbf00_0000, 0], 0x8000_0000),
    (Op::Mul, ALL, [0x8000_0000, 0xbf80_0000, 0], 0),
    (Op::Mul, &[Nv2x, Nv3xLegacy], [0x8000_0000, 0x7f80_0000, 0], 0),
    (Op::Mul, &[Nv3x], [0x8000_0000, 0x7f80_0000, 0], 0x7fff_ffff),
    (Op::Add, ALL, [0xc015_1eb8, 0xc2c8_0000, 0], 0xc2cc_a8f5),
    (Op::Add, ALL, [0x3f80_0000, 0xb380_0000, 0], 0x3f7f_ffff),
    (Op::Add, ALL, [0x3f80_0000, 0xb000_0000, 0], 0x3f80_0000),
    (Op::Add, &[Nv2x], [0x8080_0001, 0x0080_0000, 0], 0x8000_0000),
    (Op::Add, &[Nv2x], [0x0180_0000, 0x0040_0000, 0], 0x0188_0000),
    (Op::Add, NEW, [0x0180_0000, 0x0040_0000, 0], 0x0180_0000),
    (Op::Add, &[Nv2x], [0x7f7f_ffff, 0x7f7f_ffff, 0], 0x7f7f_ffff),
    (Op::Add, NEW, [0x7f7f_ffff, 0x7f7f_ffff, 0], 0x7f80_0000),
    (Op::Rcp, ALL, [0x4040_0000, 0, 0], 0x3eaa_aaaa),
    (Op::Rcp, ALL, [0x3f80_0001, 0, 0], 0x3f7f_fffd),
    (Op::Rcp, ALL, [0x7e80_0001, 0, 0], 0),
    (Op::Rsq, &[Nv2x], [0x3f80_0000, 0, 0], 0x3f7f_ffff),
    (Op::Rsq, NEW, [0x3f80_0000, 0, 0], 0x3f80_0000),
    (Op::Rsq, ALL, [0x4000_0000, 0, 0], 0x3f35_04f3),
    (Op::Rsq, ALL, [0x41c8_0000, 0, 0], 0x3e4c_cccc),
    (Op::ExpFloor, ALL, [0x3fc0_0000, 0, 0], 0x4000_0000),
    (Op::ExpFraction, ALL, [0x3fc0_0000, 0, 0], 0x3f00_0000),
    (Op::ExpPower, ALL, [0x3fc0_0000, 0, 0], 0x4035_0600),
    (Op::ExpFloor, ALL, [0x7fc0_0000, 0, 0], 0x7f80_0000),
    (Op::LogExponent, ALL, [0x4040_0000, 0, 0], 0x3f80_0000),
    (Op::LogMantissa, ALL, [0x4040_0000, 0, 0], 0x3fc0_0000),
    (Op::LogPower, ALL, [0x4040_0000, 0, 0], 0x3fca_e3c0),
    (Op::LitDiffuse, ALL, [0x3f00_0000, 0, 0], 0x3f00_0000),
    (Op::LitSpecular, ALL, [0x3f00_0000, 0x3f00_0000, 0x4180_0000], 0x3780_0000),
    (Op::Exp2, NEW, [0x3f80_0000, 0, 0], 0x4000_0001),
    (Op::Exp2, NEW, [0xbf80_0000, 0, 0], 0x3eff_ffff),
    (Op::Exp2, NEW, [0, 0, 0], 0x3f80_0000),
    (Op::Sin, NEW, [0x3000_0000, 0, 0], 0x3f68_c7b6),
    (Op::Sin, NEW, [0x3f80_0000, 0, 0], 0x3f57_6aa4),
    (Op::Cos, NEW, [0x3f80_0000, 0, 0], 0x3f0a_5140),
    (Op::Sin, NEW, [0x4049_0fdb, 0, 0], 0xb400_0000),
    (Op::Mul, BOTH, [0x0080_0000, 0x3f7f_ffff, 0], 0),
    (Op::Mul, BOTH, [0x00ff_ffff, 0x3f00_0001, 0], 0x0080_0000),
    (Op::Mad, BOTH, [0x3fff_ffff, 0x3fff_ffff, 0xc080_0000], 0xb500_0000),
    (Op::Mad, BOTH, [0x3fff_ffff, 0x3fff_ffff, 0x8000_0000], 0x407f_fffe),
    (Op::Mad, BOTH, [0x7f00_0000, 0x4000_0000, 0xff7f_ffff], 0x7380_0000),
    (Op::Mul, &[Gt200ZeroWins], [0x7fc0_0000, 0x8000_0000, 0], 0),
    (Op::Rcp, BOTH, [0x4040_0000, 0, 0], 0x3eaa_aaab),
    (Op::Rcp, BOTH, [0x3f80_0001, 0, 0], 0x3f7f_fffe),
    (Op::Rsq, BOTH, [0x4000_0000, 0, 0], 0x3f35_04f2),
    (Op::Log2, BOTH, [0x4040_0000, 0, 0], 0x3fca_e00d),
    (Op::Sin, BOTH, [0x3f80_0000, 0, 0], 0x3f57_6aa3),
    (Op::Cos, BOTH, [0x3f80_0000, 0, 0], 0x3f0a_5141),
    (Op::Sin, BOTH, [0x4049_0fdb, 0, 0], 0),
    (Op::Exp2, BOTH, [0x3f80_0000, 0, 0], 0x4000_0000),
    (Op::Exp2, BOTH, [0x3f00_0000, 0, 0], 0x3fb5_04f3),
    (Op::Neg, ALL, [0x7f80_0001, 0, 0], 0xff80_0001),
];

#[test]
fn examples_of_the_rules() {
    for (operation, units, operands, result) in EXAMPLES {
        for &unit in units {
            let found = evaluate(format(unit), operation, operands);
            assert_eq!(found, result, "{operation:?} {operands:08x?} of {unit:?}: {found:08x}, not {result:08x}");
        }
    }
}

#[test]
fn sums_of_three_are_made_at_once() {
    for &unit in ALL {
        assert_eq!(nv::sum(unit, &[0x4b80_0000, 0x3f80_0000, 0xcb80_0000]), 0x3f80_0000);
        assert_eq!(nv::sum(unit, &[0x4e80_0000, 0x3f80_0000, 0xce80_0000]), 0);
    }
}

#[test]
fn a_distance_vector_passes_words_on() {
    let (a, b) = ([1, 0x4000_0000, 0x7f80_0001, 2], [3, 0x4040_0000, 4, 5]);
    assert_eq!(nv::dst(Nv2x, a, b), [0x3f80_0000, 0x40c0_0000, 0x7f80_0001, 5]);
}

#[test]
fn clamped_reciprocals() {
    assert_eq!(nv_functions::rcc(0x0000_0001), 0x5f80_0000);
    assert_eq!(nv_functions::rcc(0xff80_0000), 0x9f80_0000);
}

#[test]
fn what_makes_a_nan_is_invalid() {
    let card = format(Nv3x);
    let (zero, infinity, nan) = (0, 0x7f80_0000, 0x7fc0_0000);
    assert_eq!(ops::mul(card, zero, infinity).flags, Flags::INVALID);
    assert_eq!(ops::mul(card, zero, nan).flags, Flags::empty());
    assert_eq!(ops::mul(card, 0x7f00_0000, 0x7f00_0000).flags, Flags::empty());
}

#[test]
fn units_have_their_operations_and_no_others() {
    for operation in [Op::ExpPower, Op::LogPower, Op::LitSpecular, Op::Sign] {
        assert!(operation.evaluate(format(Gt200), [0; 3]).is_none());
    }
    for operation in [Op::ExpPower, Op::SetLess, Op::Sign] {
        assert!(operation.evaluate(format(Unit::Ideal), [0; 3]).is_none());
    }
}

#[test]
fn words_enter_as_they_are_and_leave_as_numbers() {
    let (card, plain) = (format(Nv2x), format(Unit::Ideal));
    for (word, left) in [(0x7f80_0001, 0x7fc0_0000), (0x8000_0001, 0x8000_0000), (0x3f80_0001, 0x3f80_0001)] {
        assert_eq!(ops::convert(&plain, card, word).bits, word);
        assert_eq!(ops::convert(&card, plain, word).bits, left);
    }
}
