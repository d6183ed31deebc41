//! Comparison of numbers and hits that must be equal, or equal within a tolerance.

use std::fmt;

use super::disagreement::short;
use crate::compare::f32_ulps as ulps;
use crate::geom::Hit;

/// Error: two lists differ. Counts the differences and gives the first and the largest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unequal {
    what: &'static str,
    /// Violated criterion: `in their bits`, `by more than 1 ULP`.
    beyond: String,
    lengths: [usize; 2],
    /// Number of entries that differ; 0 if the lengths differ.
    pub different: usize,
    first: String,
    worst: String,
}

impl fmt::Display for Unequal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (what, [left, right]) = (self.what, self.lengths);
        if left != right {
            return write!(f, "expected as many {what} on both sides, found {left} and {right}");
        }
        write!(f, "{} of {left} {what} differ {}", self.different, self.beyond)?;
        write!(f, "\n  first: {}", self.first)?;
        if self.worst == self.first { Ok(()) } else { write!(f, "\n  worst: {}", self.worst) }
    }
}

impl std::error::Error for Unequal {}

/// Description of a comparison: the compared items and the allowed difference.
pub(super) struct EqualityCheck {
    pub(super) what: &'static str,
    pub(super) beyond: String,
}

/// Compares two lists. `apart` returns the distance between two entries if it exceeds the allowed difference; `text`
/// describes an entry.
pub(super) fn compare<T: Copy>(
    check: EqualityCheck,
    [left, right]: [&[T]; 2],
    apart: impl Fn(T, T) -> Option<u64>,
    text: impl Fn(usize, T, T) -> String,
) -> Result<(), Unequal> {
    let lengths = [left.len(), right.len()];
    let mut places: Option<[(u64, usize); 2]> = None;
    let mut different = 0;
    if left.len() == right.len() {
        for (at, (&l, &r)) in left.iter().zip(right).enumerate() {
            let Some(far) = apart(l, r) else { continue };
            different += 1;
            places = match places {
                Some([first, worst]) if far > worst.0 => Some([first, (far, at)]),
                None => Some([(far, at); 2]),
                known => known,
            };
        }
        if different == 0 {
            return Ok(());
        }
    }
    let words = |which: usize| {
        let place = places.and_then(|places| {
            let at = places[which].1;
            Some(text(at, *left.get(at)?, *right.get(at)?))
        });
        place.unwrap_or_default()
    };
    let (first, worst) = (words(0), words(1));
    Err(Unequal { what: check.what, beyond: check.beyond, lengths, different, first, worst })
}

/// Formats a number with its bits.
fn number(x: f32) -> String {
    format!("{} (0x{:08x})", short(x), x.to_bits())
}

fn numbers(at: usize, left: f32, right: f32) -> String {
    let far = match ulps(left, right) {
        Some(1) => "1 ULP apart".to_owned(),
        Some(ulps) => format!("{ulps} ULPs apart"),
        None => "not to be measured in ULPs".to_owned(),
    };
    format!("[{at}] {} and {}: {far}", number(left), number(right))
}

/// Checks that two lists of numbers have the same bits; +0 and -0 differ, and so do two NaN with different bits.
///
/// ```
/// # extern crate crossbar_base as crossbar;
/// use crossbar::oracle::bits_equal;
///
/// let unequal = bits_equal(&[1.0, 0.0], &[1.0, -0.0]).expect_err("the zeros differ");
/// assert_eq!(unequal.different, 1);
/// ```
///
/// # Errors
/// [`Unequal`] names the first and the largest difference.
pub fn bits_equal(left: &[f32], right: &[f32]) -> Result<(), Unequal> {
    let check = EqualityCheck { what: "numbers", beyond: "in their bits".to_owned() };
    let apart = |l: f32, r: f32| (l.to_bits() != r.to_bits()).then(|| ulps(l, r).unwrap_or(u64::MAX));
    compare(check, [left, right], apart, numbers)
}

/// Checks that corresponding numbers of two lists are at most `most` steps of f32 apart. +0 and -0 are 0 steps apart,
/// and so are two NaN; any other distance from NaN or infinity is too large.
pub fn within_ulps(left: &[f32], right: &[f32], most: u32) -> Result<(), Unequal> {
    let unit = if most == 1 { "ULP" } else { "ULPs" };
    let check = EqualityCheck { what: "numbers", beyond: format!("by more than {most} {unit}") };
    let apart = |l, r| {
        let far = ulps(l, r).unwrap_or(u64::MAX);
        (far > u64::from(most)).then_some(far)
    };
    compare(check, [left, right], apart, numbers)
}

/// Checks that two lists of hits are equal: triangles, and t to the bit.
pub fn hits_equal(left: &[Option<Hit>], right: &[Option<Hit>]) -> Result<(), Unequal> {
    let check = EqualityCheck { what: "hits", beyond: "in their bits".to_owned() };
    let apart = |l: Option<Hit>, r: Option<Hit>| match (l, r) {
        (None, None) => None,
        (Some(l), Some(r)) if l.triangle == r.triangle => {
            (l.t.to_bits() != r.t.to_bits()).then(|| ulps(l.t, r.t).unwrap_or(u64::MAX - 2))
        }
        (Some(_), Some(_)) => Some(u64::MAX - 1),
        _ => Some(u64::MAX),
    };
    let words = |hit: Option<Hit>| {
        hit.map_or_else(|| "nothing".to_owned(), |hit| format!("triangle {} at {}", hit.triangle, number(hit.t)))
    };
    compare(check, [left, right], apart, |at, l, r| format!("[{at}] {} and {}", words(l), words(r)))
}

/// Asserts [`bits_equal`].
#[track_caller]
pub fn assert_bits_eq(left: &[f32], right: &[f32]) {
    if let Err(unequal) = bits_equal(left, right) {
        panic!("{unequal}");
    }
}

/// Asserts [`within_ulps`].
#[track_caller]
pub fn assert_within_ulps(left: &[f32], right: &[f32], most: u32) {
    if let Err(unequal) = within_ulps(left, right, most) {
        panic!("{unequal}");
    }
}

/// Asserts [`hits_equal`].
#[track_caller]
pub fn assert_hits_eq(left: &[Option<Hit>], right: &[Option<Hit>]) {
    if let Err(unequal) = hits_equal(left, right) {
        panic!("{unequal}");
    }
}
