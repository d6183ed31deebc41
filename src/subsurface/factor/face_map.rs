//! The map of a face's rectangle of texels onto the face, and the moments of what lies under a piece of it.

use glam::DVec3;

use super::moments::{Covariance, Moments};
use crate::atlas::FacePlace;

/// A face and its rectangle. In the rectangle's coordinates, which run from 0 to 1, corners (0, 0), (1, 0), (1, 1),
/// (0, 1) lie on a, b, m, c, where m is the middle of the edge b c.
///
/// With e = b - a and f = m - b the map is a + e s + f t where s >= t and a + e t + f (2 t - s) beyond: in both halves
/// a + e M + f N with M = max(s, t), N = max(t, 2 t - s).
#[derive(Clone, Copy, Debug)]
pub(super) struct FaceMap {
    origin: DVec3,
    e: DVec3,
    f: DVec3,
    place: FacePlace,
}

/// A rectangle in the coordinates of a face's rectangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    s: [f64; 2],
    t: [f64; 2],
}

impl Window {
    /// Whether the diagonal, where the map bends, passes through the inside.
    pub(super) fn is_bent(&self) -> bool {
        self.s[0] < self.t[1] && self.t[0] < self.s[1]
    }

    /// The four quarters.
    pub(super) fn quarters(&self) -> [Self; 4] {
        let [s0, s1] = self.s;
        let [t0, t1] = self.t;
        let (s, t) = (0.5 * (s0 + s1), 0.5 * (t0 + t1));
        [([s0, s], [t0, t]), ([s, s1], [t0, t]), ([s0, s], [t, t1]), ([s, s1], [t, t1])].map(|(s, t)| Self { s, t })
    }
}

/// Mean values of M, N and their products over a window.
#[derive(Clone, Copy, Debug, Default)]
struct Means {
    m: f64,
    n: f64,
    mm: f64,
    mn: f64,
    nn: f64,
}

impl FaceMap {
    /// The map of a face with corners a, b and c, in mm.
    pub(super) fn new([a, b, c]: [DVec3; 3], place: FacePlace) -> Self {
        Self { origin: a, e: b - a, f: 0.5 * (c - b), place }
    }

    /// The window of the texel in column `x` and row `y` of the atlas.
    pub(super) fn window(&self, x: u32, y: u32) -> Window {
        let place = &self.place;
        let span =
            |at: u32, from: u32, count: u32| [at - from, at - from + 1].map(|edge| f64::from(edge) / f64::from(count));
        let across = span(x, place.x, place.width);
        let down = span(y, place.y, place.height);
        let [s, t] = if place.transposed { [down, across] } else { [across, down] };
        Window { s, t }
    }

    /// From a point of one window to that of another window of its size on the same side of the diagonal.
    pub(super) fn step(&self, from: &Window, to: &Window) -> DVec3 {
        let [s, t] = [to.s[0] - from.s[0], to.t[0] - from.t[0]];
        let is_below = from.s[0] >= from.t[1];
        if is_below { s * self.e + t * self.f } else { t * self.e + (2.0 * t - s) * self.f }
    }

    /// The moments of the surface under a window, of a given area.
    pub(super) fn moments(&self, window: Window, area: f64) -> Moments {
        let means = if window.is_bent() { bent_means(window) } else { straight_means(window) };
        let [var_m, cov, var_n] =
            [means.mm - means.m * means.m, means.mn - means.m * means.n, means.nn - means.n * means.n];
        // e f^T + f e^T = (e + f)(e + f)^T - e e^T - f f^T.
        let covariance = Covariance::of([(var_m - cov, self.e), (var_n - cov, self.f), (cov, self.e + self.f)]);
        let offset = means.m * self.e + means.n * self.f;
        let mut radius_squared: f64 = 0.0;
        for [s, t] in corners(window) {
            let vertex = s.max(t) * self.e + t.max(2.0 * t - s) * self.f;
            radius_squared = radius_squared.max((vertex - offset).length_squared());
        }
        Moments { area, point: self.origin + offset, covariance, radius_squared }
    }
}

/// The corners of a window, and where the diagonal enters and leaves it.
fn corners(Window { s: [s0, s1], t: [t0, t1] }: Window) -> [[f64; 2]; 6] {
    let (enter, leave) = (s0.max(t0), s1.min(t1));
    let bend = |at: f64| if enter < leave { [at, at] } else { [s0, t0] };
    [[s0, t0], [s1, t0], [s1, t1], [s0, t1], bend(enter), bend(leave)]
}

/// Over a window on one side of the diagonal.
fn straight_means(Window { s: [s0, s1], t: [t0, t1] }: Window) -> Means {
    let (s, t) = (0.5 * (s0 + s1), 0.5 * (t0 + t1));
    let [var_s, var_t] = [s1 - s0, t1 - t0].map(|width| width * width / 12.0);
    if s >= t {
        return Means { m: s, n: t, mm: s * s + var_s, mn: s * t, nn: t * t + var_t };
    }
    let n = 2.0 * t - s;
    Means { m: t, n, mm: t * t + var_t, mn: t * n + 2.0 * var_t, nn: n * n + 4.0 * var_t + var_s }
}

