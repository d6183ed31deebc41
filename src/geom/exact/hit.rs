//! What is told of a hit, and which sides can be hit.

use std::cmp::Ordering;

use num_bigint::BigUint;
use num_traits::Zero;

use super::ratio;

/// Which sides of a triangle can be hit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Sides {
    /// Only the side from which the corners run counter-clockwise (n.d < 0).
    #[default]
    Front,
    /// Both.
    Both,
}

/// The exact ray parameter of a hit: a fraction of two integers, never negative. Compared by value, not by spelling.
#[derive(Debug, Clone)]
pub struct ExactT {
    num: BigUint,
    den: BigUint,
}

impl ExactT {
    /// `num / den`; `None` when the denominator is zero.
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

    /// The nearest f32, ties to even; infinity where t exceeds the format.
    pub fn to_f32(&self) -> f32 {
        ratio::to_f32(&self.num, &self.den)
    }

    /// The nearest f64, ties to even. It neither overflows nor loses bits to underflow for a t of f32 rays and
    /// triangles.
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

/// One triangle that a ray hits.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExactHit {
    /// The triangle's id.
    pub triangle: u32,
    /// Where.
    pub t: ExactT,
}

/// The first hit of a ray.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NearestHit {
    /// The smallest id among the triangles hit at the smallest t.
    pub triangle: u32,
    /// The smallest t.
    pub t: ExactT,
    /// All triangles hit at exactly that t, in rising order; the first is `triangle`.
    pub ties: Vec<u32>,
}
