//! Bounds of a card's rounding errors of u, v, w, n.d, n.ao and t: forward error analysis of the programs, operation by
//! operation, for formats without overflow or underflow. Each operation is charged one full rounding step, which covers
//! every rounding mode.
//!
//! The scale factors of scene and edges are not read from the program under test. Fixed-point errors are computed for
//! the worst scale that the rule "as large as fits" admits: S within a factor of eight, k at least half of the value
//! for coarse magnitudes.

use crossbar::geom::exact::Sides;
use crossbar::geom::vector::wide;
use crossbar::geom::{Mesh, Ray};
use crossbar::ray_engine::RayBatch;
use glam::{DVec3, Vec3Swizzles};
use refsim::device::{Rules, TexdepthDenominator};
use refsim::num::FormatKind;

use refsim::num::power_of_two;

/// Relative error of a vertex program: a few operations in single precision.
const SINGLE: f64 = 1.0 / (1 << 20) as f64;
/// Relative depth below which a hit certainly lies before the far plane.
const LAST_DEPTH: f64 = 0.02;

/// The first hit of a ray, if the error bounds leave no doubt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum First {
    Hit { triangle: u32, t: f64, error: f64 },
    Miss,
    Unclear,
}

/// The result for one triangle and one ray.
enum Judgement {
    Hit {
        t: f64,
        error: f64,
    },
    Miss,
    /// The error bounds allow a hit or a miss; a hit would be at this t or beyond.
    Unclear {
        from: f64,
    },
}

/// The bounds of a batch.
pub(crate) struct Bounds {
    format: FormatKind,
    /// `true` if `texdepth` clamps its divisor, n.d, to 1.
    min1: bool,
    one_origin: bool,
    /// The largest component of the offsets; below, of origins and of corners.
    offset: f64,
    origin: f64,
    corner: f64,
    /// The largest t of a ray whose direction is in range.
    t: f64,
}

/// Exact values, up to the rounding of f64, for a ray whose direction is in range.
struct Exact {
    edges: [DVec3; 3],
    offsets: [DVec3; 2],
    d: DVec3,
    n: DVec3,
    /// u, v and w.
    inside: [f64; 3],
    n_d: f64,
    n_ao: f64,
}

/// Error bounds of the values of [`Exact`] and of t; and the smallest magnitude of n.ao whose sign is certain.
#[derive(Clone, Copy)]
struct Errors {
    inside: [f64; 3],
    n_d: f64,
    n_ao: f64,
    t: f64,
    /// Error of the depth, relative to its range.
    depth: f64,
}

fn largest(v: DVec3) -> f64 {
    v.abs().max_element()
}

fn sum(v: DVec3) -> f64 {
    v.abs().element_sum()
}

/// Sum of the magnitudes of the terms of an inner product.
fn inner(a: DVec3, b: DVec3) -> f64 {
    a.abs().dot(b.abs())
}

/// Sums of the magnitudes of the terms of a cross product.
fn mixed(a: DVec3, b: DVec3) -> DVec3 {
    let (a, b) = (a.abs(), b.abs());
    a.yzx() * b.zxy() + a.zxy() * b.yzx()
}

/// The largest power of two that does not exceed a positive number.
fn power_below(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & 0x7ff0_0000_0000_0000)
}

/// The direction scaled into range, and the power of two by which it was scaled.
fn in_range(ray: &Ray) -> (DVec3, f64) {
    let d = wide(ray.direction());
    let power = 0.5 / power_below(largest(d));
    (d * power, power)
}

impl Exact {
    fn new(o: DVec3, d: DVec3, corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let (ab, ac, bc) = (b - a, c - a, c - b);
        let (ao, bo, n) = (o - a, o - b, ab.cross(ac));
        let (aod, bod) = (ao.cross(d), bo.cross(d));
        let inside = [ac.dot(aod), -ab.dot(aod), -bc.dot(bod)];
        Self { edges: [ac, ab, bc], offsets: [ao, bo], d, n, inside, n_d: n.dot(d), n_ao: n.dot(ao) }
    }
}

impl Bounds {
    pub(crate) fn new(rules: &Rules, mesh: &Mesh, rays: &RayBatch) -> Self {
        let bounds = mesh.bounds().expect("triangles").map(wide);
        let mut out = Self {
            format: rules.format.kind,
            min1: rules.texdepth_denominator == TexdepthDenominator::Min1,
            one_origin: rays.common_origin().is_some(),
            offset: 0.0,
            origin: 0.0,
            corner: largest(bounds[0]).max(largest(bounds[1])),
            t: 0.0,
        };
        for ray in rays.rays() {
            let o = wide(ray.origin());
            let far = (o - bounds[0]).abs().max((o - bounds[1]).abs());
            let (d, _) = in_range(ray);
            out.origin = out.origin.max(largest(o));
            out.offset = out.offset.max(largest(far));
            out.t = out.t.max((far.dot(far) / d.dot(d)).sqrt());
        }
        out
    }

