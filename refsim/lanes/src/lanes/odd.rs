//! Rounding to odd: a double that a later rounding turns into the same number as the exact real result.
//!
//! A real number is rounded to odd by truncating it and setting the last bit if anything was cut off. Rounding the
//! result once more into a format of `p` bits, in any direction, equals rounding the real number itself, if the
//! intermediate has `p + 2` bits (Boldo and Melquiond, "Emulation of FMA and correctly rounded sums: proved algorithms
//! using rounding to odd", theorem 2). A double has 53 bits and formats here at most 24; no result of two such operands
//! leaves the exponent range of a double. So every arithmetic operation below is done in doubles and its error, known
//! exactly, moves the last bit.

pub(crate) const SIGN: u64 = 1 << 63;

/// Rounds `s + e` to odd, where `s` is a double and `e` an exact remainder smaller than the distance from `s` to the
/// next double on the side of `e`. An infinite or NaN `s` is returned unchanged: its remainder is NaN or compares as
/// zero.
#[inline(always)]
pub(crate) fn odd(s: f64, e: f64) -> f64 {
    // Truncates, then sets the last bit. The product of `e` and `s` does not underflow to zero here.
    let cut = s.to_bits().wrapping_sub(u64::from(e * s < 0.0));
    f64::from_bits(cut | u64::from(e.abs() > 0.0))
}

/// `a + b` rounded, and the exact error (Knuth's two-sum), which is NaN if the sum is not finite.
#[inline(always)]
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let bb = s - a;
    (s, (a - (s - bb)) + (b - bb))
}

/// `a + b` rounded to odd.
#[inline(always)]
pub(crate) fn add_odd(a: f64, b: f64) -> f64 {
    let (s, e) = two_sum(a, b);
    odd(s, e)
}

/// Rounds to 26 significant bits (or 25) by Veltkamp's split, so that the square is exact. `x` must be far from
/// overflow.
#[inline(always)]
pub(crate) fn head(x: f64) -> f64 {
    let c = x * 134_217_729.0;
    c - (c - x)
}

/// `a / b` rounded to odd in all 53 bits, for fixed-point formats of more than 24 bits. `a` is any double, `b` is not 0
/// and has at most 26 significant bits; both are far from the ends of the range.
///
/// The quotient q, in [1, 2) units of 2^e, is split into 26 and 27 bits, whose products with `b` have 53 bits at most:
/// they are exact. Let `b` be an integer of n bits, so that `a` is a multiple of 2^(e+n-54). `a` minus the larger
/// product is a multiple of the smaller of 2^(e+n-54) and 2^(e-25), and less than 2^(e+n-25): it has 29 or n bits. The
/// remainder, at most `b` half units of q, is a multiple of 2^(e-53) and less than 2^(e+n-52). Both differences are
/// exact.
#[inline(always)]
pub fn div_odd_long(a: f64, b: f64) -> f64 {
    let q = a / b;
    let high = head(q);
    let rest = (a - high * b) - (q - high) * b;
    odd(q, if b > 0.0 { rest } else { -rest })
}

/// `1 / sqrt(a)` rounded to odd, for finite `a > 0` of at most 24 significant bits.
///
/// The candidate is within two units of a double; its head `y` of 26 bits is therefore within `2^-26 y` of the exact
/// value. With `y^2 = h + l` split so that both parts times `a` are exact, `1 - h a` is exact (it cancels), and
/// comparing it with `l a` shows on which side of `y` the exact value lies.
#[inline(always)]
pub(crate) fn rsq_odd(a: f64) -> f64 {
    let y = head(1.0 / a.sqrt());
    let square = y * y;
    let h = head(square);
    let l = square - h;
    let (p, q) = (1.0 - h * a, l * a);
    // The exact remainder 1 - y^2 a; it is only compared, so rounding cannot change its sign.
    let e = if p > q {
        1.0
    } else if p < q {
        -1.0
    } else {
        0.0
    };
    odd(y, e)
}

/// The sum of exact doubles, rounded to odd. NaN and infinities are as in an addition in order; an exact zero is `+0`.
///
/// The sum is kept as an expansion, doubles whose bits don't overlap (Shewchuk 1997, "Adaptive precision
/// floating-point arithmetic", GROW-EXPANSION), then read from the top: the first nonzero error decides the side.
#[inline(always)]
pub(crate) fn sum_odd<const N: usize>(terms: [f64; N]) -> f64 {
    let mut parts = [0.0f64; N];
    let mut plain = 0.0;
    for k in 0..N {
        plain += terms[k];
        let mut carry = terms[k];
        for part in parts.iter_mut().take(k) {
            let (s, e) = two_sum(carry, *part);
            *part = e;
            carry = s;
        }
        parts[k] = carry;
    }
    let (mut s, mut rest) = (0.0, 0.0);
    for k in (0..N).rev() {
        let (sum, e) = two_sum(s, parts[k]);
        let settled = rest != 0.0;
        s = if settled { s } else { sum };
        rest = if settled { rest } else { e };
    }
    let finite = plain.abs() < f64::INFINITY;
    if finite { odd(s, rest) } else { plain }
}
