//! Reference implementation of every operation for short formats, in exact fractions and by definition.

use std::cmp::Ordering;

use refsim::num::{
    Denormals, DotOrder, Encoding, Flags, Format, FormatKind, Outcome, Overflow, Rounding, Specials, Tininess,
};

use crate::rational::{self, Q, magnitude};

/// Value of a pattern.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Val {
    Nan {
        signaling: bool,
    },
    Inf(bool),
    /// Sign and magnitude, to represent -0.
    Num(bool, Q),
}

use Val::{Inf, Nan, Num};

mod powers;

pub(crate) struct Reference {
    pub(crate) f: Format,
    pub(crate) tininess: Tininess,
}

const ZERO: Q = Q { n: 0, d: 1 };
const ONE: Q = Q { n: 1, d: 1 };

fn signed(negative: bool, q: Q) -> Q {
    if negative { q.negated() } else { q }
}

pub(crate) fn decode(f: &Format, bits: u32) -> Val {
    let negative = bits & f.sign_bit() != 0;
    let low = bits & (f.sign_bit() - 1);
    let FormatKind::Float { man_bits, .. } = f.kind else {
        let index = if negative { f.sign_bit() - low } else { low };
        return Num(negative, magnitude(f, index));
    };
    match f.encoding {
        Encoding::Finite if f.width() > 6 && low == f.sign_bit() - 1 => return Nan { signaling: false },
        Encoding::UnsignedZero if negative && low == 0 => return Nan { signaling: false },
        _ => {}
    }
    let infinity = if f.encoding == Encoding::Ieee { f.max_finite() + 1 } else { u32::MAX };
    match low.cmp(&infinity) {
        Ordering::Greater => Nan { signaling: low & (1 << (man_bits - 1)) == 0 },
        Ordering::Equal => Inf(negative),
        Ordering::Less if low < 1 << man_bits && f.denormals == Denormals::Flush => {
            Num(negative && f.encoding != Encoding::UnsignedZero, ZERO)
        }
        Ordering::Less => Num(negative, magnitude(f, low)),
    }
}

impl Reference {
    pub(crate) fn val(&self, bits: u32) -> Val {
        decode(&self.f, bits)
    }

    fn zero(&self, negative: bool) -> Outcome {
        let signed = !self.f.is_fixed() && self.f.encoding != Encoding::UnsignedZero;
        Outcome::exact(if negative && signed { self.f.sign_bit() } else { 0 })
    }

    pub(crate) fn finish(&self, negative: bool, q: Q) -> Outcome {
        if q.n == 0 {
            return self.zero(negative);
        }
        rational::round(&self.f, self.tininess, negative, |c| q.cmp(c))
    }

    fn invalid(&self) -> Outcome {
        Outcome::new(self.f.canonical_nan().unwrap_or(0), Flags::INVALID)
    }

    fn nan(&self, operands: &[Val]) -> Option<Outcome> {
        let signaling = operands.iter().any(|v| matches!(v, Nan { signaling: true }));
        let any = operands.iter().any(|v| matches!(v, Nan { .. }));
        let flags = if signaling { Flags::INVALID } else { Flags::empty() };
        any.then(|| Outcome::new(self.f.canonical_nan().unwrap_or(0), flags))
    }

    fn infinity(&self, negative: bool) -> Outcome {
        if !self.f.is_fixed() && self.f.encoding == Encoding::Ieee {
            return Outcome::exact(self.f.infinity(negative).expect("only floats have infinite operands"));
        }
        Outcome::new(self.pole(negative).bits, Flags::OVERFLOW | Flags::INEXACT)
    }

    fn pole(&self, negative: bool) -> Outcome {
        let finite = self.f.is_fixed() || self.f.overflow == Overflow::Saturate;
        let bits = if finite { self.f.extreme(negative) } else { rational::unbounded(&self.f, negative) };
        Outcome::new(bits, Flags::DIVIDE_BY_ZERO)
    }

    pub(crate) fn cancelled(&self) -> bool {
        self.f.rounding == Rounding::Down
    }

