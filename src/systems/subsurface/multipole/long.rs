//! Factors of near texels that are long relative to the mean free path.
//!
//! The light that a flat polygon sends to a point is an integral along its outline. Its mean over the smaller of two
//! texels is a double integral: along lines across that texel, and over these lines. Both integrals use Simpson's rule;
//! intervals with the largest change are halved until the tolerance is reached. Intervals begin and end where the
//! outline is nearest, and where its light has become negligible: between these points the integrand is smooth at the
//! scale of an interval, or the rule detects that it is not.

use std::f64::consts::PI;

use glam::DVec3;

use super::kernel::{DistanceTable, FLOOR, add};
use super::surface::SurfaceMoments;
use crate::quadrature::EIGHT;

/// Parts of the tolerance for the integral over lines, and for integrals along lines.
const TOLERANCES: [f64; 2] = [0.5, 0.25];
const MAX_INTERVALS: usize = 128;
/// Minimum area divided by squared perimeter of a texel with a reliable normal.
const LEAST_AREA: f64 = 1e-9;

/// The surface under a texel.
struct Part {
    outlines: Vec<Outline>,
    patches: Vec<TexelPatch>,
    area: f64,
}

struct Outline {
    normal: DVec3,
    sides: Vec<OutlineSide>,
}

struct OutlineSide {
    start: DVec3,
    /// The unit vector to its end.
    along: DVec3,
    length: f64,
}

/// A parallelogram with sides e and f, or the triangle with side e followed by side f.
struct TexelPatch {
    corner: DVec3,
    e: DVec3,
    f: DVec3,
    is_triangle: bool,
    area: f64,
}

/// The mean of R_d over the pairs of points of two near texels, given by Morton index, smaller index first.
pub(super) fn long_mean<const N: usize>(
    surface: &SurfaceMoments,
    kernel: &DistanceTable<N>,
    [from, to]: [usize; 2],
) -> [f64; N] {
    let [(one, p), (other, q)] = [from, to].map(|texel| {
        let (face, window) = surface.window(texel);
        (face, Part::new(face.outlines(window)))
    });
    let [smaller, larger] = if q.light() < p.light() { [&q, &p] } else { [&p, &q] };
    Light { kernel, part: larger, is_in_plane: std::ptr::eq(one, other) }.mean_over(smaller)
}

impl Part {
    fn new(outlines: [Vec<DVec3>; 2]) -> Self {
        let is_whole = outlines.iter().any(|outline| outline.len() < 3);
        let patches_of = |outline: &Vec<DVec3>| -> Vec<TexelPatch> {
            // A whole rectangle of the atlas, on one side of its face's diagonal.
            if let ([a, b, c, _], true) = (outline.as_slice(), is_whole) {
                return vec![TexelPatch::new([*a, *b, *c], false)];
            }
            let pairs = outline.windows(2).skip(1);
            pairs.map(|side| TexelPatch::new([outline[0], side[0], side[1]], true)).collect()
        };
        let mut patches: Vec<TexelPatch> = outlines.iter().flat_map(patches_of).collect();
        patches.retain(|patch| patch.area > 0.0);
        let area = patches.iter().map(|patch| patch.area).sum();
        Self { outlines: outlines.iter().filter_map(|corners| Outline::new(corners)).collect(), patches, area }
    }

    /// The area whose light can be computed: 0 for a sliver without a normal.
    fn light(&self) -> f64 {
        if self.outlines.is_empty() { 0.0 } else { self.area }
    }
}

impl TexelPatch {
    fn new([a, b, c]: [DVec3; 3], is_triangle: bool) -> Self {
        let (e, f) = (b - a, c - b);
        let area = e.cross(f).length() * if is_triangle { 0.5 } else { 1.0 };
        Self { corner: a, e, f, is_triangle, area }
    }
}

impl Outline {
    /// `None` if rounding may have changed the normal's direction.
    fn new(corners: &[DVec3]) -> Option<Self> {
        let next = corners.iter().cycle().skip(1);
        let sides: Vec<OutlineSide> = corners.iter().zip(next).map(|(&a, &b)| OutlineSide::new(a, b)).collect();
        let &first = corners.first()?;
        let normal: DVec3 = corners.windows(2).map(|pair| (pair[0] - first).cross(pair[1] - first)).sum();
        let length: f64 = sides.iter().map(|side| side.length).sum();
        let has_normal = normal.length() > 2.0 * LEAST_AREA * length * length;
        has_normal.then(|| Self { normal: normal.normalize(), sides })
    }

