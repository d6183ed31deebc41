//! Ground truth: which triangles a ray hits, and which first, decided in exact arithmetic on the f32 values as given.
//!
//! **Definitions.** A triangle is closed: its edges and corners belong to it. A hit has t >= 0, where t is in multiples
//! of the ray's direction. A ray in the triangle's plane (n.d = 0) misses it, so that a triangle without area (n = 0)
//! is never hit. n = (b - a) x (c - a); a ray comes from the front if n.d < 0. Hits are ordered by exact t, then by id;
//! all triangles that tie for the first t are reported.
//!
//! **Method.** With A = a - o and so on, the signs of d.(BxC), d.(CxA), d.(AxB) (whose sum is n.d) show on which side
//! of each edge the ray passes, and t = (n.A) / (n.d). [`integer`] evaluates these as integers of any size, since an
//! f32 is an integer times a power of two. [`filter`] runs first: it evaluates the signs in f64 with a proved error
//! bound and decides only the cases that are certain; [`Tracer`] adds a tree of boxes that never skips a hit. Property
//! tests compare all three.

pub mod filter;
mod hit;
pub mod integer;
pub mod ratio;
mod tree;

use std::cmp::Ordering;

use super::{Mesh, Ray};
pub use filter::Guess;
pub use hit::{ExactT, NearestHit, Sides};
pub use tree::{Tracer, nearest_all};

/// Intersects a ray with a triangle of finite corners: by the filter, or in integers where the filter is uncertain.
pub fn intersect(ray: &Ray, triangle: &[[f32; 3]; 3], sides: Sides) -> Option<ExactT> {
    match filter::guess(ray, triangle, sides) {
        Guess::Miss => None,
        Guess::Hit { .. } | Guess::Unclear => integer::intersect(ray, triangle, sides),
    }
}

/// Returns the first hit of a ray by testing all triangles. For many rays use [`nearest_all`] or a [`Tracer`].
///
/// ```
/// # extern crate crossbar_base as crossbar;
/// use crossbar::geom::{Mesh, Ray, Sides, exact};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let square = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]])?;
/// // Onto the diagonal: both triangles are first, at exactly one third.
/// let ray = Ray::new([0.5, 0.5, 1.0], [0.0, 0.0, -3.0])?;
/// let hit = exact::nearest(&square, &ray, Sides::Front).ok_or("a hit")?;
/// assert_eq!((hit.ties, hit.t.to_f64()), (vec![0, 1], 1.0 / 3.0));
/// # Ok(())
/// # }
/// ```
pub fn nearest(mesh: &Mesh, ray: &Ray, sides: Sides) -> Option<NearestHit> {
    let mut shortlist = Shortlist::new();
    for (triangle, corners) in (0..).zip(mesh.iter_corners()) {
        shortlist.try_triangle(ray, triangle, &corners, sides);
    }
    shortlist.settle(mesh, ray, sides)
}

/// Returns `true` if a triangle has exactly no area: n = 0.
pub fn is_degenerate(triangle: &[[f32; 3]; 3]) -> bool {
    !filter::has_area(triangle) && integer::is_degenerate(triangle)
}

/// Returns the sign of a polygon's area in the plane: `Greater` if its corners run counter-clockwise.
pub fn winding(corners: &[[f32; 2]]) -> Ordering {
    filter::winding(corners).unwrap_or_else(|| integer::winding(corners))
}

impl Mesh {
    /// Number of triangles with exactly no area: two coincident corners, or three on one line.
    pub fn degenerate_count(&self) -> usize {
        self.iter_corners().filter(is_degenerate).count()
    }
}

/// Hits that may be the first, with bounds of t.
struct Shortlist {
    candidates: Vec<Candidate>,
    /// Upper bound of the first t.
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
                let Some(t) = integer::intersect(ray, corners, sides) else { return };
                let near = t.to_f64();
                (filter::below(near), filter::above(near), Some(t))
            }
        };
        if low <= self.limit {
            self.limit = if high < self.limit { high } else { self.limit };
            self.candidates.push(Candidate { triangle, low, exact });
        }
    }

    fn settle(self, mesh: &Mesh, ray: &Ray, sides: Sides) -> Option<NearestHit> {
        let limit = self.limit;
        let mut first: Option<(ExactT, Vec<u32>)> = None;
        for candidate in self.candidates.into_iter().filter(|candidate| candidate.low <= limit) {
            let exact = candidate.exact.or_else(|| integer::intersect(ray, &mesh.corners(candidate.triangle)?, sides));
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
