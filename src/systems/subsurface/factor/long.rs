//! Factors of near texels that are long against the mean free path: both are parallelograms or triangles.
//!
//! - Two of these are cut in half across their longest sides until pieces are far. Texels that share an edge take a
//!   number of pairs of pieces in proportion to the edge's length in mean free paths.
//! - A triangle T and itself need no pieces. T and T + h have a triangle similar to T in common, of area
//!   A (1 - g(h))^2, where g is the gauge of the difference body T - T, a hexagon. In polar coordinates of h the mean
//!   of R_d over T x T is then `1 / A` times the integral around the hexagon, at distances rho, of `integral of R_d(r)
//!   (1 - r / rho)^2 r dr = 1 / (pi rho) integral of G(r) (1 - r / rho) dr` from 0 to rho, by parts.
//! - Long slivers would take pieces in proportion to their length, though light varies little along them: the mean
//!   over a sliver is taken of contour integrals over the other texel, from points of pieces that are cut where these
//!   differ. So is that over texels so vast that hardly any light leaves them.

use std::f64::consts::{PI, SQRT_2};

use glam::DVec3;

use super::kernel::{DistanceTable, FLOOR, add};
use super::moments::{Covariance, Moments, size_squared};
use super::surface::SurfaceMoments;
use crate::elementary::{asinh, cosh};
use crate::quadrature::EIGHT;
use crate::subsurface::Dipole;

/// Texels whose outlines are both longer than this many mean free paths count as vast even if light leaves them: pairs
/// of pieces would take seconds per pair of texels.
const MAX_OUTLINE: f64 = 2e4;
/// Pieces are cut at most this often: rounded coordinates end it before.
const MAX_CUTS: u32 = 96;
/// The widest interval of u that gets eight points, where rho = p cosh(u) along a side at distance p.
const WIDEST: f64 = 1.5;
/// The ratio of the ends of an interval of r that gets eight points.
const RATIO: f64 = 3.0;
/// The width and the length of slivers, in mean free paths: narrower and longer than this.
const SLIVER: [f64; 2] = [1.5, 1000.0];
/// By how much light may differ within a piece, relative to its mean: anywhere, and at its middle.
const MAX_DIFFERENCES: [f64; 2] = [0.4, 0.02];
/// Pieces up to this size hide no light from their points, in diffusion lengths and mean free paths.
const HIDES_NOTHING: [f64; 2] = [4.0, 300.0];
/// Pieces smaller than this are not cut for light that differs, in mean free paths.
const LEAST_SIZE: f64 = 0.1;
/// Parts with less area over the square of their outline have no normal to rely on.
const LEAST_AREA: f64 = 1e-9;
/// Of vast texels with longer outlines, in mean free paths, all light stays in its texel: within 1e-5, but for sheets
/// that coordinates can hardly express. So it does in slivers without a normal.
const MAX_VAST: f64 = 4e6;

/// The surface under a texel.
struct Part {
    outlines: [Vec<DVec3>; 2],
    /// One parallelogram, or triangles.
    pieces: Vec<Piece>,
    area: f64,
    /// The length of the outlines.
    outline: f64,
}

/// A parallelogram with sides e and f, or the half of one on the corner's side of its diagonal.
#[derive(Clone, Copy, Debug)]
struct Piece {
    corner: DVec3,
    e: DVec3,
    f: DVec3,
    is_triangle: bool,
    moments: Moments,
    cuts: u32,
}

/// The mean of R_d over the pairs of points of two near texels, by Morton index, the smaller one first.
pub(super) fn long_mean<const N: usize>(
    surface: &SurfaceMoments,
    kernel: &DistanceTable<N>,
    [from, to]: [usize; 2],
) -> [f64; N] {
    let [p, q] = [from, to].map(|texel| {
        let (face, window) = surface.window(texel);
        Part::new(face.outlines(window))
    });
    let parts = [&p, &q];
    let is_vast = parts.iter().all(|part| kernel.keeps_light(part.outline, part.area))
        || parts.iter().all(|part| part.outline > MAX_OUTLINE * kernel.depth());
    let is_line = parts.iter().any(|part| part.is_long(kernel.depth()) && !part.has_normal());
    let slivers = parts.map(|part| part.is_sliver(kernel.depth()));
    if is_line || is_vast && p.outline.max(q.outline) > MAX_VAST * kernel.depth() {
        let stays = f64::from(u8::from(from == to)) / p.area;
        return kernel.dipoles().each_ref().map(|dipole| stays * dipole.total());
    }
    if is_vast || slivers != [false; 2] {
        // Light of the longer one varies less over the shorter one.
        let from_q = slivers[1] && (!slivers[0] || q.outline < p.outline);
        let ([over, other], cluster) = if from_q { ([&q, &p], from) } else { (parts, to) };
        return Light { kernel, part: other, cluster: &surface.level(0)[cluster], is_vast }.mean_over(over);
    }
    let [ones, others] = parts.map(|part| {
        if from == to { part.pieces.iter().flat_map(Piece::triangles).collect() } else { part.pieces.clone() }
    });
    let mut sum = [0.0; N];
    for (k, one) in ones.iter().enumerate() {
        for (l, other) in others.iter().enumerate() {
            let weight = (one.moments.area / p.area) * (other.moments.area / q.area);
            if from == to && k == l {
                add(&mut sum, &self_mean(kernel.dipoles(), one).map(|mean| weight * mean));
            } else {
                add_mean(kernel, [one, other], weight, [true; N], &mut sum);
            }
        }
    }
    sum
}

