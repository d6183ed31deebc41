//! Culling in the vertex program for rays of any origin (section 5.3): constants of a bucket of rays.
//!
//! The pixel program draws a hit where u, v, w >= 0, n.ao >= 0 and n.d < 0 (for back faces: all signs reversed). Each
//! of these is linear in the origin and in the direction. So with origins oc + x and directions dc + y, for an edge e
//! (ac for u, -ab for v, -bc and b for w):
//!
//! `e . (ao x d) = dc . (e x ao)  +  y . (e x ao)  +  x . (dc x e)  +  e . (x x y)`
//!
//! The first term is the middle ray's. The others are at most |e x ao| . dh, |dc x e| . oh and |e| . q, where |x| <=
//! oh, |y| <= dh and q is the vector of oh_j dh_k + oh_k dh_j; n.ao and n.d have analogous bounds. A triangle is culled
//! if one of the numbers has the wrong sign for every ray of the bucket.
//!
//! **No hit is lost to rounding.** The card and its vertex program make rounding errors. Each is bounded by a fraction
//! of the product of magnitudes, plus a constant for underflow or for the steps of fixed point; both bounds are
//! computed from the largest |a| + |o| and |d| of the pass, and added to q and to the absolute tolerances. If an
//! intermediate could leave the range of the format, the triangle is not culled.

use glam::DVec3;
use refsim::device::Rules;
use refsim::num::{Format, FormatKind, power_of_two};

use super::RayBatch;
use super::reach::mixed;
use super::units::Units;
use crate::geom::Mesh;
use crate::geom::exact::Sides;
use crate::geom::vector::{narrow, wide};
use crate::tracer::scale::normalize_range;

/// Number of constants of a bucket: c3 to c10.
const COUNT: usize = 8;

#[derive(Clone, Copy, Debug)]
struct Errors {
    /// Error relative to the magnitudes of the operands, large enough for all operations of a program.
    share: f64,
    /// Additional absolute error of an operation.
    step: f64,
    /// Absolute error of a number stored in a texture.
    texel: f64,
    /// Bound on every intermediate that is a product of up to three of the largest numbers.
    largest: f64,
    /// `true` if the bound is the end of a fixed-point range, to which single numbers are limited too.
    fixed: bool,
}

impl Errors {
    fn of(rules: &Rules) -> Self {
        let (pixel, vertex) = (Self::of_format(&rules.format), Self::of_format(&rules.vertex_format));
        Self {
            share: pixel.share.max(vertex.share),
            step: pixel.step.max(vertex.step),
            texel: pixel.texel,
            largest: pixel.largest.min(vertex.largest),
            fixed: pixel.fixed || vertex.fixed,
        }
    }

    fn of_format(format: &Format) -> Self {
        match format.kind {
            FormatKind::Fixed { int_bits, frac_bits } | FormatKind::Normalized { int_bits, frac_bits } => {
                let step = match format.denominator() {
                    1 => power_of_two(-i32::from(frac_bits)),
                    denominator => 1.0 / f64::from(denominator),
                };
                // Ray textures of fixed-point cards have 16 bits.
                let texel = 2.0 * step + power_of_two(-14);
                Self { share: 0.0, step, texel, largest: power_of_two(i32::from(int_bits)), fixed: true }
            }
            FormatKind::Float { exp_bits, man_bits } => {
                let bias = power_of_two(i32::from(exp_bits) - 1) as i32 - 1;
                let share = 64.0 * power_of_two(-i32::from(man_bits) - 1);
                let step = power_of_two(18 - bias);
                Self { share, step, texel: 0.0, largest: power_of_two(bias / 3 - 2), fixed: false }
            }
        }
    }
}

/// Constants with which no triangle is culled: no triangle satisfies |ab| + |ac| <= -1.
pub(super) fn nothing() -> Vec<[u32; 4]> {
    let mut out = vec![[0.0_f32; 4]; COUNT];
    out[COUNT - 1][2] = -1.0;
    out.into_iter().map(|c| c.map(f32::to_bits)).collect()
}

