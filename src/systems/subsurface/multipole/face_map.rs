//! The map of a face's rectangle of texels onto the face, and the moments of the surface under a window of it.

use glam::DVec3;

use super::moments::{Covariance, Moments, size_squared};
use crate::atlas::FacePlace;
use crate::geom::polygon::clipped;

/// A face and its rectangle. In the rectangle's coordinates, from 0 to 1, the corners (0, 0), (1, 0), (1, 1), (0, 1)
/// map to a, b, m, c, where m is the middle of the edge b c.
///
/// With e = b - a and f = m - b, the map is a + e s + f t if s >= t, else a + e t + f (2 t - s). In both halves this is
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
    /// Returns `true` if the diagonal, at which the map bends, crosses the window's interior.
    pub(super) fn is_bent(&self) -> bool {
        self.s[0] < self.t[1] && self.t[0] < self.s[1]
    }

    pub(super) fn quarters(&self) -> [Self; 4] {
        let [s0, s1] = self.s;
        let [t0, t1] = self.t;
        let (s, t) = (0.5 * (s0 + s1), 0.5 * (t0 + t1));
        [([s0, s], [t0, t]), ([s, s1], [t0, t]), ([s0, s], [t, t1]), ([s, s1], [t, t1])].map(|(s, t)| Self { s, t })
    }
}

/// Means and covariances of M and N over a window.
#[derive(Clone, Copy, Debug, Default)]
struct WindowMoments {
    m: f64,
    n: f64,
    mm: f64,
    mn: f64,
    nn: f64,
}

impl FaceMap {
    /// Creates the map of a face with corners a, b and c, in mm.
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

    /// The convex polygons under a window on both sides of the diagonal; one is empty if the window is not bent.
    pub(super) fn outlines(&self, Window { s: [s0, s1], t: [t0, t1] }: Window) -> [Vec<DVec3>; 2] {
        let corners = [(s0, t0), (s1, t0), (s1, t1), (s0, t1)].map(|(s, t)| DVec3::new(s, t, 0.0));
        let on_face = |at: DVec3| self.origin + at.x.max(at.y) * self.e + at.y.max(2.0 * at.y - at.x) * self.f;
        [1.0, -1.0].map(|side| clipped(&corners, |at| side * (at.x - at.y)).into_iter().map(on_face).collect())
    }

    /// The offset between corresponding points of two equally large windows on the same side of the diagonal.
    pub(super) fn step(&self, from: &Window, to: &Window) -> DVec3 {
        let [s, t] = [to.s[0] - from.s[0], to.t[0] - from.t[0]];
        let is_below = from.s[0] >= from.t[1];
        if is_below { s * self.e + t * self.f } else { t * self.e + (2.0 * t - s) * self.f }
    }

    /// The moments of the surface under a window, of a given area.
    pub(super) fn moments(&self, window: Window, area: f64) -> Moments {
        let means = WindowMoments::of(window);
        // e f^T + f e^T = (e + f)(e + f)^T - e e^T - f f^T.
        let WindowMoments { mm, mn, nn, .. } = means;
        let covariance = Covariance::of([(mm - mn, self.e), (nn - mn, self.f), (mn, self.e + self.f)]);
        let offset = means.m * self.e + means.n * self.f;
        let mut radius_squared: f64 = 0.0;
        for [s, t] in corners(window) {
            let vertex = s.max(t) * self.e + t.max(2.0 * t - s) * self.f;
            radius_squared = radius_squared.max((vertex - offset).length_squared());
        }
        let size_squared = size_squared(&covariance, radius_squared);
        Moments { area, point: self.origin + offset, covariance, size_squared }
    }
}

/// The corners of a window, and the points at which the diagonal enters and leaves it.
fn corners(Window { s: [s0, s1], t: [t0, t1] }: Window) -> [[f64; 2]; 6] {
    let (enter, leave) = (s0.max(t0), s1.min(t1));
    let bend = |at: f64| if enter < leave { [at, at] } else { [s0, t0] };
    [[s0, t0], [s1, t0], [s1, t1], [s0, t1], bend(enter), bend(leave)]
}

impl WindowMoments {
    /// M = s + D and N = t + D with D = max(t - s, 0), whose integrals combine powers at the rectangle's corners.
    fn of(Window { s: [s0, s1], t: [t0, t1] }: Window) -> Self {
        // The window is shifted so that s runs from 0 to width, t from low to high.
        let (width, low, high) = (s1 - s0, t0 - s0, t1 - s0);
        let area = width * (high - low);
        let corners =
            |value: &dyn Fn(f64) -> f64| (value(high) - value(high - width) - value(low) + value(low - width)) / area;
        let cube = |x: f64| if x > 0.0 { x * x * x } else { 0.0 };
        let fourth = |x: f64| if x > 0.0 { x * x * (x * x) } else { 0.0 };
        let d = corners(&cube) / 6.0;
        let square = corners(&fourth) / 12.0;
        let edge = width * (cube(high - width) - cube(low - width)) / area / 6.0;
        let [s, t] = [0.5 * width, 0.5 * (low + high)];
        let s_times_d = 0.5 * square - edge;
        let [var_s, var_t] = [width, high - low].map(|side| side * side / 12.0);
        let [var_d, s_d, t_d] = [square - d * d, s_times_d - s * d, s_times_d + square - t * d];
        Self {
            m: s0 + s + d,
            n: s0 + t + d,
            mm: var_s + 2.0 * s_d + var_d,
            mn: s_d + t_d + var_d,
            nn: var_t + 2.0 * t_d + var_d,
        }
    }
}
