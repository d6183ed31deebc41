//! Laws of sums of aligned addends, exhaustively in a small format: 3 bits of magnitude, 4 exponents.

use refsim_lanes::num::aligned::{Addend, Alignment, aligned};

/// Every addend of the small format.
fn all() -> Vec<Addend> {
    let signs = [false, true].into_iter();
    signs
        .flat_map(|negative| (0..8).map(move |magnitude| (negative, magnitude)))
        .flat_map(|(negative, magnitude)| {
            (-2..2).map(move |exponent| Addend { negative, magnitude, exponent, fraction: 2 })
        })
        .collect()
}

/// The value of an addend in units of `2^-8`, exact.
fn value(addend: Addend) -> i128 {
    let magnitude = i128::from(addend.magnitude) << (8 + addend.exponent - 2);
    if addend.negative { -magnitude } else { magnitude }
}

/// The value of an aligned sum with at most 6 bits, in units of `2^-8`.
fn sum(addends: &[Addend], bits: u32, alignment: Alignment) -> i128 {
    let sum = aligned(addends.iter().copied(), bits, None, alignment);
    sum.sum << (8 + sum.top - bits.cast_signed())
}

#[test]
fn enough_bits_make_sums_exact() {
    let (addends, mut triples) = (all(), 0);
    for &a in &addends {
        for &b in &addends {
            for &c in &addends {
                // 5 bits: 2 of fraction, and 3 for the distance of the smallest and the largest exponent.
                for alignment in [Alignment::Cut, Alignment::Floor] {
                    assert_eq!(sum(&[a, b, c], 5, alignment), value(a) + value(b) + value(c));
                }
                triples += 1;
            }
        }
    }
    assert_eq!(triples, 64 * 64 * 64);
}

#[test]
fn fewer_bits_cut_each_addend_below_the_largest_exponent() {
    for &a in &all() {
        for &b in &all() {
            for bits in 0..5u32 {
                // The last bit that is kept, in units of 2^-8.
                let unit = 1i128 << (8 + a.exponent.max(b.exponent) - bits.cast_signed());
                let cut = |x: i128| x / unit * unit;
                let floor = |x: i128| x.div_euclid(unit) * unit;
                assert_eq!(sum(&[a, b], bits, Alignment::Cut), cut(value(a)) + cut(value(b)));
                assert_eq!(sum(&[a, b], bits, Alignment::Floor), floor(value(a)) + floor(value(b)));
            }
        }
    }
}

#[test]
fn the_order_of_addends_does_not_show() {
    for &a in &all() {
        for &b in &all() {
            for c in all().into_iter().step_by(3) {
                for bits in 0..4 {
                    let sum = |addends: [Addend; 3]| aligned(addends, bits, Some(-1), Alignment::Floor);
                    assert_eq!(sum([a, b, c]), sum([c, a, b]));
                    assert_eq!(sum([a, b, c]), sum([b, a, c]));
                }
            }
        }
    }
}

#[test]
fn powers_of_two_scale_the_sum() {
    let scaled = |x: Addend, by: i32| Addend { exponent: x.exponent + by, ..x };
    for &a in &all() {
        for &b in &all() {
            for (by, bits) in [(1, 2), (-7, 3), (100, 0)] {
                let sum = aligned([a, b], bits, None, Alignment::Cut);
                let other = aligned([scaled(a, by), scaled(b, by)], bits, None, Alignment::Cut);
                assert_eq!((other.sum, other.top), (sum.sum, sum.top + by));
            }
        }
    }
}

#[test]
fn a_least_exponent_cuts_more() {
    let one = Addend { negative: false, magnitude: 5, exponent: 0, fraction: 2 };
    let sum = aligned([one], 2, Some(1), Alignment::Cut);
    assert_eq!((sum.sum, sum.top), (2, 1));
    let none = aligned([], 2, Some(1), Alignment::Cut);
    assert_eq!((none.sum, none.top), (0, 1));
}