    pub(crate) fn pass(&self, bits: u32) -> u32 {
        match self.val(bits) {
            Nan { .. } => self.f.canonical_nan().unwrap_or(0),
            Num(negative, q) if q.n == 0 => self.zero(negative).bits,
            _ => bits,
        }
    }

    pub(crate) fn add(&self, a: Val, b: Val) -> Outcome {
        if let Some(nan) = self.nan(&[a, b]) {
            return nan;
        }
        match (a, b) {
            (Inf(x), Inf(y)) if x != y => self.invalid(),
            (Inf(x), _) | (_, Inf(x)) => self.infinity(x),
            (Num(x, p), Num(y, q)) => {
                let sum = signed(x, p).add(signed(y, q));
                let exact_zero = if p.n == 0 && q.n == 0 && x == y { x } else { self.cancelled() };
                self.finish(if sum.n == 0 { exact_zero } else { sum.n < 0 }, sum.abs())
            }
            _ => unreachable!("NaNs are done"),
        }
    }

    pub(crate) fn negated(v: Val) -> Val {
        match v {
            Num(x, q) => Num(!x, q),
            Inf(x) => Inf(!x),
            nan => nan,
        }
    }

    /// The exact product, or an outcome that needs no rounding.
    fn product(&self, a: Val, b: Val) -> Result<Val, Outcome> {
        if let Some(nan) = self.nan(&[a, b]) {
            return Err(nan);
        }
        match (a, b) {
            (Inf(_), Num(_, q)) | (Num(_, q), Inf(_)) if q.n == 0 => Err(self.invalid()),
            (Inf(x), Inf(y) | Num(y, _)) | (Num(x, _), Inf(y)) => Ok(Inf(x != y)),
            (Num(x, p), Num(y, q)) => Ok(Num(x != y, p.mul(q))),
            _ => unreachable!("NaNs are done"),
        }
    }

    pub(crate) fn mul(&self, a: Val, b: Val) -> Outcome {
        match self.product(a, b) {
            Err(outcome) => outcome,
            Ok(Num(x, q)) => self.finish(x, q),
            Ok(Inf(x)) => self.infinity(x),
            Ok(Nan { .. }) => unreachable!("products are no NaNs"),
        }
    }

    pub(crate) fn fused(&self, a: Val, b: Val, c: Val) -> Outcome {
        match self.product(a, b) {
            Err(outcome) if outcome.flags.is_empty() => self.nan(&[a, b, c]).unwrap_or(outcome),
            Err(outcome) => outcome,
            Ok(product) => self.add(product, c),
        }
    }

    pub(crate) fn div(&self, a: Val, b: Val) -> Outcome {
        if let Some(nan) = self.nan(&[a, b]) {
            return nan;
        }
        match (a, b) {
            (Inf(_), Inf(_)) => self.invalid(),
            (Inf(x), Num(y, _)) => self.infinity(x != y),
            (Num(x, _), Inf(y)) => self.zero(x != y),
            (Num(_, p), Num(_, q)) if p.n == 0 && q.n == 0 => self.invalid(),
            (Num(x, _), Num(y, q)) if q.n == 0 => self.pole(x != y),
            (Num(x, p), Num(y, q)) => self.finish(x != y, Q::new(p.n * q.d, p.d * q.n)),
            _ => unreachable!("NaNs are done"),
        }
    }

    pub(crate) fn rcp(&self, a: Val) -> Outcome {
        self.div(Num(false, ONE), a)
    }

    pub(crate) fn sqrt(&self, a: Val) -> Outcome {
        match a {
            Nan { .. } => self.nan(&[a]).expect("a NaN"),
            Num(x, q) if q.n == 0 => self.zero(x),
            Num(true, _) | Inf(true) => self.invalid(),
            Inf(false) => self.infinity(false),
            Num(false, q) => rational::round(&self.f, self.tininess, false, |c| q.cmp(c.mul(c))),
        }
    }

