//! Elementary functions of intervals.

use super::dyadic::{Dyadic, End};
use super::interval::{Real, RealInterval};
use super::series;

/// Encloses an increasing function by its values at both ends; at an infinite end, by its limit there.
fn growing(x: &RealInterval, below: End, at: impl Fn(&Dyadic) -> RealInterval, above: End) -> RealInterval {
    if let Some(point) = x.as_point() {
        return at(point);
    }
    let end = |end: &End| match end {
        End::Below => RealInterval { low: below.clone(), high: below.clone() },
        End::At(x) => at(x),
        End::Above => RealInterval { low: above.clone(), high: above.clone() },
    };
    RealInterval { low: end(&x.low).low, high: end(&x.high).high }
}

pub(super) fn exp(x: &RealInterval, bits: u64) -> RealInterval {
    growing(x, End::At(Dyadic::new(0, 0)), |x| series::exp(x, bits), End::Above)
}

/// `ln x` of a nonnegative interval.
pub(super) fn log(x: &RealInterval, bits: u64) -> RealInterval {
    let at = |x: &Dyadic| match x.is_zero() {
        true => RealInterval { low: End::Below, high: End::Below },
        false => series::log(x, bits),
    };
    growing(x, End::Below, at, End::Above)
}

pub(super) fn atan(x: &RealInterval, bits: u64) -> RealInterval {
    let right = series::pi(bits).scaled(-1);
    growing(x, right.high.negated(), |x| series::atan(x, bits), right.high.clone())
}

/// Sine or cosine: the value at the lower end, plus or minus the width of the interval, since the slope is at most 1.
pub(super) fn circular(sine: bool, x: &RealInterval, bits: u64) -> RealInterval {
    let (one, End::At(low)) = (RealInterval::integer(1), &x.low) else {
        return RealInterval { low: End::At(Dyadic::new(-1, 0)), high: End::At(Dyadic::new(1, 0)) };
    };
    let at = series::circular(sine, low, bits);
    if x.as_point().is_some() {
        return at;
    }
    let wide = x.high.plus(&x.low.negated(), bits, true);
    let range = at.plus(&RealInterval { low: wide.negated(), high: wide }, bits);
    RealInterval { low: range.low.max(one.low.negated()), high: range.high.min(one.high) }
}

/// `asin x = 2 atan(x / (1 + sqrt((1 - x) (1 + x))))`
pub(super) fn asin(x: &RealInterval, bits: u64) -> Option<RealInterval> {
    let one = RealInterval::integer(1);
    let square = one.minus(x, bits).times(&one.plus(x, bits), bits);
    let root = RealInterval { low: square.low.max(End::At(Dyadic::new(0, 0))), ..square }.root(2, bits);
    Some(atan(&x.over(&one.plus(&root, bits), bits)?, bits).scaled(1))
}

/// The angle of the point (x, y); undefined for the origin.
pub(super) fn atan2(y: &RealInterval, x: &RealInterval, bits: u64) -> Real {
    let is_origin = |x: &RealInterval| x.as_point().is_some_and(Dyadic::is_zero);
    if is_origin(x) && is_origin(y) {
        return Real::Undefined;
    }
    let (pi, ratio) = (series::pi(bits), |a: &RealInterval, b: &RealInterval| Some(atan(&a.over(b, bits)?, bits)));
    let angle = match (x, y) {
        _ if x.is_positive() => ratio(y, x),
        _ if y.is_positive() => ratio(x, y).map(|angle| pi.scaled(-1).minus(&angle, bits)),
        _ if y.is_negative() => ratio(x, y).map(|angle| pi.scaled(-1).plus(&angle, bits).negated()),
        _ if x.is_negative() && !y.low.is_negative() => ratio(y, x).map(|angle| angle.plus(&pi, bits)),
        _ => None,
    };
    angle.map_or(Real::Unknown, Real::Range)
}

/// `cosh x`, or `sinh x`.
pub(super) fn sum_of_exponentials(x: &RealInterval, cosh: bool, bits: u64) -> RealInterval {
    let at = |x: &RealInterval| {
        let (up, down) = (exp(x, bits), exp(&x.negated(), bits));
        if cosh { up.plus(&down, bits) } else { up.minus(&down, bits) }.scaled(-1)
    };
    // Both increase for nonnegative x; cosh is even.
    let x = if cosh { x.abs() } else { x.clone() };
    let [low, high] = [&x.low, &x.high].map(|end| at(&RealInterval { low: end.clone(), high: end.clone() }));
    RealInterval { low: low.low, high: high.high }
}

/// `tanh x = 1 - 2 / (e^(2 x) + 1)`
pub(super) fn tanh(x: &RealInterval, bits: u64) -> Option<RealInterval> {
    let [one, two] = [1, 2].map(RealInterval::integer);
    Some(one.minus(&two.over(&exp(&x.scaled(1), bits).plus(&one, bits), bits)?, bits))
}

/// `asinh x = log(x + sqrt(x^2 + 1))`
pub(super) fn asinh(x: &RealInterval, bits: u64) -> RealInterval {
    let root = x.squared(bits).plus(&RealInterval::integer(1), bits).root(2, bits);
    let sum = x.plus(&root, bits);
    let zero = End::At(Dyadic::new(0, 0));
    log(&RealInterval { low: sum.low.max(zero), ..sum }, bits)
}

/// `acosh x = log(x + sqrt((x - 1) (x + 1)))`, x at least 1.
pub(super) fn acosh(x: &RealInterval, bits: u64) -> RealInterval {
    let one = RealInterval::integer(1);
    let root = x.minus(&one, bits).times(&x.plus(&one, bits), bits).root(2, bits);
    log(&x.plus(&root, bits), bits)
}

/// `atanh x = log((1 + x) / (1 - x)) / 2`
pub(super) fn atanh(x: &RealInterval, bits: u64) -> Option<RealInterval> {
    let one = RealInterval::integer(1);
    Some(log(&one.plus(x, bits).over(&one.minus(x, bits), bits)?, bits).scaled(-1))
}
