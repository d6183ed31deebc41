//! Real spherical harmonics by polynomial recurrences.

use std::f64::consts::PI;
use std::sync::LazyLock;

use glam::DVec3;

/// Maximum order: order n has n bands, l = 0 to n - 1, and n^2 functions.
pub const MAX_ORDER: usize = 10;

struct Recurrence {
    /// y_mm without the factor (x + iy)^m, by m.
    diagonal: [f64; MAX_ORDER],
    /// Factor of z y_(l-1)m in the recurrence of y_lm.
    rise: [[f64; MAX_ORDER]; MAX_ORDER],
    /// Factor of y_(l-2)m in the recurrence of y_lm.
    fall: [[f64; MAX_ORDER]; MAX_ORDER],
}

static RECURRENCE: LazyLock<Recurrence> = LazyLock::new(|| {
    let mut table = Recurrence {
        diagonal: [0.0; MAX_ORDER],
        rise: [[0.0; MAX_ORDER]; MAX_ORDER],
        fall: [[0.0; MAX_ORDER]; MAX_ORDER],
    };
    // The product of (2k + 1) / 2k for k = 1 to m.
    let mut product = 1.0;
    for m in 0..MAX_ORDER {
        let sides = if m == 0 { 1.0 } else { 2.0 };
        table.diagonal[m] = (sides * product / (4.0 * PI)).sqrt();
        product *= (2 * m + 3) as f64 / (2 * m + 2) as f64;
        for l in m + 1..MAX_ORDER {
            table.rise[l][m] = 1.0 / coupling(l, m);
            table.fall[l][m] = coupling(l - 1, m) / coupling(l, m);
        }
    }
    table
});

/// Factor of y_(l-1)m in z y_lm, and of y_lm in z y_(l-1)m: sqrt((l^2 - m^2) / (4 l^2 - 1)).
pub(super) fn coupling(l: usize, m: usize) -> f64 {
    (((l * l - m * m) as f64) / (4.0 * (l * l) as f64 - 1.0)).sqrt()
}

/// Number of functions of an order, n^2. Panics if the order is not 1 to [`MAX_ORDER`].
pub fn function_count(order: usize) -> usize {
    assert!((1..=MAX_ORDER).contains(&order), "an order from 1 to {MAX_ORDER}, not {order}");
    order * order
}

/// Index of y_lm: l (l + 1) + m. Panics if |m| exceeds l.
pub fn function_index(l: usize, m: isize) -> usize {
    let index = (l * (l + 1)).checked_add_signed(m).filter(|_| m.unsigned_abs() <= l);
    index.expect("|m| at most l")
}

/// Band and position in the band, l and m, of the function with an index.
pub fn function_band(index: usize) -> (usize, isize) {
    let l = index.isqrt();
    let distance = |from: usize, to: usize| isize::try_from(to - from).expect("an index of a harmonic is small");
    let middle = l * (l + 1);
    (l, if index < middle { -distance(index, middle) } else { distance(middle, index) })
}

/// Evaluates the n^2 functions of an order at a unit direction, by index l (l + 1) + m. For m > 0, y_lm has the factor
/// Re (x + iy)^m, y_l(-m) the factor Im (x + iy)^m.
pub fn harmonics(order: usize, direction: DVec3, into: &mut [f64]) {
    assert_eq!(into.len(), function_count(order), "values of order {order}");
    let table = &*RECURRENCE;
    let DVec3 { x, y, z } = direction;
    let [mut re, mut im] = [1.0, 0.0];
    for m in 0..order {
        let [mut before, mut now] = [0.0, table.diagonal[m]];
        for l in m..order {
            let middle = l * (l + 1);
            into[middle - m] = now * im;
            into[middle + m] = now * re;
            if l + 1 < order {
                [before, now] = [now, table.rise[l + 1][m] * z * now - table.fall[l + 1][m] * before];
            }
        }
        [re, im] = [x * re - y * im, x * im + y * re];
    }
}

/// Evaluates the function with these coefficients at a direction.
pub fn evaluate(coefficients: &[f64], direction: DVec3) -> f64 {
    let mut values = [0.0; MAX_ORDER * MAX_ORDER];
    let values = &mut values[..coefficients.len()];
    harmonics(order_of(coefficients), direction, values);
    values.iter().zip(coefficients).map(|(y, c)| y * c).sum()
}

/// Order of a set of coefficients. Panics if their number is not a square of 1 to [`MAX_ORDER`].
pub fn order_of(coefficients: &[f64]) -> usize {
    order_with(coefficients.len()).expect("n^2 coefficients")
}

/// Order with this number of functions; `None` if no order from 1 to [`MAX_ORDER`] has it.
pub fn order_with(functions: usize) -> Option<usize> {
    (1..=MAX_ORDER).find(|&order| function_count(order) == functions)
}