    pub(crate) fn rsq(&self, a: Val) -> Outcome {
        match a {
            Nan { .. } => self.nan(&[a]).expect("a NaN"),
            Num(x, q) if q.n == 0 => self.pole(x),
            Num(true, _) | Inf(true) => self.invalid(),
            Inf(_) => self.zero(false),
            // Compares 1/sqrt(q) with c by comparing 1 with q c^2.
            Num(_, q) => rational::round(&self.f, self.tininess, false, |c| ONE.cmp(q.mul(c.mul(c)))),
        }
    }

    pub(crate) fn order(&self, a: Val, b: Val) -> Option<Ordering> {
        let place = |v| match v {
            Num(x, q) => signed(x, q),
            Inf(x) => signed(x, Q::new(1 << 30, 1)),
            Nan { .. } => ZERO,
        };
        let nan = matches!(a, Nan { .. }) || matches!(b, Nan { .. });
        (!nan).then(|| place(a).cmp(place(b)))
    }

    pub(crate) fn min_max(&self, a: u32, b: u32, first: fn(Ordering) -> bool) -> Outcome {
        let (x, y) = (self.val(a), self.val(b));
        let flags = self.nan(&[x, y]).map_or(Flags::empty(), |o| o.flags);
        let bits = match self.order(x, y) {
            None if self.f.specials == Specials::Nv => self.f.canonical_nan().unwrap_or(0),
            // The maximum of two zeros is the positive one, whose pattern is smaller.
            Some(Ordering::Equal) if self.f.specials == Specials::Nv => match first(Ordering::Equal) {
                true => self.pass(a).min(self.pass(b)),
                false => self.pass(a).max(self.pass(b)),
            },
            Some(order) if first(order) => self.pass(a),
            _ => self.pass(b),
        };
        Outcome::new(bits, flags)
    }

    pub(crate) fn to_int(&self, a: Val, rounding: Rounding, exact: bool) -> Outcome {
        let (negative, q) = match a {
            Nan { .. } => return self.nan(&[a]).expect("a NaN"),
            Inf(x) => return self.infinity(x),
            Num(negative, q) => (negative, q),
        };
        let whole = q.floor();
        let twice = Q::new(2 * (q.n - whole * q.d), q.d);
        let up = match rounding {
            Rounding::NearestEven => twice.cmp(ONE).is_gt() || (twice.cmp(ONE).is_eq() && whole % 2 != 0),
            Rounding::NearestAway => twice.cmp(ONE).is_ge(),
            Rounding::TowardZero => false,
            Rounding::Down => negative && twice.n > 0,
            Rounding::Up => !negative && twice.n > 0,
            Rounding::Odd => twice.n > 0 && whole % 2 == 0,
            Rounding::Stochastic(_) => unreachable!("`tables` has it"),
        };
        let changed = exact && twice.n > 0;
        let outcome = self.finish(negative, Q::new(whole + i128::from(up), 1));
        outcome.also(if changed { Flags::INEXACT } else { Flags::empty() })
    }

    pub(crate) fn frc(&self, a: Val) -> Outcome {
        match a {
            Nan { .. } => self.nan(&[a]).expect("a NaN"),
            Inf(_) => self.invalid(),
            Num(negative, q) => {
                let x = signed(negative, q);
                let fraction = x.add(Q::new(-x.floor(), 1));
                self.finish(fraction.n == 0 && self.cancelled(), fraction)
            }
        }
    }

    pub(crate) fn scale(&self, a: Val, k: i32) -> Outcome {
        match a {
            Nan { .. } => self.nan(&[a]).expect("a NaN"),
            Inf(x) => self.infinity(x),
            Num(x, q) => self.finish(x, q.mul(Q::scaled(1, k))),
        }
    }

    pub(crate) fn neg(&self, bits: u32) -> Outcome {
        match self.val(bits) {
            Num(x, q) => self.finish(!x, q),
            Inf(x) => self.infinity(!x),
            Nan { .. } => Outcome::exact(self.pass(bits)),
        }
    }

    pub(crate) fn abs(&self, bits: u32) -> Outcome {
        match self.val(bits) {
            Num(_, q) => self.finish(false, q),
            Inf(_) => self.infinity(false),
            Nan { .. } => Outcome::exact(self.pass(bits)),
        }
    }