    /// The integral of R_d over the polygon from a point: `1 / (2 pi)` times the integral of `(G(sqrt(rho^2 + h^2)) -
    /// G(h)) dphi` around the polygon, with h the point's height above the polygon and rho the distance from its foot.
    /// For points in the polygon's plane, `is_in_plane` sets h to 0, because a height from rounding would exceed the
    /// reach of light in dense media.
    fn light_at<const N: usize>(&self, kernel: &DistanceTable<N>, point: DVec3, is_in_plane: bool) -> [f64; N] {
        let height = if is_in_plane { 0.0 } else { self.normal.dot(self.sides[0].start - point) };
        let squared = height * height;
        let within = kernel.disc(squared);
        let mut sum = [0.0; N];
        for &OutlineSide { start, along, length } in &self.sides {
            let offset = start - point;
            let (from, away) = (offset.dot(along), self.normal.dot(offset.cross(along)));
            let p = away * away;
            let depth = kernel.depth();
            // At this scale D is a smooth function of t^2, and `D / rho^2` has no pole at rho = 0.
            let scale = (p + squared + depth * depth).sqrt();
            graded(from, from + length, scale, |t, weight| {
                let rho = p + t * t;
                let disc = kernel.disc(squared + rho);
                let weight = weight * away / rho;
                (0..N).for_each(|channel| sum[channel] += weight * (disc[channel] - within[channel]));
            });
        }
        sum.map(|sum| sum / (2.0 * PI))
    }
}

impl OutlineSide {
    fn new(a: DVec3, b: DVec3) -> Self {
        Self { start: a, along: (b - a).normalize_or_zero(), length: a.distance(b) }
    }

    /// Parameter at which a line from a point along `vector` is nearest to the side; NaN if they are parallel.
    fn nearest(&self, from: DVec3, vector: DVec3) -> f64 {
        let (offset, squared) = (self.start - from, vector.length_squared());
        let [along, across] = [self.along.dot(vector), offset.dot(vector)];
        let place = (along * across - squared * offset.dot(self.along)) / (squared - along * along);
        (across + place.clamp(0.0, self.length) * along) / squared
    }
}

/// Visits quadrature points of an interval, for an even function that is smooth at `scale` around 0.
fn graded(from: f64, to: f64, scale: f64, mut visit: impl FnMut(f64, f64)) {
    let mut from_to = |mut from: f64, to: f64| {
        while from < to {
            let end = to.min((2.0 * scale).max(4.0 * from));
            EIGHT.iter().for_each(|(x, weight)| visit(from + (end - from) * x, (end - from) * weight));
            from = end;
        }
    };
    if from < 0.0 && to > 0.0 {
        from_to(0.0, -from);
        from_to(0.0, to);
    } else {
        from_to(from.abs().min(to.abs()), from.abs().max(to.abs()));
    }
}

/// Light of a texel's part.
struct Light<'a, const N: usize> {
    kernel: &'a DistanceTable<N>,
    part: &'a Part,
    /// True if the light falls on points of its own face.
    is_in_plane: bool,
}

