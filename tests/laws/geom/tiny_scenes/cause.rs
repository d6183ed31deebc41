//! Causes of wrong fp32 answers: the quantity that rounding changed.

use crossbar::geom::exact;
use crossbar::geom::{Hit, Mesh, Ray, Sides};
use crossbar::oracle::{Disagreement, DisagreementKind};

/// The quantity whose rounding caused a wrong fp32 answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Cause {
    /// The sign of u, v or w: the side of an edge on which the ray passes.
    Edge,
    /// The sign of n.d, or the normal itself: triangle and ray are so nearly coplanar that fp32 finds the other side,
    /// or no normal.
    Plane,
    /// The sign of t: the origin lies on the surface, or next to it.
    Start,
    /// t by more than the tolerance, or the order of two values of t.
    Depth,
    /// An infinity, or a NaN from one, as an intermediate result.
    Overflow,
    /// An intermediate result below the normal range.
    Underflow,
}

impl Cause {
    pub(crate) const ALL: [Self; 6] =
        [Self::Edge, Self::Plane, Self::Start, Self::Depth, Self::Overflow, Self::Underflow];
}

/// Equations (1) to (8) in one number format, with the direction scaled by a power of two.
macro_rules! equations {
    ($name:ident, $real:ty) => {
        pub(crate) struct $name {
            n: [$real; 3],
            n_ao: $real,
            n_d: $real,
            inside: [$real; 3],
            products: Vec<$real>,
        }

        impl $name {
            pub(crate) fn new(ray: &Ray, corners: [[f32; 3]; 3], scale: f64) -> Self {
                let largest = ray.direction().iter().fold(0.0f32, |m, x| m.max(x.abs()));
                let d = ray.direction().map(|x| half_to_one(x, largest) as $real);
                let scaled = |p: [f32; 3]| p.map(|x| (f64::from(x) * scale) as $real);
                let o = scaled(ray.origin());
                let [a, b, c] = corners.map(scaled);
                let mut products = Vec::new();
                let sub = |p: [$real; 3], q: [$real; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
                let mut dot = |p: [$real; 3], q: [$real; 3]| {
                    products.extend([p[0] * q[0], p[1] * q[1], p[2] * q[2]]);
                    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
                };
                let cross = |p: [$real; 3], q: [$real; 3]| {
                    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
                };
                let (ab, ac, bc, ao, bo) = (sub(b, a), sub(c, a), sub(c, b), sub(o, a), sub(o, b));
                let n = cross(ab, ac);
                let (aod, bod) = (cross(ao, d), cross(bo, d));
                let inside = [dot(ac, aod), dot(ab.map(|x| -x), aod), dot(bc.map(|x| -x), bod)];
                let (n_ao, n_d) = (dot(n, ao), dot(n, d));
                products.extend(n.into_iter().chain(aod).chain(bod));
                Self { n, n_ao, n_d, inside, products }
            }

            pub(crate) fn t(&self) -> $real {
                self.n_ao * -self.n_d.recip()
            }

            fn faces(&self, sides: Sides) -> bool {
                self.n_d < 0.0 || (sides == Sides::Both && self.n_d > 0.0)
            }

            fn outside(&self) -> bool {
                let sign = if self.n_d < 0.0 { 1.0 } else { -1.0 };
                self.inside.iter().any(|x| x * sign < 0.0)
            }
        }
    };
}

equations!(Single, f32);
equations!(Double, f64);

/// The power of two that brings the largest coordinate of a mesh into (2, 4]: the units of single-precision tests.
pub(crate) fn scale(mesh: &Mesh) -> f64 {
    let largest = mesh.iter_corners().flatten().flatten().fold(0.0f64, |m, x| m.max(f64::from(x).abs()));
    let mut scale = 1.0;
    while largest * scale > 4.0 {
        scale /= 2.0;
    }
    while largest > 0.0 && largest * scale <= 2.0 {
        scale *= 2.0;
    }
    scale
}

/// A component of a direction, scaled by the power of two that brings the largest component into [1/2, 1).
fn half_to_one(x: f32, largest: f32) -> f64 {
    let mut scaled = (f64::from(x), f64::from(largest));
    while scaled.1 >= 1.0 {
        scaled = (scaled.0 / 2.0, scaled.1 / 2.0);
    }
    while scaled.1 < 0.5 {
        scaled = (scaled.0 * 2.0, scaled.1 * 2.0);
    }
    scaled.0
}

impl Single {
    fn overflows(&self) -> bool {
        !self.products.iter().chain(&[self.n_ao, self.n_d, self.t()]).all(|x| x.is_finite()) && self.n_d != 0.0
    }

    /// Returns `true` if a product of nonzero factors is subnormal or 0 in f32, by comparison with f64.
    fn underflows(&self, double: &Double) -> bool {
        let lost = |(single, double): (&f32, &f64)| {
            double.abs() > 0.0 && single.abs() < f32::MIN_POSITIVE && double.abs() < f64::from(f32::MIN_POSITIVE)
        };
        self.products.iter().zip(&double.products).any(lost)
    }

    /// The f32 condition that rejects the ray: plane, edge or start.
    fn turned(&self, sides: Sides) -> Cause {
        if self.n == [0.0; 3] || !self.faces(sides) {
            Cause::Plane
        } else if self.outside() {
            Cause::Edge
        } else {
            Cause::Start
        }
    }
}

impl Double {
    /// The condition that a triangle without a hit fails in f64.
    fn fails(&self, sides: Sides) -> Cause {
        if self.outside() && self.n_d != 0.0 {
            Cause::Edge
        } else if self.n_d != 0.0 && self.t() < 0.0 {
            Cause::Start
        } else if self.n == [0.0; 3] || !self.faces(sides) {
            Cause::Plane
        } else {
            Cause::Edge
        }
    }
}

/// The f32 test of one triangle at a scale, implemented independently; t is measured along the scaled direction.
pub(crate) fn meets(ray: &Ray, corners: [[f32; 3]; 3], sides: Sides, scale: f64) -> bool {
    let single = Single::new(ray, corners, scale);
    let t = single.t();
    single.faces(sides) && !single.outside() && (0.0..f32::INFINITY).contains(&t)
}

/// The cause of one disagreement between the f32 test over all pairs and exact arithmetic.
pub(crate) fn of(mesh: &Mesh, ray: &Ray, sides: Sides, wrong: &Disagreement) -> Cause {
    let scale = scale(mesh);
    let corners = |triangle| mesh.corners(triangle).expect("a triangle of the mesh");
    let (single, double) =
        (|triangle| Single::new(ray, corners(triangle), scale), |triangle| Double::new(ray, corners(triangle), scale));
    let limits = |triangle| {
        let (single, double) = (single(triangle), double(triangle));
        if single.overflows() { Some(Cause::Overflow) } else { single.underflows(&double).then_some(Cause::Underflow) }
    };
    let first = wrong.expected.as_ref().map(|truth| truth.triangles[0]);
    let found = wrong.found.map(|Hit { triangle, .. }| triangle);
    let missed =
        first.filter(|&first| wrong.kind != DisagreementKind::TOff && !meets(ray, corners(first), sides, scale));
    if let Some(first) = missed {
        return limits(first).unwrap_or_else(|| single(first).turned(sides));
    }
    let Some(found) = found else { return Cause::Depth };
    if let Some(limit) = limits(found) {
        return limit;
    }
    let truly = exact::intersect(ray, &corners(found), sides).is_some();
    if truly { Cause::Depth } else { double(found).fails(sides) }
}