/// Computes the constants of a bucket that is tested against some triangles: c3 to c10 of `*_bucket.vsa`.
pub(super) fn bucket(
    rules: &Rules,
    units: &Units,
    mesh: &Mesh,
    triangles: &[u32],
    rays: &RayBatch,
    sides: Sides,
) -> Vec<[u32; 4]> {
    let errors = Errors::of(rules);
    let origins = Extent::of(rays.rays().iter().map(|ray| wide(ray.origin()) * units.scale()));
    let directions = Extent::of(rays.rays().iter().map(|ray| normalize_range(ray.direction()).0));
    let corners = triangles.iter().filter_map(|id| mesh.corners(*id)).flatten();
    let places = Extent::of(corners.map(|corner| wide(corner) * units.scale()));
    let (Some(origins), Some(directions), Some(places)) = (origins, directions, places) else { return nothing() };
    let (origins, directions) = (origins.grown(errors.texel), directions.grown(errors.texel));
    constants([&origins, &directions, &places], errors, sides)
}

/// Box of vectors: its center (a single-precision number), half its extent, and the largest magnitudes.
#[derive(Clone, Copy, Debug)]
struct Extent {
    middle: DVec3,
    half: DVec3,
    most: DVec3,
}

impl Extent {
    fn of(vectors: impl Iterator<Item = DVec3>) -> Option<Self> {
        let mut bounds: Option<[DVec3; 2]> = None;
        for v in vectors {
            let [low, high] = bounds.get_or_insert([v, v]);
            (*low, *high) = (low.min(v), high.max(v));
        }
        let [low, high] = bounds?;
        let middle = wide(narrow(0.5 * (low + high)));
        let half = (high - middle).max(middle - low);
        Some(Self { middle, half, most: low.abs().max(high.abs()) })
    }

    fn grown(self, by: f64) -> Self {
        Self { middle: self.middle, half: self.half + by, most: self.most + by }
    }
}

/// The constants from the tolerances of the culling tests, including rounding.
fn constants([origins, directions, places]: [&Extent; 3], errors: Errors, sides: Sides) -> Vec<[u32; 4]> {
    let Errors { share, step, .. } = errors;
    let d = directions.most;
    let a = places.most + origins.most;
    let products = mixed(a, d);
    let others = 2.0 * a.element_sum() + 2.0 * d.element_sum() + 4.0;
    // Tolerances of n.ao and n.d relative to |n|, and of u, v and w relative to their edge, in addition to the terms
    // known per triangle.
    let n_ao = origins.half + share * a + step * (8.0 + d);
    let n_d = directions.half + share * d + 2.0 * step;
    let edge = mixed(origins.half, directions.half) + share * products + 2.0 * step * others;
    // Absolute tolerances of n.ao, n.d and of u, v, w. One program divides n.ao by four before it tests its sign.
    let alone = [
        8.0 * step * (a.element_sum() + 4.0),
        2.0 * step * (d.element_sum() + 4.0),
        2.0 * step * (products.element_sum() + d.element_sum() + 8.0),
    ];
    let [alone_n_ao, alone_n_d, alone_uvw] = alone.map(|x| upward(x as f32));
    let front = f64::from(u8::from(sides == Sides::Front));
    let vector = |v: DVec3, w: f64| [v.x as f32, v.y as f32, v.z as f32, w as f32];
    let up = |v: DVec3| vector(v, 0.0).map(upward);
    let all: [[f32; 4]; COUNT] = [
        vector(origins.middle, front),
        up(origins.half),
        vector(directions.middle, 0.0),
        up(directions.half),
        up(n_ao),
        up(edge),
        up(n_d),
        [alone_n_ao, alone_n_d, most_edges(a, d, products, errors) as f32, alone_uvw],
    ];
    all.map(|c| c.map(f32::to_bits)).to_vec()
}

/// Returns the largest |ab| + |ac| at which no intermediate leaves the range of the format; negative if some
/// intermediate leaves it regardless of the triangle.
fn most_edges(a: DVec3, d: DVec3, products: DVec3, errors: Errors) -> f64 {
    let (range, largest) = (0.5 * errors.largest, a.max(d).max(products).max_element());
    let limit = if errors.fixed { 0.9 * errors.largest } else { errors.largest };
    if largest > limit {
        return -1.0;
    }
    if !errors.fixed {
        return errors.largest;
    }
    // With s = |ab| + |ac|: |n| <= s^2 / 4, |n.ao| and |n.d| <= 3 |n| times a or d, and u, v, w at most an edge times
    // the products.
    let normal = (range * 4.0 / (3.0 * largest.max(1.0))).sqrt();
    range.min(normal).min(range / products.max_element().max(1.0))
}

/// Rounds a bound to f32, upwards by one or two ULPs, so that it is not too small.
fn upward(x: f32) -> f32 {
    if x > 0.0 && x.is_finite() { (x * (1.0 + 4.0 * f32::EPSILON)).max(f32::MIN_POSITIVE) } else { x }
}
