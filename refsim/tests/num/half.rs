//! fp16 compared with rustc_apfloat.

use rayon::prelude::*;
use refsim::num::{Flags, Format, Outcome, Rounding, ops};
use rustc_apfloat::ieee::{Half, Single};
use rustc_apfloat::{Float, FloatConvert, Round, Status, StatusAnd};

use crate::environment::{by_form, is_full};

pub(crate) const MODES: [(Rounding, Round); 3] = [
    (Rounding::NearestEven, Round::NearestTiesToEven),
    (Rounding::TowardZero, Round::TowardZero),
    (Rounding::Up, Round::TowardPositive),
];

/// Converts apfloat's status to flags.
pub(crate) fn flags(status: Status) -> Flags {
    let mut flags = Flags::empty();
    flags.set(Flags::INEXACT, status.contains(Status::INEXACT));
    flags.set(Flags::UNDERFLOW, status.contains(Status::UNDERFLOW));
    flags.set(Flags::OVERFLOW, status.contains(Status::OVERFLOW));
    flags.set(Flags::DIVIDE_BY_ZERO, status.contains(Status::DIV_BY_ZERO));
    flags.set(Flags::INVALID, status.contains(Status::INVALID_OP));
    flags
}

/// Compares bits (NaN as a class) and flags.
///
/// apfloat calls a result tiny if it is still subnormal after rounding to the subnormal grid; `num` rounds to the full
/// precision first, as in IEEE 754. They differ only where the result is the smallest normal number. Also, apfloat
/// raises no overflow where rounding toward zero gives the largest finite number; IEEE 754 does. The flags excluded
/// here are compared with exact fractions in `small`.
pub(crate) fn agree<F: Float>(f: &Format, ours: Outcome, theirs: StatusAnd<F>) -> Result<(), String> {
    let expected = theirs.value.to_bits() as u32;
    let same_bits = ours.bits == expected || (theirs.value.is_nan() && Some(ours.bits) == f.canonical_nan());
    let mut mask = Flags::all();
    let magnitude = ours.bits & !f.sign_bit();
    if !f.is_subnormal(magnitude) && f.is_subnormal(magnitude.wrapping_sub(1)) {
        mask.remove(Flags::UNDERFLOW);
    }
    if magnitude == f.max_finite() {
        mask.remove(Flags::OVERFLOW);
    }
    if same_bits && ours.flags & mask == flags(theirs.status) & mask {
        return Ok(());
    }
    Err(format!("{f}: found {:#x} {:?}, expected {expected:#x} {:?}", ours.bits, ours.flags, flags(theirs.status)))
}

type Ours = fn(Format, u32, u32) -> Outcome;
type Theirs = fn(Half, Half, Round) -> StatusAnd<Half>;

/// All first operands with `CROSSBAR_FULL=1`, otherwise every n-th pattern and the limits of every range.
fn first_operands() -> Vec<u32> {
    if is_full() {
        return (0..=0xffff).collect();
    }
    let edges = [0, 1, 2, 0x3ff, 0x400, 0x401, 0x3bff, 0x3c00, 0x3c01, 0x7bff, 0x7c00, 0x7c01, 0x7e00];
    edges.iter().flat_map(|e| [*e, e | 0x8000]).chain((0..0x1_0000).step_by(2039)).collect()
}

fn all_pairs(name: &str, ours: Ours, theirs: Theirs) {
    for (rounding, round) in MODES {
        let f = Format::FP16.with_rounding(rounding);
        first_operands().par_iter().for_each(|&a| {
            let half_a = Half::from_bits(a.into());
            for b in 0..=0xffff {
                let result = agree(&f, ours(f, a, b), theirs(half_a, Half::from_bits(b.into()), round));
                assert!(result.is_ok(), "{name} {a:#06x} {b:#06x}: {}", result.unwrap_err());
            }
        });
    }
}

#[test]
fn every_pair_equals_apfloat() {
    all_pairs("add", ops::add, Half::add_r);
    all_pairs("sub", ops::sub, Half::sub_r);
    all_pairs("mul", ops::mul, Half::mul_r);
    all_pairs("div", ops::div, Half::div_r);
}

#[test]
fn conversion_from_single_equals_apfloat() {
    // An odd stride visits every exponent and, over all exponents, every low mantissa pattern.
    let stride = by_form(1021, 1);
    for (rounding, round) in MODES {
        let f = Format::FP16.with_rounding(rounding);
        (0..=u32::MAX / stride).into_par_iter().for_each(|i| {
            let bits = i * stride;
            let theirs: StatusAnd<Half> = Single::from_bits(bits.into()).convert_r(round, &mut false);
            let result = agree(&f, ops::convert(&Format::FP32, f, bits), theirs);
            assert!(result.is_ok(), "convert {bits:#010x}: {}", result.unwrap_err());
        });
    }
}
