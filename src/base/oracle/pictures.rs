//! Comparison of pictures that must be equal, or equal within a tolerance.

use super::disagreement::short;
use super::equal::{EqualityCheck, Unequal, compare};
use crate::compare::f32_ulps as ulps;

mod sealed {
    pub trait Sealed {}

    impl Sealed for u8 {}
    impl Sealed for u16 {}
    impl Sealed for f32 {}
}

/// Channel value of a pixel: a number type with a successor. Implemented for u8, u16 and f32 only.
pub trait Sample: Copy + sealed::Sealed {
    /// Number of steps to the other number; `None` if the numbers differ and one is not finite.
    fn steps(self, other: Self) -> Option<u64>;

    /// Formats the number in decimal.
    fn text(self) -> String;
}

impl Sample for u8 {
    fn steps(self, other: Self) -> Option<u64> {
        Some(self.abs_diff(other).into())
    }

    fn text(self) -> String {
        self.to_string()
    }
}

impl Sample for u16 {
    fn steps(self, other: Self) -> Option<u64> {
        Some(self.abs_diff(other).into())
    }

    fn text(self) -> String {
        self.to_string()
    }
}

impl Sample for f32 {
    fn steps(self, other: Self) -> Option<u64> {
        ulps(self, other)
    }

    fn text(self) -> String {
        short(self)
    }
}

/// Checks that two pictures are equal: rows of `width` pixels of `N` channels, each channel at most `most` steps from
/// its counterpart (0: equal; for f32, steps are ULPs).
///
/// ```
/// # extern crate crossbar_base as crossbar;
/// use crossbar::oracle::images_equal;
///
/// let (left, right) = ([[10_u8, 20, 30], [40, 50, 60]], [[10_u8, 20, 30], [40, 52, 60]]);
/// assert!(images_equal(2, &left, &right, 2).is_ok());
/// let unequal = images_equal(2, &left, &right, 1).expect_err("two steps");
/// assert!(unequal.to_string().contains("pixel (1, 0)"));
/// ```
///
/// # Errors
/// [`Unequal`] names the pixels of the first and the largest difference.
pub fn images_equal<S: Sample, const N: usize>(
    width: usize,
    left: &[[S; N]],
    right: &[[S; N]],
    most: u32,
) -> Result<(), Unequal> {
    let steps = if most == 1 { "step" } else { "steps" };
    let check = EqualityCheck { what: "pixels", beyond: format!("by more than {most} {steps}") };
    let apart = |l: [S; N], r: [S; N]| {
        let far = l.into_iter().zip(r).map(|(l, r)| l.steps(r).unwrap_or(u64::MAX)).max().unwrap_or(0);
        (far > u64::from(most)).then_some(far)
    };
    let words = |pixel: [S; N]| format!("({})", pixel.map(S::text).join(", "));
    let text = |at: usize, l, r| {
        let width = width.max(1);
        format!("pixel ({}, {}) {} and {}", at % width, at / width, words(l), words(r))
    };
    compare(check, [left, right], apart, text)
}

/// Asserts [`images_equal`].
#[track_caller]
pub fn assert_images_equal<S: Sample, const N: usize>(width: usize, left: &[[S; N]], right: &[[S; N]], most: u32) {
    if let Err(unequal) = images_equal(width, left, right, most) {
        panic!("{unequal}");
    }
}
