//! Interval bounds of the intermediates of a batch, over all its rays, in f64.

use glam::{DVec3, Vec3Swizzles};

use super::RayBatch;
use crate::geom::vector::wide;
use crate::tracer::scale::normalize_range;

/// Margin between the largest t and depth 1, which means no hit, including rounding.
const ROOM: f64 = 1.0 + 1.0 / 32.0;

/// Box of vectors: the lowest and the highest components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct VectorRange([DVec3; 2]);

impl VectorRange {
    pub(super) fn times(self, factor: f64) -> Self {
        Self(self.0.map(|v| v * factor))
    }

    /// Translates the box by -p.
    pub(super) fn minus(self, p: DVec3) -> Self {
        Self(self.0.map(|v| v - p))
    }

    fn include(&mut self, v: DVec3) {
        let [low, high] = self.0;
        self.0 = [low.min(v), high.max(v)];
    }

    /// Largest magnitude of each component.
    pub(super) fn magnitudes(self) -> DVec3 {
        self.0[0].abs().max(self.0[1].abs())
    }

    /// Lowest and highest value of one component.
    fn axis(&self, axis: usize) -> [f64; 2] {
        [self.0[0][axis], self.0[1][axis]]
    }

    /// Largest magnitude of the inner product with a vector.
    pub(super) fn dot(&self, v: DVec3) -> f64 {
        let terms = [0, 1, 2].map(|axis| scaled(v[axis], self.axis(axis)));
        magnitude(added(added(terms[0], terms[1]), terms[2]))
    }

    /// Largest magnitude of e . (v x d) = d . (e x v), for v in this box and d in another.
    pub(super) fn triple(&self, e: DVec3, d: Self) -> f64 {
        let term = |q: usize| {
            let (j, k) = ((q + 1) % 3, (q + 2) % 3);
            product(added(scaled(e[j], self.axis(k)), scaled(-e[k], self.axis(j))), d.axis(q))
        };
        magnitude(added(added(term(0), term(1)), term(2)))
    }
}

fn scaled(by: f64, [low, high]: [f64; 2]) -> [f64; 2] {
    if by < 0.0 { [by * high, by * low] } else { [by * low, by * high] }
}

fn added(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

fn product(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let (first, second) = (scaled(a[0], b), scaled(a[1], b));
    [first[0].min(second[0]), first[1].max(second[1])]
}

fn magnitude([low, high]: [f64; 2]) -> f64 {
    low.abs().max(high.abs())
}

/// Largest magnitude of the partial sums of an inner product with a vector: each term, the sum of two, the sum of
/// three.
pub(super) fn most_of_partial_sums(v: DVec3, most: impl Fn(DVec3) -> f64) -> f64 {
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| v * axis);
    let sums = [x, y, z, x + y, v];
    sums.into_iter().map(most).fold(0.0, f64::max)
}

/// Bounds on the components of a cross product of vectors with these magnitudes.
pub(super) fn mixed(a: DVec3, d: DVec3) -> DVec3 {
    DVec3::new(a.y * d.z + a.z * d.y, a.z * d.x + a.x * d.z, a.x * d.y + a.y * d.x)
}

pub(super) fn largest(v: DVec3) -> f64 {
    v.abs().max_element()
}

/// Sum of the magnitudes of an inner product's terms.
pub(super) fn inner(v: DVec3, most: DVec3) -> f64 {
    v.abs().dot(most)
}

/// Largest magnitudes of a scene and a batch of rays.
pub(super) struct Reach {
    /// Bound on a component of a corner.
    pub(super) position: f64,
    /// Bound on a component of an origin.
    pub(super) origin: f64,
    /// Bound on a component of origin minus corner.
    pub(super) offset: f64,
    /// Bound on a component of (origin minus corner) x direction in range, and on its two products.
    pub(super) cross: f64,
    /// Bound on t for directions brought into range, with a margin below depth 1.
    pub(super) t: f64,
    pub(super) origins: VectorRange,
    /// Box of the directions in range.
    pub(super) directions: VectorRange,
}

impl Reach {
    pub(super) fn of(bounds: [[f32; 3]; 2], rays: &RayBatch) -> Self {
        let [low, high] = bounds.map(wide);
        let mut all = rays.rays().iter().map(|r| (wide(r.origin()), normalize_range(r.direction()).0)).peekable();
        let first = all.peek().copied().unwrap_or_default();
        let mut reach = Self {
            position: largest(low).max(largest(high)),
            origin: 0.0,
            offset: 0.0,
            cross: 0.0,
            t: 0.0,
            origins: VectorRange([first.0; 2]),
            directions: VectorRange([first.1; 2]),
        };
        for (origin, d) in all {
            reach.origins.include(origin);
            reach.directions.include(d);
            let [p, q] = [origin - low, origin - high];
            let farthest = p.abs().max(q.abs());
            reach.origin = reach.origin.max(largest(origin));
            reach.offset = reach.offset.max(largest(farthest));
            // The magnitudes of its terms bound a ray's cross product, so few rays can have the largest.
            if largest(mixed(farthest, d.abs())) > reach.cross {
                let mut offsets = VectorRange([p; 2]);
                offsets.include(q);
                let d_alone = VectorRange([d; 2]);
                let components = DVec3::from(DVec3::AXES.map(|axis| offsets.triple(axis, d_alone)));
                let products = [d.yzx(), d.zxy()].map(|d| largest(farthest * d));
                reach.cross = reach.cross.max(largest(components)).max(products[0]).max(products[1]);
            }
            // The largest component of a direction in range is at least 1/2, so a corner at distance r is met at t <= 2
            // r, and by the length of d at t <= r / |d|.
            reach.t = reach.t.max(farthest.length() / d.length() * ROOM);
        }
        reach
    }
}