/// Adds a weight times the mean of R_d over the pairs of points of two pieces to the channels that are still open.
fn add_mean<const N: usize>(
    kernel: &DistanceTable<N>,
    [p, q]: [&Piece; 2],
    weight: f64,
    mut open: [bool; N],
    sum: &mut [f64; N],
) {
    for (channel, mean) in kernel.means(&p.moments, &q.moments, open).into_iter().enumerate() {
        if let Some(mean) = mean {
            sum[channel] += weight * mean;
            open[channel] = false;
        }
    }
    if !open.contains(&true) {
        return;
    }
    let halves_p = p.moments.size_squared >= q.moments.size_squared;
    let divided = if halves_p { p } else { q };
    if divided.cuts == MAX_CUTS {
        let between = kernel.at(p.moments.point.distance_squared(q.moments.point));
        (0..N).filter(|&channel| open[channel]).for_each(|channel| sum[channel] += weight * between[channel]);
        return;
    }
    for half in divided.halves() {
        let pair = if halves_p { [&half, q] } else { [p, &half] };
        add_mean(kernel, pair, 0.5 * weight, open, sum);
    }
}

/// The mean of R_d over the pairs of points of a triangle.
fn self_mean<const N: usize>(dipoles: &[Dipole; N], triangle: &Piece) -> [f64; N] {
    let [a, b, c] = triangle.corners();
    let edges = [b - a, c - b, a - c];
    let mut sum = [0.0; N];
    // Half of the hexagon's sides: one is an edge long and lies between the next edge and the one before, turned round.
    for k in 0..3 {
        let (side, end) = (edges[k], edges[(k + 1) % 3]);
        let length = side.length();
        let along = side / length;
        let p = 2.0 * triangle.moments.area / length;
        around(end.dot(along), (end + side).dot(along), p, |rho, weight| {
            add(&mut sum, &dipoles.each_ref().map(|dipole| weight * overlap(dipole, rho)));
        });
    }
    sum.map(|sum| 2.0 * sum / triangle.moments.area)
}

/// The integral of `R_d(r) (1 - r / rho)^2 r dr` from 0 to rho.
fn overlap(dipole: &Dipole, rho: f64) -> f64 {
    let (mut sum, mut end) = (0.0, rho);
    while end > 0.0 {
        let start = if end > dipole.z_r() { end / RATIO } else { 0.0 };
        for (x, weight) in EIGHT {
            let r = start + (end - start) * x;
            sum += (end - start) * weight * dipole.disc(r) * (1.0 - r / rho);
        }
        end = start;
    }
    sum / (PI * rho)
}

impl Part {
    fn new(outlines: [Vec<DVec3>; 2]) -> Self {
        let pieces_of = |outline: &Vec<DVec3>| -> Vec<Piece> {
            // A rectangle of the atlas on one side of its face's diagonal.
            if let ([a, b, _, d], true) = (outline.as_slice(), outlines.iter().any(|outline| outline.len() < 3)) {
                let (e, f) = (*b - *a, *d - *a);
                return vec![Piece::new([*a, e, f], false, e.cross(f).length(), 0)];
            }
            let pairs = outline.windows(2).skip(1);
            pairs.map(|side| Piece::triangle([outline[0], side[0], side[1]])).collect()
        };
        let mut pieces: Vec<Piece> = outlines.iter().flat_map(pieces_of).collect();
        pieces.retain(|piece| piece.moments.area > 0.0);
        let sides = |outline: &Vec<DVec3>| -> f64 {
            outline.iter().zip(outline.iter().cycle().skip(1)).map(|(a, b)| a.distance(*b)).sum()
        };
        let outline = outlines.iter().map(sides).sum();
        let area = pieces.iter().map(|piece| piece.moments.area).sum();
        Self { outlines, pieces, area, outline }
    }