    pub(crate) fn first(&self, mesh: &Mesh, ray: &Ray, sides: Sides) -> First {
        let mut first = First::Miss;
        let mut others = f64::INFINITY;
        for (triangle, corners) in (0..).zip(mesh.iter_corners()) {
            match self.judge(ray, corners, sides) {
                Judgement::Unclear { from } => others = others.min(from),
                Judgement::Miss => {}
                Judgement::Hit { t, error } => {
                    let nearer = match first {
                        First::Hit { t: best, error: best_error, .. } => {
                            let nearer = t < best;
                            others = others.min(if nearer { best - best_error } else { t - error });
                            nearer
                        }
                        _ => true,
                    };
                    if nearer {
                        first = First::Hit { triangle, t, error };
                    }
                }
            }
        }
        match first {
            First::Hit { t, error, .. } if t + error >= others => First::Unclear,
            First::Miss if others < f64::INFINITY => First::Unclear,
            first => first,
        }
    }

    fn judge(&self, ray: &Ray, corners: [[f32; 3]; 3], sides: Sides) -> Judgement {
        let (d, power) = in_range(ray);
        let (o, corners) = (wide(ray.origin()), corners.map(wide));
        let exact = Exact::new(o, d, corners);
        let errors = match self.format {
            FormatKind::Fixed { int_bits, frac_bits } => {
                self.fixed(&exact, power_of_two(int_bits.into()), power_of_two(-i32::from(frac_bits)))
            }
            FormatKind::Normalized { int_bits, frac_bits } => {
                self.fixed(&exact, power_of_two(int_bits.into()), 1.0 / f64::from((1 << frac_bits) - 1))
            }
            FormatKind::Float { exp_bits, man_bits } => self.float(&exact, (o, corners), exp_bits, man_bits),
        };
        let passes = |sign: f64| {
            // A miss is certain if one value certainly has the wrong sign; a hit is certain if all signs are certainly
            // right.
            let margins = [
                sign * exact.inside[0] / errors.inside[0],
                sign * exact.inside[1] / errors.inside[1],
                sign * exact.inside[2] / errors.inside[2],
                -sign * exact.n_d / (4.0 * errors.n_d),
                sign * exact.n_ao / errors.n_ao,
            ];
            if margins.iter().any(|&m| m < -1.0) {
                Some(false)
            } else if margins.iter().all(|&m| m > 1.0) && errors.depth < LAST_DEPTH {
                Some(true)
            } else {
                None
            }
        };
        let verdict = match (passes(1.0), sides) {
            (Some(true), _) => Some(true),
            (front, Sides::Front) => front,
            (front, Sides::Both) => match (front, passes(-1.0)) {
                (_, Some(true)) => Some(true),
                (Some(false), Some(false)) => Some(false),
                _ => None,
            },
        };
        match verdict {
            Some(true) => Judgement::Hit { t: -exact.n_ao / exact.n_d * power, error: errors.t * power },
            Some(false) => Judgement::Miss,
            // If n.d is near 0, the bound of t is useless: any t is possible.
            None if exact.n_d.abs() > 4.0 * errors.n_d && errors.depth < LAST_DEPTH => {
                Judgement::Unclear { from: (-exact.n_ao / exact.n_d - errors.t) * power }
            }
            None => Judgement::Unclear { from: f64::NEG_INFINITY },
        }
    }

    /// Errors in fixed point, for the worst admissible scale.
    fn fixed(&self, exact: &Exact, end: f64, step: f64) -> Errors {
        let mut least = end / (4.0 * self.offset);
        if !self.one_origin {
            least = least.min(0.5 * end.min(1.0) / self.origin).min(0.5 * end / self.corner).min(2.0 / self.t);
        }
        let least = power_below(least);
        let at = |i: i32| self.fixed_at(exact, end, step, least * power_of_two(i));
        (1..4).map(at).fold(at(0), |a, b| Errors {
            inside: [0, 1, 2].map(|i| a.inside[i].max(b.inside[i])),
            n_d: a.n_d.max(b.n_d),
            n_ao: a.n_ao.max(b.n_ao),
            t: a.t.max(b.t),
            depth: a.depth.max(b.depth),
        })
    }

