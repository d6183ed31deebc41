//! Maps operations to functions of a unit.

use super::operation::UnitOperation;
use super::word::{NAN, ONE, SIGN, Word};
use super::{gt200, gt200_functions, nv, nv_functions};
use crate::num::flags::{Flags, Outcome};
use crate::num::format::Format;
use crate::num::rules::{Rounding, Unit};
use std::cmp::Ordering;

/// The outcome of a card's operation, with `INVALID` if the result is NaN and no operand is.
fn outcome(bits: u32, operands: &[u32]) -> Outcome {
    let made = Word::of(bits).is_nan() && !operands.iter().any(|&operand| Word::of(operand).is_nan());
    Outcome::new(bits, if made { Flags::INVALID } else { Flags::empty() })
}

/// Evaluates an operation by a format's unit. `None` in ideal formats, and if the unit lacks the operation.
pub(in crate::num) fn evaluate(format: &Format, operation: UnitOperation, operands: &[u32]) -> Option<Outcome> {
    let mut all = [0; 3];
    for (place, &operand) in all.iter_mut().zip(operands) {
        *place = operand;
    }
    let bits = match format.unit {
        Unit::Ideal => None,
        unit => common(unit, operation, all).or_else(|| match unit {
            Unit::Gt200 | Unit::Gt200ZeroWins => gt200(unit, format.rounding, operation, all),
            _ => vertex(unit, operation, all),
        }),
    };
    bits.map(|bits| outcome(bits, operands))
}

/// Operations that all units compute alike.
fn common(unit: Unit, operation: UnitOperation, [a, b, _]: [u32; 3]) -> Option<u32> {
    use UnitOperation::{Abs, Neg, SetEqual, SetLess, SetLessEqual, SetNotEqual};
    let holds: fn(Ordering) -> bool = match operation {
        Neg => return Some(a ^ SIGN),
        Abs => return Some(a & !SIGN),
        SetLess => Ordering::is_lt,
        SetLessEqual => Ordering::is_le,
        SetEqual => Ordering::is_eq,
        SetNotEqual => Ordering::is_ne,
        _ => return None,
    };
    Some(match (order(unit, a, b), unit) {
        (Some(order), _) => ONE * u32::from(holds(order)),
        (None, Unit::Nv3x) => NAN,
        // IEEE 754: unordered words are unequal, and every other relation is false.
        (None, _) => ONE * u32::from(operation == SetNotEqual),
    })
}

/// Compares two words in the order of a unit; `None` if they are unordered. Ideal formats compare words as sign and
/// magnitude.
pub(in crate::num) fn order(unit: Unit, a: u32, b: u32) -> Option<Ordering> {
    match unit {
        Unit::Gt200 | Unit::Gt200ZeroWins => gt200::compare(a, b),
        _ => nv::compare(unit, a, b),
    }
}

/// The sum of products by a format's unit; `None` in ideal formats.
pub(in crate::num) fn dot(format: &Format, terms: &[(u32, u32)]) -> Option<Outcome> {
    let bits = match format.unit {
        Unit::Ideal => return None,
        unit @ (Unit::Gt200 | Unit::Gt200ZeroWins) => gt200::dot(unit, format.rounding, terms),
        unit => nv::dot(unit, terms),
    };
    let operands: Vec<u32> = terms.iter().flat_map(|&(a, b)| [a, b]).collect();
    Some(outcome(bits, &operands))
}

fn vertex(unit: Unit, operation: UnitOperation, [a, b, c]: [u32; 3]) -> Option<u32> {
    use UnitOperation as Op;
    Some(match operation {
        Op::Add => nv::add(unit, a, b),
        Op::Sub => nv::add(unit, a, b ^ SIGN),
        Op::Mul => nv::mul(unit, a, b),
        Op::Mad | Op::FusedMad => nv::mad(unit, a, b, c),
        Op::Min => nv::min(unit, a, b),
        Op::Max => nv::max(unit, a, b),
        Op::Floor => nv::floor(a),
        Op::Frc => nv::frc(unit, a),
        Op::Rcp => nv_functions::rcp(a),
        Op::Rsq => nv_functions::rsq(unit, a),
        Op::Exp2 if unit != Unit::Nv2x => nv_functions::ex2(a),
        Op::Log2 if unit != Unit::Nv2x => nv_functions::lg2(a),
        Op::Sin if unit != Unit::Nv2x => nv_functions::sin(a),
        Op::Cos if unit != Unit::Nv2x => nv_functions::cos(a),
        Op::ExpFloor => nv_functions::exp_floor(a),
        Op::ExpFraction => nv_functions::exp_fraction(a),
        Op::ExpPower => nv_functions::exp_power(a),
        Op::LogExponent => nv_functions::log_exponent(unit, a),
        Op::LogMantissa => nv_functions::log_mantissa(unit, a),
        Op::LogPower => nv_functions::log_power(unit, a),
        Op::LitDiffuse => nv_functions::lit_diffuse(a),
        Op::LitSpecular => nv_functions::lit_specular(a, b, c),
        Op::Sign => nv::sign(unit, a),
        _ => return None,
    })
}

fn gt200(unit: Unit, rounding: Rounding, operation: UnitOperation, [a, b, c]: [u32; 3]) -> Option<u32> {
    use UnitOperation as Op;
    Some(match operation {
        Op::Add => gt200::add(rounding, a, b),
        Op::Sub => gt200::add(rounding, a, b ^ SIGN),
        Op::Mul => gt200::mul(unit, rounding, a, b),
        Op::Mad | Op::FusedMad => gt200::mad(unit, a, b, c),
        Op::Min => gt200::min(a, b),
        Op::Max => gt200::max(a, b),
        Op::Floor => gt200::floor(a),
        // Drivers subtract, because the chip has no such instruction.
        Op::Frc => gt200::add(rounding, a, gt200::floor(a) ^ SIGN),
        Op::Rcp => gt200_functions::rcp(a),
        Op::Rsq => gt200_functions::rsq(a),
        Op::Exp2 => gt200_functions::ex2(a),
        Op::Log2 => gt200_functions::lg2(a),
        Op::Sin => gt200_functions::sin(a),
        Op::Cos => gt200_functions::cos(a),
        Op::Saturate => gt200::saturate(a),
        Op::Scale => gt200::scale(rounding, a, b.cast_signed()),
        _ => return None,
    })
}
