//! Examples of the rules; each line is one case that a rule decides.

use refsim_lanes::num::unit::{nv, nv_functions};
use refsim_lanes::num::{Flags, NumberOperation as Op, Unit, ops};

use super::table::format;

use Unit::{Gt200, Nv2x, Nv3x, Nv3xLegacy};

const ALL: &[Unit] = &[Nv2x, Nv3xLegacy, Nv3x];

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
