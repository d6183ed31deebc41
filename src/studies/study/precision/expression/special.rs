//! Results of operations on NaN, infinities and zeros, and at poles, as C has them.

use std::cmp::Ordering;

use num_traits::Signed;

use super::arithmetic::{Arithmetic, Number, PRECISIONS};
use super::real::{Constant, Dyadic, End, Function, Interval, Real, apply};

impl Arithmetic {
    /// Results of NaN, infinities, zeros and poles, as C has them.
    pub(super) fn special(self, function: Function, operands: &[u64], numbers: &[Number]) -> Option<u64> {
        use Function as F;
        let nan = || Some(self.nan());
        let (zero, one) = (self.encode(&End::At(Dyadic::new(0, 0))), self.encode(&End::At(Dyadic::new(1, 0))));
        match (function, numbers) {
            (F::Min | F::Max, [x, y]) => {
                let second = match self.order(operands[0], operands[1]) {
                    _ if *x == Number::Nan => true,
                    _ if *y == Number::Nan => false,
                    order => order.is_some_and(|order| if function == F::Min { order.is_gt() } else { order.is_lt() }),
                };
                Some(operands[usize::from(second)])
            }
            (F::CopySign, [x, y]) if *x != Number::Nan => {
                let is_negative = matches!(y, Number::Infinite(true) | Number::Finite(_, true));
                let magnitude = self.native(F::Abs, &operands[..1])?;
                if is_negative { self.native(F::Negate, &[magnitude]) } else { Some(magnitude) }
            }
            (F::Pow, [x, y]) => self.special_power(x, y, one),
            (F::Hypot, [x, y]) if [x, y].iter().any(|x| matches!(x, Number::Infinite(_))) => Some(self.infinity(false)),
            _ if numbers.contains(&Number::Nan) => nan(),
            (F::Atan2, [_, Number::Infinite(_)]) | (F::Atan2, [Number::Infinite(_), _]) => {
                // The angle of a point of the same quadrant.
                let part = |x: &Number| match x {
                    Number::Infinite(negative) => {
                        if *negative {
                            -1
                        } else {
                            1
                        }
                    }
                    _ => 0,
                };
                let [y, x] = [part(&numbers[0]).abs(), part(&numbers[1])].map(|x| Real::Range(Interval::integer(x)));
                let angle =
                    PRECISIONS.iter().find_map(|&bits| match apply(F::Atan2, &[y.clone(), x.clone()], bits) {
                        Real::Range(range) => self.decided(&range),
                        _ => None,
                    })?;
                Some(if numbers[0].is_negative() { self.signed(angle, true) } else { angle })
            }
            (F::Atan2, [Number::Finite(y, negative), Number::Finite(x, backward)]) if y.is_zero() => {
                let angle = if *backward { Interval::integer(-1) } else { Interval::integer(1) };
                let of = [Real::Range(Interval::integer(0)), Real::Range(angle)];
                let angle =
                    if x.is_zero() || *backward { apply(F::Atan2, &of, 128) } else { return Some(operands[0]) };
                let Real::Range(range) = angle else { return nan() };
                Some(self.signed(self.decided(&range)?, *negative))
            }
            (F::Floor | F::Ceil | F::Trunc | F::Round | F::NearbyInt, [Number::Infinite(_)]) | (F::Cast, _) => {
                Some(operands[0])
            }
            (F::Mod, [_, Number::Infinite(_)]) if !matches!(numbers[0], Number::Infinite(_)) => Some(operands[0]),
            (F::Dim, [x, y]) if matches!((x, y), (Number::Infinite(_), _) | (_, Number::Infinite(_))) => {
                let is_above = self.order(operands[0], operands[1]).is_some_and(Ordering::is_gt);
                Some(if is_above { self.infinity(false) } else { zero })
            }
            (_, [Number::Infinite(negative)]) => Some(self.limit(function, *negative)),
            (_, [Number::Infinite(_), _]) => nan(),
            // Odd functions keep the sign of a zero.
            (F::Log | F::Log2 | F::Log10, [Number::Finite(x, _)]) if x.is_zero() => Some(self.infinity(true)),
            (F::Exp | F::Exp2 | F::Cos | F::Acos | F::Cosh | F::Acosh, _) => None,
            (_, [Number::Finite(x, _)]) if x.is_zero() => Some(operands[0]),
            (F::Log1P | F::Atanh, [Number::Finite(x, negative)])
                if *x == Dyadic::new(if *negative { -1 } else { 1 }, 0) =>
            {
                (function == F::Atanh || *negative).then(|| self.infinity(*negative))
            }
            (F::Mod, [Number::Finite(x, _), Number::Finite(y, _)]) if x.is_zero() && !y.is_zero() => Some(operands[0]),
            _ => None,
        }
    }

    fn signed(self, bits: u64, negative: bool) -> u64 {
        if negative { self.native(Function::Negate, &[bits]).unwrap_or(bits) } else { bits }
    }

    /// Limit of a function at an infinity.
    fn limit(self, function: Function, negative: bool) -> u64 {
        use Function as F;
        let whole = |x: i32| self.encode(&End::At(Dyadic::new(x, 0)));
        match (function, negative) {
            (F::Exp | F::Exp2, true) => whole(0),
            (F::ExpM1 | F::Tanh, true) => whole(-1),
            (F::Tanh, false) => whole(1),
            (F::Atan, _) => {
                let range = |bits| Constant::Pi2.value(bits);
                let right = PRECISIONS.iter().find_map(|&bits| self.decided(&range(bits)));
                self.signed(right.unwrap_or_else(|| self.nan()), negative)
            }
            (F::Cbrt | F::Sinh | F::Asinh, _) => self.infinity(negative),
            (F::Cosh, _) => self.infinity(false),
            (F::Exp | F::Exp2 | F::ExpM1 | F::Log | F::Log2 | F::Log10 | F::Log1P | F::Acosh, false) => {
                self.infinity(false)
            }
            _ => self.nan(),
        }
    }

    /// `pow(x, y)` where one is NaN, infinite, or x is zero.
    fn special_power(self, x: &Number, y: &Number, one: u64) -> Option<u64> {
        let zero = self.encode(&End::At(Dyadic::new(0, 0)));
        let unit = Dyadic::new(1, 0);
        let is_odd = |y: &Number| {
            let Number::Finite(y, _) = y else { return false };
            // An integer with a unit that no power of two divides.
            y.digits.trailing_zeros().is_some_and(|zeros| y.exponent + zeros.cast_signed() == 0)
        };
        match (x, y) {
            (_, Number::Finite(y, _)) if y.is_zero() => Some(one),
            (Number::Finite(x, _), _) if *x == unit => Some(one),
            (Number::Nan, _) | (_, Number::Nan) => Some(self.nan()),
            (Number::Finite(x, _), Number::Infinite(falls)) => {
                let magnitude = Dyadic::new(x.digits.abs(), x.exponent);
                Some(match magnitude.cmp(&unit) {
                    Ordering::Equal => one,
                    order => {
                        if order.is_gt() == *falls {
                            zero
                        } else {
                            self.infinity(false)
                        }
                    }
                })
            }
            (Number::Infinite(negative), _) => {
                let size = if y.is_negative() { zero } else { self.infinity(false) };
                Some(self.signed(size, *negative && is_odd(y)))
            }
            (Number::Finite(base, negative), _) if base.is_zero() => {
                let size = if y.is_negative() { self.infinity(false) } else { zero };
                Some(self.signed(size, *negative && is_odd(y)))
            }
            _ => None,
        }
    }
}