    pub(crate) fn saturate01(&self, bits: u32) -> Outcome {
        match self.val(bits) {
            Nan { .. } if self.f.specials == Specials::Nv => Outcome::exact(self.pass(bits)),
            Inf(false) => Outcome::exact(self.f.one()),
            Num(false, q) if q.n > 0 && q.cmp(ONE).is_ge() => Outcome::exact(self.f.one()),
            Num(false, q) if q.n > 0 => Outcome::exact(bits),
            _ => Outcome::exact(0),
        }
    }

    pub(crate) fn select(&self, condition: Val, threshold: Q, strict: bool, a: u32, b: u32) -> Outcome {
        let order = self.order(condition, Num(false, threshold));
        let first = order.is_some_and(|o| if strict { o.is_gt() } else { o.is_ge() });
        Outcome::exact(self.pass(if first { a } else { b }))
    }

    pub(crate) fn compare(&self, a: Val, b: Val, quiet: bool, holds: fn(Ordering) -> bool) -> Outcome {
        let flags = match self.nan(&[a, b]) {
            Some(_) if !quiet => Flags::INVALID,
            Some(outcome) => outcome.flags,
            None => Flags::empty(),
        };
        Outcome::new(u32::from(self.order(a, b).is_some_and(holds)), flags)
    }

    pub(crate) fn convert_from(&self, from: &Format, bits: u32) -> Outcome {
        match decode(from, bits) {
            Nan { .. } if self.f.canonical_nan().is_none() => self.invalid(),
            nan @ Nan { .. } => self.nan(&[nan]).expect("a NaN"),
            Inf(x) if self.f.is_fixed() => Outcome::new(self.f.extreme(x), Flags::OVERFLOW | Flags::INEXACT),
            Inf(x) => self.infinity(x),
            Num(x, q) => self.finish(x, q),
        }
    }

    /// Products of numbers of `operands`, summed in this format.
    pub(crate) fn dot(&self, operands: &Format, order: DotOrder, terms: &[(u32, u32)]) -> Outcome {
        let mul = |(a, b)| self.mul(decode(operands, a), decode(operands, b));
        let add = |a: Outcome, b: Outcome| self.add(self.val(a.bits), self.val(b.bits)).also(a.flags | b.flags);
        match (order, terms) {
            (DotOrder::Exact, _) => self.dot_exact(operands, terms),
            (DotOrder::Tree, &[x, y, z, w]) => add(add(mul(x), mul(y)), add(mul(z), mul(w))),
            _ => terms[1..].iter().fold(mul(terms[0]), |sum, term| add(sum, mul(*term))),
        }
    }

    fn dot_exact(&self, operands: &Format, terms: &[(u32, u32)]) -> Outcome {
        let values: Vec<[Val; 2]> = terms.iter().map(|&(a, b)| [decode(operands, a), decode(operands, b)]).collect();
        let products: Vec<_> = values.iter().map(|&[a, b]| self.product(a, b)).collect();
        let zero_by_infinity =
            |[a, b]: &[Val; 2]| !matches!(a, Nan { .. }) && !matches!(b, Nan { .. }) && self.product(*a, *b).is_err();
        let infinite = |sign| products.iter().any(|p| matches!(p, Ok(Inf(x)) if *x == sign));
        if values.iter().any(zero_by_infinity) || (infinite(true) && infinite(false)) {
            return self.invalid();
        }
        if let Some(nan) = self.nan(&values.concat()) {
            return nan;
        }
        if infinite(true) || infinite(false) {
            return self.infinity(infinite(true));
        }
        let numbers: Vec<(bool, Q)> = products
            .into_iter()
            .map(|p| match p {
                Ok(Num(x, q)) => (x, q),
                _ => unreachable!("special values are done"),
            })
            .collect();
        let sum = numbers.iter().fold(ZERO, |sum, &(x, q)| sum.add(signed(x, q)));
        let zeros = numbers.iter().all(|&(x, q)| q.n == 0 && x == numbers[0].0);
        let zero_sign = if zeros { numbers[0].0 } else { self.cancelled() };
        self.finish(if sum.n == 0 { zero_sign } else { sum.n < 0 }, sum.abs())
    }
}
