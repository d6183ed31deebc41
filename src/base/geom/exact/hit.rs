//! Exact hits, and the sides of triangles that can be hit.

use std::cmp::Ordering;

use num_bigint::BigUint;
use num_traits::Zero;

use super::ratio;

/// Sides of a triangle that can be hit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Sides {
    /// Only the side from which the corners run counter-clockwise (n.d < 0).
    #[default]
    Front,
    /// Both sides.
    Both,
}

/// Exact ray parameter of a hit: a non-negative fraction of two integers. Comparisons are by value, not by
/// representation.
#[derive(Debug, Clone)]
pub struct ExactT {
    num: BigUint,
    den: BigUint,
}

impl ExactT {
    /// Creates `num / den`; `None` if the denominator is zero.
    pub fn new(num: BigUint, den: BigUint) -> Option<Self> {
        (!den.is_zero()).then_some(Self { num, den })
    }

    /// Numerator (the fraction need not be in lowest terms).
    pub fn numerator(&self) -> &BigUint {
        &self.num
    }

    /// Denominator, positive.
    pub fn denominator(&self) -> &BigUint {
        &self.den
    }

    /// Rounds to the nearest f32, ties to even; infinity if t exceeds the range.
    pub fn to_f32(&self) -> f32 {
        ratio::to_f32(&self.num, &self.den)
    }

    /// Rounds to the nearest f64, ties to even. For rays and triangles in f32, the result neither overflows nor loses
    /// bits to underflow.
    pub fn to_f64(&self) -> f64 {
        ratio::to_f64(&self.num, &self.den)
    }
}

impl Ord for ExactT {
    fn cmp(&self, other: &Self) -> Ordering {
        ratio::compare(&self.num, &self.den, &other.num, &other.den)
    }
}

impl PartialOrd for ExactT {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for ExactT {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for ExactT {}

/// First hit of a ray.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NearestHit {
    /// Smallest id among the triangles hit at the smallest t.
    pub triangle: u32,
    /// Smallest t.
    pub t: ExactT,
    /// All triangles hit at exactly that t, in ascending order; the first is `triangle`.
    pub ties: Vec<u32>,
}