    fn has_normal(&self) -> bool {
        self.area > LEAST_AREA * self.outline * self.outline
    }

    fn is_long(&self, depth: f64) -> bool {
        self.outline > 2.0 * SLIVER[1] * depth
    }

    fn is_sliver(&self, depth: f64) -> bool {
        self.is_long(depth) && 2.0 * self.area < SLIVER[0] * depth * self.outline
    }
}

/// Light of the part of a texel, whose moments are those of the cluster.
struct Light<'a, const N: usize> {
    kernel: &'a DistanceTable<N>,
    part: &'a Part,
    cluster: &'a Moments,
    is_vast: bool,
}

impl<const N: usize> Light<'_, N> {
    /// The mean of R_d over the pairs of points with another part: if that is vast, within about the tolerance times
    /// what the middle of this part returns to itself.
    fn mean_over(&self, other: &Part) -> [f64; N] {
        let of_middle = self.at(self.part.pieces.first().map_or(DVec3::ZERO, |piece| piece.moments.point));
        let least = (self.part.area / other.area).min(1.0) * FLOOR;
        let allowed = std::array::from_fn(|channel| {
            let floor = least * self.kernel.dipoles()[channel].total();
            self.kernel.tolerance() * if self.is_vast { of_middle[channel].max(floor) } else { floor }
        });
        let mut sum = [0.0; N];
        for triangle in other.pieces.iter().flat_map(Piece::triangles) {
            let weight = triangle.moments.area / other.area / self.part.area;
            add(&mut sum, &self.mean(&triangle, allowed).map(|mean| weight * mean));
        }
        sum
    }

    /// The mean over a triangle, by three points; its halves' where these or the middle differ by more than is allowed.
    /// Light that jumps along a line has its root of 2^cuts pieces there, whose errors have no common sign.
    fn mean(&self, piece: &Piece, allowed: [f64; N]) -> [f64; N] {
        let Piece { moments, cuts, .. } = piece;
        if let Some(mean) = self.kernel.mean(moments, self.cluster) {
            return mean.map(|mean| self.part.area * mean);
        }
        let [a, b, c] = piece.corners().map(|corner| self.at(0.5 * (moments.point + corner)));
        let middle = self.at(moments.point);
        let mean = std::array::from_fn(|channel| (a[channel] + b[channel] + c[channel]) / 3.0);
        let size = moments.size_squared.sqrt();
        let agrees = |channel: usize| {
            let dipole = &self.kernel.dipoles()[channel];
            let [lengths, paths] = HIDES_NOTHING;
            let hides_nothing = size * dipole.sigma_tr() <= lengths && size <= paths * dipole.z_r();
            let least = if self.is_vast || hides_nothing { allowed[channel] } else { 0.0 };
            let differs =
                |light: &[f64; N], most: f64| (light[channel] - mean[channel]).abs() >= least.max(most * mean[channel]);
            let [anywhere, at_middle] = MAX_DIFFERENCES;
            ![&a, &b, &c].into_iter().any(|light| differs(light, anywhere)) && !differs(&middle, at_middle)
        };
        if *cuts == MAX_CUTS || size <= LEAST_SIZE * self.kernel.depth() || (0..N).all(agrees) {
            return mean;
        }
        let growth = if self.is_vast { SQRT_2 } else { 1.0 };
        let mut sum = [0.0; N];
        for half in piece.halves() {
            add(&mut sum, &self.mean(&half, allowed.map(|allowed| growth * allowed)));
        }
        sum.map(|sum| 0.5 * sum)
    }

    /// The integral of R_d over the part from a point: with h the point's height above a polygon and rho the distance
    /// from its foot, `1 / (2 pi)` times that of `(G(sqrt(rho^2 + h^2)) - G(h)) dphi` around the polygon.
    fn at(&self, point: DVec3) -> [f64; N] {
        let mut sum = [0.0; N];
        for outline in self.part.outlines.iter().filter(|outline| outline.len() > 2) {
            let sides = || outline.iter().zip(outline.iter().cycle().skip(1)).map(|(&a, &b)| [a - point, b - point]);
            let normal = sides().map(|[a, b]| a.cross(b)).sum::<DVec3>().normalize_or_zero();
            let height = normal.dot(outline[0] - point);
            let squared = height * height;
            let within = self.kernel.disc(squared);
            for [a, b] in sides() {
                let along = (b - a).normalize_or_zero();
                let away = normal.dot(a.cross(along));
                around(a.dot(along), b.dot(along), away.abs(), |rho, weight| {
                    let disc = self.kernel.disc(squared + rho * rho);
                    let weight = away.signum() * weight;
                    (0..N).for_each(|channel| sum[channel] += weight * (disc[channel] - within[channel]));
                });
            }
        }
        sum.map(|sum| sum / (2.0 * PI))
    }
}