    /// Errors in fixed point at one scale, in card units per scene unit.
    fn fixed_at(&self, exact: &Exact, end: f64, step: f64, scale: f64) -> Errors {
        let offset = (self.offset * scale).min(end);
        let edge = exact.edges.map(largest).into_iter().fold(0.0, f64::max) * scale;
        let normal = largest(exact.n) * scale * scale;
        let t_max = if self.one_origin { 2.2 * self.t * scale } else { 4.0 };
        // Half a step of a 16-bit code, and the register's step, doubled by _bx2.
        let texel = power_of_two(-15) + 2.0 * step;
        let ao = if self.one_origin { step } else { texel + 2.0 * step } + SINGLE * offset;
        let aod = 2.0 * offset * texel + 2.1 * ao + 4.0 * step;
        let n_ao_sum = 3.0 * normal * offset / if self.one_origin { t_max / 2.2 } else { 1.0 };
        let n_d_sum = 3.3 * normal * if self.min1 { end } else { 1.0 };
        let sums = [6.0 * edge * (offset + aod) + normal * texel, n_d_sum, 1.1 * n_ao_sum, edge];
        let k = power_below((0.5 * end / sums.into_iter().fold(0.0, f64::max)).min(1.0));
        let stored = step + SINGLE * k * edge;
        let stored_normal = step + SINGLE * k * edge * edge;
        let along = |e: DVec3| k * scale * sum(e) * aod + 3.0 * stored * (2.0 * offset + aod) + 6.0 * step;
        let n = k * scale * scale * sum(exact.n);
        let n_d = n * texel + 3.1 * stored_normal + 6.0 * step;
        let n_ao = if self.one_origin {
            (3.0 * offset * SINGLE * k * (edge * edge + normal)) / (t_max / 2.2) + step
        } else {
            (n * ao + 3.0 * stored_normal * (offset + ao) + 6.0 * step) / 4.0 + step
        };
        let area = k * scale * scale;
        let depth = (exact.n_ao / exact.n_d).abs() * scale / t_max;
        let quotient =
            (n_ao + depth * n_d) / ((exact.n_d * area).abs() - n_d).max(1e-300) + 2.0 * step + power_of_two(-23);
        let n_ao_unit = area * scale / if self.one_origin { t_max / 2.2 } else { 4.0 };
        Errors {
            inside: [
                along(exact.edges[0]) / area,
                along(exact.edges[1]) / area,
                (along(exact.edges[2]) + n_d + step) / area,
            ],
            n_d: n_d / area,
            n_ao: n_ao / n_ao_unit,
            t: quotient * t_max / scale,
            depth: quotient,
        }
    }

    fn float(&self, exact: &Exact, (o, [a, b, _]): (DVec3, [DVec3; 3]), exp_bits: u8, man_bits: u8) -> Errors {
        let share = power_of_two(-i32::from(man_bits));
        let bias = (1 << (exp_bits - 1)) - 1;
        // Below the smallest normal number errors are absolute; half the smallest scale is a safe bound.
        let (tiny, end) = (power_of_two(1 - bias), power_of_two(bias - 1));
        let most = end / 4.0;
        let scale = 0.5 * power_below((most.min(4.0) / self.corner).min(most / self.offset.max(self.origin)));
        let normal = largest(exact.n);
        let edge = exact.edges.map(largest).into_iter().fold(0.0, f64::max);
        // Factor for the areas: brings the normal near 1, or is smaller if sums would leave the range.
        let sums = (6.0 * edge * self.offset)
            .max(3.3 * normal)
            .max(3.0 * normal * self.offset * scale * 4.0)
            .max(edge / scale);
        let area = if exp_bits < 8 { (0.5 / normal).min(0.25 * end / sums) } else { scale * scale };
        let lost = 16.0 * tiny / area;
        let point = |p: DVec3| share * (o.abs() + p.abs() + (o - p).abs()) + 4.0 * tiny / scale;
        let along = |e: DVec3, p: DVec3, offset: DVec3| {
            let (error, terms) = (point(p), mixed(offset, exact.d));
            let moved = mixed(error, exact.d);
            let errors = moved + 6.0 * share * terms + 4.0 * tiny / scale;
            inner(e, errors) + 10.0 * share * inner(e, terms + errors) + lost
        };
        let [ao, bo] = exact.offsets;
        let stored = share * exact.n.abs() + SINGLE * edge * edge;
        let n_d = inner(stored, exact.d) + 8.0 * share * inner(exact.n, exact.d) + lost;
        let moved = point(a);
        let offsets = ao.abs() + moved;
        let n_ao = inner(stored, offsets)
            + inner(exact.n, moved)
            + 8.0 * share * inner(exact.n, offsets)
            + lost * (1.0 / scale + largest(offsets));
        let t = (exact.n_ao / exact.n_d).abs();
        let relative = n_ao / exact.n_ao.abs() + n_d / (exact.n_d.abs() - n_d).max(1e-300) + 12.0 * share;
        let range = 2.2 * self.t;
        let [edge_u, edge_v, edge_w] = exact.edges;
        Errors {
            inside: [along(edge_u, a, ao), along(edge_v, a, ao), along(edge_w, b, bo)],
            n_d,
            n_ao,
            t: t * relative + range * (power_of_two(-22) + 4.0 * tiny),
            depth: t * relative / range,
        }
    }
}
