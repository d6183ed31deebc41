//! Ground truth: which triangles a ray hits, and which first, decided in exact arithmetic on the f32 figures as given.
//!
//! **Definitions.** A triangle is closed: its edges and corners belong to it. A hit has t >= 0, in multiples of the
//! ray's direction as given. A ray in the triangle's plane (n.d = 0) misses it, so that a triangle without area (n = 0)
//! is never hit. n = (b - a) x (c - a); from the front means n.d < 0. Hits are ordered by exact t; of several at the
//! same t the smallest id comes first, and the whole set of ties is reported.
//!
//! **Method.** With A = a - o and so on, the signs of d.(BxC), d.(CxA), d.(AxB) (whose sum is n.d) tell on which side
//! of each edge the ray passes, and t = (n.A) / (n.d). [`whole`] evaluates these as integers of any size, since an f32
//! is an integer times a power of two. In front of it stands [`filter`], which evaluates them in f64 with a proved
//! error bound and decides only what is clear; [`Tracer`] adds a tree of boxes that never skips a hit. Property tests
//! hold all three to the same answers.

pub mod filter;
pub mod ratio;
mod tree;
pub mod whole;

use std::cmp::Ordering;

use num_bigint::BigUint;
use num_traits::Zero;

use super::{Mesh, Ray};
pub use filter::Guess;
pub use tree::{Tracer, nearest_all};

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
    #[must_use]
    pub fn new(num: BigUint, den: BigUint) -> Option<Self> {
        (!den.is_zero()).then_some(Self { num, den })
    }

    /// Numerator (the fraction need not be in lowest terms).
    #[must_use]
    pub fn numerator(&self) -> &BigUint {
        &self.num
    }

    /// Denominator, positive.
    #[must_use]
    pub fn denominator(&self) -> &BigUint {
        &self.den
    }

    /// The nearest f32, ties to even; infinity where t exceeds the format.
    #[must_use]
    pub fn to_f32(&self) -> f32 {
        ratio::to_f32(&self.num, &self.den)
    }

    /// The nearest f64, ties to even. It neither overflows nor loses bits to underflow for a t of f32 rays and
    /// triangles.
    #[must_use]
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

/// Where a ray hits a triangle of finite corners, if it does: the filter first, integers where it is not sure.
#[must_use]
pub fn intersect(ray: &Ray, triangle: &[[f32; 3]; 3], sides: Sides) -> Option<ExactT> {
    match filter::guess(ray, triangle, sides) {
        Guess::Miss => None,
        Guess::Hit { .. } | Guess::Unclear => whole::intersect(ray, triangle, sides),
    }
}

/// All hits of a ray, by rising t and then by rising id.
#[must_use]
pub fn hits(mesh: &Mesh, ray: &Ray, sides: Sides) -> Vec<ExactHit> {
    let mut hits: Vec<ExactHit> = (0..)
        .zip(mesh.iter_corners())
        .filter_map(|(triangle, corners)| Some(ExactHit { triangle, t: intersect(ray, &corners, sides)? }))
        .collect();
    hits.sort_by(|a, b| a.t.cmp(&b.t).then(a.triangle.cmp(&b.triangle)));
    hits
}

/// The first hit of a ray among all triangles, each one tried. For many rays use [`nearest_all`] or a [`Tracer`].
#[must_use]
pub fn nearest(mesh: &Mesh, ray: &Ray, sides: Sides) -> Option<NearestHit> {
    let mut shortlist = Shortlist::new();
    for (triangle, corners) in (0..).zip(mesh.iter_corners()) {
        shortlist.try_triangle(ray, triangle, &corners, sides);
    }
    shortlist.settle(mesh, ray, sides)
}

/// Whether a triangle has no area, exactly: n = 0.
#[must_use]
pub fn is_degenerate(triangle: &[[f32; 3]; 3]) -> bool {
    !filter::has_area(triangle) && whole::is_degenerate(triangle)
}

/// The hits that may still be the first, each with bounds of its t.
struct Shortlist {
    candidates: Vec<Candidate>,
    /// No hit beyond this t can be the first.
    limit: f64,
}

struct Candidate {
    triangle: u32,
    low: f64,
    exact: Option<ExactT>,
}

impl Shortlist {
    fn new() -> Self {
        Self { candidates: Vec::new(), limit: f64::INFINITY }
    }

    fn try_triangle(&mut self, ray: &Ray, triangle: u32, corners: &[[f32; 3]; 3], sides: Sides) {
        let (low, high, exact) = match filter::guess(ray, corners, sides) {
            Guess::Miss => return,
            Guess::Hit { low, high } => (low, high, None),
            Guess::Unclear => {
                let Some(t) = whole::intersect(ray, corners, sides) else { return };
                let near = t.to_f64();
                (filter::below(near), filter::above(near), Some(t))
            }
        };
        if low <= self.limit {
            self.limit = if high < self.limit { high } else { self.limit };
            self.candidates.push(Candidate { triangle, low, exact });
        }
    }

    /// The first hit, decided in integers among the candidates that the bounds leave.
    fn settle(self, mesh: &Mesh, ray: &Ray, sides: Sides) -> Option<NearestHit> {
        let limit = self.limit;
        let mut first: Option<(ExactT, Vec<u32>)> = None;
        for candidate in self.candidates.into_iter().filter(|candidate| candidate.low <= limit) {
            let exact = candidate.exact.or_else(|| whole::intersect(ray, &mesh.corners(candidate.triangle)?, sides));
            let Some(t) = exact else { continue };
            match &mut first {
                Some((best, ties)) => match t.cmp(best) {
                    Ordering::Less => first = Some((t, vec![candidate.triangle])),
                    Ordering::Equal => ties.push(candidate.triangle),
                    Ordering::Greater => {}
                },
                None => first = Some((t, vec![candidate.triangle])),
            }
        }
        let (t, mut ties) = first?;
        ties.sort_unstable();
        Some(NearestHit { triangle: ties[0], t, ties })
    }
}