/// Visits points of a side whose line passes the origin at a distance, with rho and the weight of dphi there: between
/// two places along the line. With rho = p cosh(u), dphi = du / cosh(u): smooth at the scale 1 of u.
fn around(from: f64, to: f64, p: f64, mut visit: impl FnMut(f64, f64)) {
    let [from, to] = [from, to].map(|place| asinh(place / p));
    if !(p > 0.0 && from.is_finite() && to.is_finite()) {
        return;
    }
    let panels = ((to - from) / WIDEST).ceil().max(1.0);
    let step = (to - from) / panels;
    for panel in 0..panels as u32 {
        for (x, weight) in EIGHT {
            let stretch = cosh(from + step * (f64::from(panel) + x));
            visit(p * stretch, step * weight / stretch);
        }
    }
}

impl Piece {
    fn new([corner, e, f]: [DVec3; 3], is_triangle: bool, area: f64, cuts: u32) -> Self {
        let (point, covariance, farthest);
        if is_triangle {
            point = corner + (e + f) / 3.0;
            let offsets = [(e + f) / -3.0, (2.0 * e - f) / 3.0, (2.0 * f - e) / 3.0];
            covariance = Covariance::of(offsets.map(|offset| (1.0 / 12.0, offset)));
            farthest = offsets.map(|offset| offset.length_squared()).into_iter().fold(0.0, f64::max);
        } else {
            point = corner + 0.5 * (e + f);
            covariance = Covariance::of([(1.0 / 12.0, e), (1.0 / 12.0, f)]);
            farthest = 0.25 * (e + f).length_squared().max((e - f).length_squared());
        }
        let size_squared = size_squared(&covariance, farthest);
        let moments = Moments { area, point, covariance, size_squared };
        Self { corner, e, f, is_triangle, moments, cuts }
    }

    fn triangle([a, b, c]: [DVec3; 3]) -> Self {
        let (e, f) = (b - a, c - a);
        Self::new([a, e, f], true, 0.5 * e.cross(f).length(), 0)
    }

    /// Both triangles of a parallelogram.
    fn triangles(&self) -> Vec<Self> {
        if self.is_triangle {
            return vec![*self];
        }
        let [b, c] = [self.corner + self.e, self.corner + self.f];
        vec![Self::triangle([self.corner, b, c]), Self::triangle([b + self.f, c, b])]
    }

    fn corners(&self) -> [DVec3; 3] {
        [self.corner, self.corner + self.e, self.corner + self.f]
    }

