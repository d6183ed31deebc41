//! Parabolic maps (Heidrich and Seidel 1999): the hemisphere around +z, mapped to a disk in a square of texels.

use glam::DVec3;

use crate::elementary::atan2;

/// Texels of a parabolic map around +z. With s = x / (1 + z) and t = y / (1 + z), texture coordinates are ((s + 1) / 2,
/// (t + 1) / 2): columns run along x, rows along y.
///
/// The circle s^2 + t^2 = 1 is the horizon. Filtering reads texels beyond it, so their directions, which are below the
/// horizon, are evaluated too. The corners are at z = -1/3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParabolicMap {
    side: usize,
}

impl ParabolicMap {
    /// Creates a map with `side` texels along an edge; the paper uses 32. Panics if there are none.
    pub const fn new(side: usize) -> Self {
        assert!(side > 0, "a texel along an edge");
        Self { side }
    }

    /// Texels along an edge.
    pub const fn side(self) -> usize {
        self.side
    }

    /// Unit direction of a texel's center.
    pub fn direction(self, column: usize, row: usize) -> DVec3 {
        direction_of([column, row].map(|at| (2 * at + 1) as f64 / self.side as f64 - 1.0))
    }

    /// Unit direction at texture coordinates; below the horizon if they are beyond the circle.
    pub fn direction_at(coordinates: [f64; 2]) -> DVec3 {
        direction_of(coordinates.map(|at| 2.0 * at - 1.0))
    }

    /// Texture coordinates of a unit direction: within [0, 1] above the horizon; infinite or NaN at -z.
    pub fn coordinates_of(direction: DVec3) -> [f64; 2] {
        [direction.x, direction.y].map(|along| 0.5 + 0.5 * along / (1.0 + direction.z))
    }

    /// Number of texels.
    pub const fn texels(self) -> usize {
        self.side * self.side
    }

    /// Returns the four texels around a unit direction, as row times side plus column, with their bilinear weights,
    /// which are non-negative and sum to 1. Beyond the outermost centers the map is clamped; -z, which has no
    /// coordinates, maps to the first texel.
    pub fn taps(self, direction: DVec3) -> [(usize, f64); 4] {
        let [x, y] = Self::coordinates_of(direction).map(|at| {
            let last = (self.side - 1) as f64;
            let at = at * self.side as f64 - 0.5;
            // NaN is clamped to 0.
            let at = if at > 0.0 { at.min(last) } else { 0.0 };
            let first = (at as usize).min(self.side.saturating_sub(2));
            (first, (first + 1).min(self.side - 1), at - first as f64)
        });
        let tap = |(row, down): (usize, f64), (column, across): (usize, f64)| (row * self.side + column, down * across);
        let [(left, right, across), (top, bottom, down)] = [x, y];
        [
            tap((top, 1.0 - down), (left, 1.0 - across)),
            tap((top, 1.0 - down), (right, across)),
            tap((bottom, down), (left, 1.0 - across)),
            tap((bottom, down), (right, across)),
        ]
    }

    /// Solid angle of a texel: the integral of 4 / (1 + s^2 + t^2)^2.
    pub fn solid_angle(self, column: usize, row: usize) -> f64 {
        let edge = |at: usize| 2.0 * at as f64 / self.side as f64 - 1.0;
        let [s0, s1, t0, t1] = [edge(column), edge(column + 1), edge(row), edge(row + 1)];
        (corner(s1, t1) - corner(s0, t1)) - (corner(s1, t0) - corner(s0, t0))
    }
}

fn direction_of([s, t]: [f64; 2]) -> DVec3 {
    let square = s * s + t * t;
    DVec3::new(2.0 * s, 2.0 * t, 1.0 - square) / (1.0 + square)
}

/// Solid angle of the rectangle from (0, 0) to (s, t).
fn corner(s: f64, t: f64) -> f64 {
    let [a, b] = [(1.0 + s * s).sqrt(), (1.0 + t * t).sqrt()];
    2.0 * (s / a * atan2(t, a) + t / b * atan2(s, b))
}