impl<const N: usize> Light<'_, N> {
    /// The mean of R_d over the pairs of points with another part. Slivers without a normal send nothing to each other.
    fn mean_over(&self, other: &Part) -> [f64; N] {
        let mut sum = [0.0; N];
        for patch in &other.patches {
            let weight = patch.area / other.area / self.part.area;
            add(&mut sum, &self.mean(patch).map(|mean| weight * mean));
        }
        sum
    }

    fn mean(&self, patch: &TexelPatch) -> [f64; N] {
        let &TexelPatch { corner, e, f, is_triangle, .. } = patch;
        let normal = e.cross(f);
        let allowed = TOLERANCES.map(|part| part * self.kernel.tolerance);
        // For such a short side, the light at its middle equals the mean within a quarter of the tolerance.
        let is_short = |length: f64| length < self.kernel.depth() * (2.0 * self.kernel.tolerance).sqrt();
        let sides = || self.part.outlines.iter().flat_map(|outline| &outline.sides);
        let along = |s: f64| {
            let [width, weight] = if is_triangle { [s, 2.0 * s] } else { [1.0, 1.0] };
            if width == 0.0 {
                return [0.0; N];
            }
            let (start, f) = (corner + s * e, width * f);
            if is_short(f.length()) {
                return self.at(start + 0.5 * f).map(|mean| weight * mean);
            }
            let ends = self.ends(sides().map(|side| side.nearest(start, f)), f.length());
            self.integral(&ends, allowed[1], |t| self.at(start + t * f)).map(|mean| weight * mean)
        };
        let places = sides().map(|side| (side.start - corner).cross(f).dot(normal) / normal.length_squared());
        let length = normal.length() / f.length();
        if !is_triangle && is_short(length) {
            return along(0.5);
        }
        self.integral(&self.ends(places, length), allowed[0], along)
    }

    fn at(&self, point: DVec3) -> [f64; N] {
        let mut sum = [0.0; N];
        let light = |outline: &Outline| outline.light_at(self.kernel, point, self.is_in_plane);
        self.part.outlines.iter().for_each(|outline| add(&mut sum, &light(outline)));
        sum
    }

    /// Ends of intervals from 0 to 1, for a `length` in mm: the `places`, and the distances from them at which light
    /// has become negligible; no two ends are nearer than a mean free path.
    fn ends(&self, places: impl Iterator<Item = f64>, length: f64) -> Vec<f64> {
        let [layer, path] = [self.kernel.layer, self.kernel.depth()].map(|distance| distance / length);
        let places = [0.0, 1.0].into_iter().chain(places).flat_map(|at| [at - layer, at, at + layer]);
        let mut inside: Vec<f64> = places.filter(|&at| at > path && at < 1.0 - path).collect();
        inside.sort_by(f64::total_cmp);
        inside.dedup_by(|next, at| *next - *at < path);
        [0.0].into_iter().chain(inside).chain([1.0]).collect()
    }

    /// An integral within a tolerance relative to itself and to the least light that matters.
    fn integral(&self, ends: &[f64], tolerance: f64, mut value: impl FnMut(f64) -> [f64; N]) -> [f64; N] {
        let values: Vec<[f64; N]> = ends.iter().map(|&end| value(end)).collect();
        let intervals = ends.windows(2).zip(values.windows(2));
        let mut intervals: Vec<Interval<N>> = intervals
            .map(|(ends, values)| {
                let middle = value(0.5 * (ends[0] + ends[1]));
                Interval::new([ends[0], ends[1]], [values[0], middle, values[1]], &mut value)
            })
            .collect();
        loop {
            let [mut sum, mut errors] = [[0.0; N]; 2];
            for interval in &intervals {
                add(&mut sum, &interval.integral);
                add(&mut errors, &interval.error);
            }
            let allowed: [f64; N] = std::array::from_fn(|channel| {
                tolerance * sum[channel].abs().max(FLOOR * self.kernel.dipoles[channel].total())
            });
            let excess = |error: &[f64; N]| (0..N).map(|channel| error[channel] / allowed[channel]).fold(0.0, f64::max);
            if excess(&errors) <= 1.0 || intervals.len() >= MAX_INTERVALS {
                return sum;
            }
            let by_error = |&k: &usize, &l: &usize| excess(&intervals[k].error).total_cmp(&excess(&intervals[l].error));
            let Some(worst) = (0..intervals.len()).max_by(by_error) else { return sum };
            let Interval { ends: [from, to], values: [a, b, c, d, e], .. } = intervals[worst];
            let middle = 0.5 * (from + to);
            intervals[worst] = Interval::new([from, middle], [a, b, c], &mut value);
            intervals.push(Interval::new([middle, to], [c, d, e], &mut value));
        }
    }
}

/// Simpson's rule on an interval and on its halves.
struct Interval<const N: usize> {
    ends: [f64; 2],
    /// Values at the ends, the middle and the quarter points.
    values: [[f64; N]; 5],
    /// The integral by Simpson's rule on both halves.
    integral: [f64; N],
    /// The error estimate: the change from the whole interval to halves.
    error: [f64; N],
}

impl<const N: usize> Interval<N> {
    fn new([from, to]: [f64; 2], [a, c, e]: [[f64; N]; 3], mut value: impl FnMut(f64) -> [f64; N]) -> Self {
        let [b, d] = [0.25, 0.75].map(|part| value(from + part * (to - from)));
        let sixth = (to - from) / 6.0;
        let change: [f64; N] = std::array::from_fn(|k| {
            let (whole, halves) =
                (a[k] + 4.0 * c[k] + e[k], 0.5 * (a[k] + 4.0 * b[k] + 2.0 * c[k] + 4.0 * d[k] + e[k]));
            sixth * (halves - whole)
        });
        let integral = std::array::from_fn(|k| sixth * (a[k] + 4.0 * c[k] + e[k]) + 16.0 / 15.0 * change[k]);
        Self { ends: [from, to], values: [a, b, c, d, e], integral, error: change.map(f64::abs) }
    }
}