    /// The halves on both sides of the middle of the longest side.
    fn halves(&self) -> [Self; 2] {
        let Self { corner, e, f, is_triangle, .. } = *self;
        let (area, cuts) = (0.5 * self.moments.area, self.cuts + 1);
        let across = f - e;
        let [ee, ff, gg] = [e.length_squared(), f.length_squared(), across.length_squared()];
        let halves = if is_triangle && gg > ee.max(ff) {
            [[corner, e, 0.5 * (e + f)], [corner, 0.5 * (e + f), f]]
        } else {
            let (e, f) = if ee >= ff { (e, f) } else { (f, e) };
            let middle = corner + 0.5 * e;
            if is_triangle {
                [[corner, 0.5 * e, f], [middle, 0.5 * e, f - 0.5 * e]]
            } else {
                [[corner, 0.5 * e, f], [middle, 0.5 * e, f]]
            }
        };
        halves.map(|shape| Self::new(shape, is_triangle, area, cuts))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subsurface::{Coefficients, point_to_polygon};
    use approx::assert_relative_eq;

    fn dipole() -> Dipole {
        Dipole::new(Coefficients { sigma_s_prime: 2.21, sigma_a: 0.0012 }, 1.3).expect("a medium")
    }

    fn kernel(tolerance: f64) -> DistanceTable<1> {
        DistanceTable::new([dipole()], 300.0, 1e4, tolerance)
    }

    /// A parallelogram at a place.
    fn part(at: DVec3, e: DVec3, f: DVec3) -> Part {
        Part::new([vec![at, at + e, at + e + f, at + f], Vec::new()])
    }

    fn by_pieces(p: &Part, q: &Part) -> f64 {
        let mut sum = [0.0];
        add_mean(&kernel(0.001), [&p.pieces[0], &q.pieces[0]], 1.0, [true], &mut sum);
        sum[0]
    }

    #[test]
    fn halves_are_the_whole() {
        let (e, f) = (DVec3::new(3.0, 1.0, 0.0), DVec3::new(1.0, 4.0, 2.0));
        for is_triangle in [false, true] {
            for [e, f] in [[e, f], [f, e], [e, -f], [3.0 * e, 3.0 * e + f]] {
                let area = e.cross(f).length() * if is_triangle { 0.5 } else { 1.0 };
                let whole = Piece::new([DVec3::X, e, f], is_triangle, area, 0);
                let [a, b] = whole.halves();
                for half in [a, b] {
                    let own = half.e.cross(half.f).length() * if is_triangle { 0.5 } else { 1.0 };
                    assert_relative_eq!(own, half.moments.area, max_relative = 1e-14);
                }
                let nothing = Moments { area: 0.0, ..a.moments };
                let together = Moments::together(&[a.moments, b.moments, nothing, nothing]);
                assert!((together.point - whole.moments.point).length() < 1e-14);
                for (found, expected) in together.covariance.0.iter().zip(whole.moments.covariance.0) {
                    assert!((found - expected).abs() < 1e-13, "{together:?} {whole:?}");
                }
            }
        }
    }

    #[test]
    fn a_triangle_and_itself_take_no_pieces() {
        for [e, f] in [[DVec3::X, DVec3::Y], [DVec3::new(1.0, 0.1, 0.0), DVec3::new(2.0, 0.0, 0.3)]] {
            for size in [0.01, 1.0, 4.0] {
                let triangle = Piece::triangle([DVec3::ONE, DVec3::ONE + size * e, DVec3::ONE + size * f]);
                let mut sum = [0.0];
                add_mean(&kernel(0.01), [&triangle, &triangle], 1.0, [true], &mut sum);
                let [found] = self_mean(&[dipole()], &triangle);
                assert_relative_eq!(found, sum[0], max_relative = 0.005);
            }
        }
        // All light stays but for the outline times the mean exit distance over pi times the area.
        let size = 1e4;
        let triangle = Piece::triangle([DVec3::ZERO, size * DVec3::X, size * DVec3::Y]);
        let exit = crate::quadrature::graded_integral(size, 60, |r| dipole().beyond(r));
        let left = (2.0 + SQRT_2) * size * exit / PI / triangle.moments.area;
        let [found] = self_mean(&[dipole()], &triangle);
        assert_relative_eq!(found * triangle.moments.area, dipole().total() - left, max_relative = 1e-4);
    }

    #[test]
    fn light_of_a_part_is_the_contour_integral() {
        let part = part(DVec3::Z, DVec3::new(30.0, 0.0, 1.0), DVec3::new(3.0, 0.5, 0.0));
        let kernel = kernel(0.01);
        let light = Light { kernel: &kernel, part: &part, cluster: &part.pieces[0].moments, is_vast: false };
        for point in [DVec3::ZERO, DVec3::new(10.0, 0.2, 1.3), DVec3::new(-5.0, 3.0, 1.0), DVec3::new(60.0, 1.0, 2.0)] {
            let exact = point_to_polygon(&dipole(), point, &part.outlines[0]);
            assert!((light.at(point)[0] - exact).abs() < 1e-6 * dipole().total(), "{point}");
        }
    }

    /// Contour integrals and smaller pieces are two ways to one mean.
    #[test]
    fn slivers_have_the_means_of_their_pieces() {
        let (e, f) = (DVec3::new(100.0, 0.0, 0.0), DVec3::new(0.1, 0.5, 0.0));
        let p = part(DVec3::ZERO, e, f);
        let others = [
            part(f, e, f),
            part(DVec3::new(40.0, 0.5, 0.0), 0.9 * e, DVec3::new(0.0, 0.1, 0.4)),
            part(e, e, f),
            part(DVec3::new(30.0, 0.7, 0.2), DVec3::new(2.0, 80.0, 0.0), DVec3::new(0.4, 0.0, 0.1)),
            part(DVec3::new(50.0, -20.0, -1.0), DVec3::new(5.0, 0.0, 0.0), DVec3::new(0.0, 40.0, 0.0)),
        ];
        let kernel = kernel(0.01);
        for q in &others {
            let light = Light { kernel: &kernel, part: q, cluster: &q.pieces[0].moments, is_vast: false };
            let [found] = light.mean_over(&p);
            assert_relative_eq!(found, by_pieces(&p, q), max_relative = 0.01);
        }
    }
}
