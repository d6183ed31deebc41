//! Powers. Rational powers are exact, so that their rounding is decided.

use num_traits::One;

use super::dyadic::Dyadic;
use super::interval::{Real, RealInterval};
use super::{functions, series};

/// Largest integer exponent for powers by multiplication, and for powers of two.
const MAX_WHOLE: u64 = 1 << 12;
/// Maximum number of square roots taken for an exponent such as 1.5.
const MAX_ROOTS: u32 = 12;

/// `2^x`
pub(super) fn exp2(x: &RealInterval, bits: u64) -> RealInterval {
    match small_integer(x) {
        Some(whole) => RealInterval::point(Dyadic::new(1, 0)).scaled(whole),
        None => functions::exp(&x.times(&series::ln_2(bits), bits), bits),
    }
}

/// `log2 x` of a positive interval.
pub(super) fn log2(x: &RealInterval, bits: u64) -> Option<RealInterval> {
    if let Some(x) = x.as_point()
        && let zeros = x.digits.trailing_zeros().unwrap_or_default()
        && (&x.digits >> zeros).is_one()
    {
        return Some(RealInterval::integer(x.exponent + zeros.cast_signed()));
    }
    functions::log(x, bits).over(&series::ln_2(bits), bits)
}

/// `x^y`
pub(super) fn pow(x: &RealInterval, y: &RealInterval, bits: u64) -> Real {
    let zero = RealInterval::integer(0);
    let is_zero = |x: &RealInterval| x.as_point().is_some_and(Dyadic::is_zero);
    if is_zero(y) {
        return Real::Range(RealInterval::integer(1));
    }
    if let Some(whole) = small_integer(y).filter(|whole| whole.unsigned_abs() <= MAX_WHOLE) {
        let product = whole_power(x, whole.unsigned_abs(), bits);
        return match (whole < 0, is_zero(&product)) {
            (false, _) => Real::Range(product),
            (true, true) => Real::Undefined,
            (true, false) => RealInterval::integer(1).over(&product, bits).map_or(Real::Unknown, Real::Range),
        };
    }
    if is_zero(x) {
        return match y.order(&zero) {
            Some(order) if order.is_gt() => Real::Range(zero),
            Some(_) => Real::Undefined,
            None => Real::Unknown,
        };
    }
    let by_logarithm = |x: &RealInterval| functions::exp(&y.times(&functions::log(x, bits), bits), bits);
    if x.is_positive() {
        return Real::Range(rational_power(x, y, bits).unwrap_or_else(|| by_logarithm(x)));
    }
    // A negative number has real powers only for integer exponents.
    let Some(exponent) = y.as_point().filter(|_| x.is_negative()) else { return Real::Unknown };
    let is_whole = |scale: i64| exponent.exponent + scale >= 0 || exponent.scaled(scale).whole().is_some();
    match (is_whole(0), is_whole(-1)) {
        (false, _) => Real::Undefined,
        (true, true) => Real::Range(by_logarithm(&x.negated())),
        (true, false) => Real::Range(by_logarithm(&x.negated()).negated()),
    }
}

/// `x^n` by squaring.
fn whole_power(x: &RealInterval, n: u64, bits: u64) -> RealInterval {
    let (mut power, mut rest, mut square) = (RealInterval::integer(1), n, x.clone());
    // An even power equals the power of the magnitude.
    if n.is_multiple_of(2) {
        square = square.abs();
    }
    while rest > 0 {
        if rest % 2 == 1 {
            power = power.times(&square, bits);
        }
        rest /= 2;
        if rest > 0 {
            square = square.squared(bits);
        }
    }
    power
}

/// `x^(n/2^k)` for two points, if it is rational: `k` exact roots, then a power.
fn rational_power(x: &RealInterval, y: &RealInterval, bits: u64) -> Option<RealInterval> {
    let (mut base, exponent) = (x.as_point()?.clone(), y.as_point()?);
    let zeros = exponent.digits.trailing_zeros().unwrap_or_default().cast_signed();
    let roots = u32::try_from(-(exponent.exponent + zeros)).ok().filter(|roots| *roots <= MAX_ROOTS)?;
    let whole = small_integer(&RealInterval::point(exponent.scaled(roots.into())))?;
    for _ in 0..roots {
        let (root, is_exact) = base.root(2, base.digits.bits() + 4, false);
        base = is_exact.then_some(root)?;
    }
    let power = whole_power(&RealInterval::point(base), Some(whole.unsigned_abs()).filter(|n| *n <= MAX_WHOLE)?, bits);
    if whole < 0 { RealInterval::integer(1).over(&power, bits) } else { Some(power) }
}

/// An integer point, small enough to count with.
fn small_integer(x: &RealInterval) -> Option<i64> {
    let x = x.as_point()?;
    i64::try_from(Some(x).filter(|x| x.top() < 60)?.whole()?).ok()
}