/// Over a window that the diagonal cuts: the rule of edge midpoints is exact on the triangles of each half, where the
/// products are quadratic.
fn bent_means(window: Window) -> Means {
    let mut sum = Means::default();
    let mut area = 0.0;
    for below in [true, false] {
        let (polygon, count) = half(window, below);
        for k in 2..count {
            let triangle = [polygon[0], polygon[k - 1], polygon[k]];
            let [[ax, ay], [bx, by], [cx, cy]] = triangle;
            let weight = ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)).abs() / 6.0;
            for edge in 0..3 {
                let [p, q] = [triangle[edge], triangle[(edge + 1) % 3]];
                let [s, t] = [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
                let (m, n) = if below { (s, t) } else { (t, 2.0 * t - s) };
                sum.m += weight * m;
                sum.n += weight * n;
                sum.mm += weight * m * m;
                sum.mn += weight * m * n;
                sum.nn += weight * n * n;
                area += weight;
            }
        }
    }
    let Means { m, n, mm, mn, nn } = sum;
    Means { m: m / area, n: n / area, mm: mm / area, mn: mn / area, nn: nn / area }
}

/// The part of a window where s >= t, or where t >= s: a polygon of up to five corners.
fn half(Window { s: [s0, s1], t: [t0, t1] }: Window, below: bool) -> ([[f64; 2]; 6], usize) {
    let square = [[s0, t0], [s1, t0], [s1, t1], [s0, t1]];
    let height = |[s, t]: [f64; 2]| if below { s - t } else { t - s };
    let mut polygon = [[0.0; 2]; 6];
    let mut count = 0;
    let mut push = |corner| {
        polygon[count] = corner;
        count += 1;
    };
    for k in 0..4 {
        let [p, q] = [square[k], square[(k + 1) % 4]];
        let [hp, hq] = [height(p), height(q)];
        if hp >= 0.0 {
            push(p);
        }
        if (hp > 0.0 && hq < 0.0) || (hp < 0.0 && hq > 0.0) {
            // On an axis-parallel edge, the point with s = t.
            let at = if p[0] == q[0] { p[0] } else { p[1] };
            push([at, at]);
        }
    }
    (polygon, count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn place(width: u32, height: u32) -> FacePlace {
        FacePlace { x: 4, y: 8, width, height, first: 1, transposed: false }
    }

    fn map(width: u32, height: u32, transposed: bool) -> FaceMap {
        let corners = [DVec3::new(1.0, 2.0, 0.5), DVec3::new(4.0, 1.0, 0.0), DVec3::new(2.0, 5.0, 3.0)];
        FaceMap::new(corners, FacePlace { transposed, ..place(width, height) })
    }

    /// Means over a fine grid of points of the window.
    fn sampled(map: &FaceMap, window: Window) -> (DVec3, f64, f64) {
        let count = 400;
        let mut points = Vec::new();
        for j in 0..count {
            for i in 0..count {
                let [u, v] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(count));
                let s = window.s[0] + u * (window.s[1] - window.s[0]);
                let t = window.t[0] + v * (window.t[1] - window.t[0]);
                points.push(map.origin + s.max(t) * map.e + t.max(2.0 * t - s) * map.f);
            }
        }
        let mean = points.iter().sum::<DVec3>() / points.len() as f64;
        let along = |v: DVec3| points.iter().map(|p| (*p - mean).dot(v)).map(|d| d * d).sum::<f64>();
        let n = points.len() as f64;
        (mean, along(DVec3::new(1.0, 2.0, -1.0)) / n, along(DVec3::X) / n)
    }

    #[test]
    fn moments_are_those_of_the_points_under_a_texel() {
        for (width, height, transposed) in [(1, 1, false), (3, 2, false), (2, 4, true), (4, 4, false), (5, 3, true)] {
            let map = map(width, height, transposed);
            for y in 0..height {
                for x in 0..width {
                    let window = map.window(4 + x, 8 + y);
                    let moments = map.moments(window, 1.0);
                    let (mean, along, x_variance) = sampled(&map, window);
                    assert!((moments.point - mean).length() < 1e-4, "{moments:?} {mean}");
                    let found = moments.covariance.along(DVec3::new(1.0, 2.0, -1.0));
                    assert_relative_eq!(found, along, max_relative = 1e-3);
                    assert_relative_eq!(moments.covariance.along(DVec3::X), x_variance, max_relative = 1e-3);
                }
            }
        }
    }

    #[test]
    fn a_face_of_one_texel_has_the_moments_of_a_triangle() {
        let map = map(1, 1, false);
        let moments = map.moments(map.window(4, 8), 1.0);
        let corners = [DVec3::new(1.0, 2.0, 0.5), DVec3::new(4.0, 1.0, 0.0), DVec3::new(2.0, 5.0, 3.0)];
        let centroid = corners.iter().sum::<DVec3>() / 3.0;
        assert!((moments.point - centroid).length() < 1e-14);
        let expected = Covariance::of(corners.map(|corner| (1.0 / 12.0, corner - centroid)));
        assert_relative_eq!(moments.covariance.trace(), expected.trace(), max_relative = 1e-13);
        assert_relative_eq!(
            moments.covariance.along(DVec3::new(1.0, -2.0, 0.7)),
            expected.along(DVec3::new(1.0, -2.0, 0.7)),
            max_relative = 1e-13
        );
        let farthest = corners.iter().map(|corner| (*corner - centroid).length_squared()).fold(0.0, f64::max);
        assert_relative_eq!(moments.radius_squared, farthest, max_relative = 1e-13);
    }

    #[test]
    fn quarters_together_are_the_window() {
        for (width, height) in [(1, 1), (2, 2), (3, 5)] {
            let map = map(width, height, true);
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (4 + x, 8 + y))) {
                let window = map.window(x, y);
                let whole = map.moments(window, 1.0);
                let together = Moments::together(&window.quarters().map(|quarter| map.moments(quarter, 0.25)));
                assert!((whole.point - together.point).length() < 1e-14);
                for (a, b) in whole.covariance.0.iter().zip(together.covariance.0) {
                    assert!((a - b).abs() < 1e-14, "{whole:?} {together:?}");
                }
            }
        }
    }
}
