//! Series of elementary functions in integers, from which enclosures of any width are made.
//!
//! A value is an integer in units of `2^-places`. Every division and shift truncates, so a step errs by less than two
//! units, and a term of a series by at most eight. A series has at most one term per place.

use std::cell::RefCell;
use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_traits::One;

thread_local! {
    /// pi (`true`) and ln 2 (`false`) by number of places, kept because every sine needs pi.
    static KNOWN: RefCell<BTreeMap<(bool, u64), BigInt>> = const { RefCell::new(BTreeMap::new()) };
}

/// pi, with an error of less than two units.
pub fn pi(places: u64) -> BigInt {
    known(true, places)
}

/// ln 2, with an error of less than two units.
pub fn ln_2(places: u64) -> BigInt {
    known(false, places)
}

fn known(is_pi: bool, places: u64) -> BigInt {
    let wide = (places + 63) & !63;
    let kept = KNOWN.with_borrow(|known| known.get(&(is_pi, wide)).cloned());
    let value = kept.unwrap_or_else(|| {
        let made = match is_pi {
            true => machin([(16, 5), (-4, 239), (0, 1000)], false, wide),
            false => machin([(18, 26), (-2, 4801), (8, 8749)], true, wide),
        };
        KNOWN.with_borrow_mut(|known| known.insert((is_pi, wide), made.clone()));
        made
    });
    value >> (wide - places)
}

/// `sum of coefficient * f(1/n)` with `f` the arc tangent, or the inverse hyperbolic tangent.
fn machin(terms: [(i32, u32); 3], hyperbolic: bool, places: u64) -> BigInt {
    let spare = 32;
    let sum = terms.into_iter().fold(BigInt::ZERO, |sum, (coefficient, n)| {
        let mut power = (BigInt::one() << (places + spare)) / n;
        let (mut series, mut k) = (power.clone(), 1u32);
        while power != BigInt::ZERO {
            power = if hyperbolic { power / (n * n) } else { -power / (n * n) };
            k += 2;
            series += &power / k;
        }
        sum + series * coefficient
    });
    sum >> spare
}

/// `e^x` for x in [0, 1].
pub fn exp(x: &BigInt, places: u64) -> BigInt {
    let (mut term, mut sum, mut k) = (BigInt::one() << places, BigInt::ZERO, 1u32);
    while term != BigInt::ZERO {
        sum += &term;
        term = ((term * x) >> places) / k;
        k += 1;
    }
    sum
}

/// Sine or cosine of an angle in units of `2^-wide`, which are finer than those of the result: by at least as many
/// bits as the angle's whole part has, because a multiple of pi/2 errs by as many units as it counts.
pub fn circular(sine: bool, angle: &BigInt, wide: u64, places: u64) -> BigInt {
    let quarter: BigInt = pi(wide) >> 1u32;
    // The nearest multiple; a division rounds toward zero.
    let moved = angle + (&quarter >> 1u32);
    let turns = &moved / &quarter - i32::from(moved < BigInt::ZERO);
    let rest: BigInt = (angle - &turns * quarter) >> (wide - places);
    let quadrant = u32::try_from(turns & BigInt::from(3)).unwrap_or(0) + u32::from(!sine);
    let square: BigInt = (&rest * &rest) >> places;
    let is_odd = quadrant % 2 == 0;
    let mut term = if is_odd { rest } else { BigInt::one() << places };
    let (mut sum, mut k) = (term.clone(), if is_odd { 2u32 } else { 1 });
    while term != BigInt::ZERO {
        term = -((term * &square) >> places) / (k * (k + 1));
        sum += &term;
        k += 2;
    }
    if quadrant % 4 >= 2 { -sum } else { sum }
}
