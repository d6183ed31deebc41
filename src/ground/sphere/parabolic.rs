//! Parabolic maps (Heidrich and Seidel 1999): the hemisphere around z in the unit circle of a square of texels.

use glam::DVec3;

use crate::elementary::atan2;

/// Texels of a parabolic map around +z. With s = x / (1 + z) and t = y / (1 + z), texture coordinates are ((s + 1) / 2,
/// (t + 1) / 2): columns run along x, rows along y.
///
/// The circle s^2 + t^2 = 1 is the horizon. Texels beyond it take part in filtering, so their directions, which lie
/// below the horizon, are evaluated too. The corners are at z = -1/3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParabolicMap {
    side: usize,
}

impl ParabolicMap {
    /// Creates a map with `side` texels along an edge; the paper has 32.
    ///
    /// # Panics
    /// If there are none.
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
    pub fn coordinates(self, direction: DVec3) -> [f64; 2] {
        Self::coordinates_of(direction)
    }

    /// Like [`Self::coordinates`], which do not depend on the size of the map.
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
        let [x, y] = self.coordinates(direction).map(|at| {
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

/// Unit direction at s and t.
fn direction_of([s, t]: [f64; 2]) -> DVec3 {
    let square = s * s + t * t;
    DVec3::new(2.0 * s, 2.0 * t, 1.0 - square) / (1.0 + square)
}

/// Solid angle of the rectangle from (0, 0) to (s, t).
fn corner(s: f64, t: f64) -> f64 {
    let [a, b] = [(1.0 + s * s).sqrt(), (1.0 + t * t).sqrt()];
    2.0 * (s / a * atan2(t, a) + t / b * atan2(s, b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::integral;

    #[test]
    fn directions_and_coordinates_are_inverse() {
        let map = ParabolicMap::new(32);
        for (column, row) in [(0, 0), (16, 3), (31, 31)] {
            let direction = map.direction(column, row);
            assert!((direction.length() - 1.0).abs() < 4e-16);
            let expected = [column, row].map(|at| (at as f64 + 0.5) / 32.0);
            let found = map.coordinates(direction);
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{found:?} {expected:?}");
        }
        let below = DVec3::new(0.6, -0.48, -0.64);
        assert!((ParabolicMap::direction_at(map.coordinates(below)) - below).length() < 1e-15);
        assert_eq!(map.coordinates(DVec3::X), [1.0, 0.5], "columns run along x");
        assert_eq!(map.coordinates(DVec3::Y), [0.5, 1.0], "rows along y");
        assert_eq!(map.coordinates(DVec3::Z), [0.5, 0.5]);
        assert!((ParabolicMap::new(4096).direction(0, 0).z + 1.0 / 3.0).abs() < 1e-3, "the corner");
    }

    #[test]
    fn interpolation_gives_texels_at_their_centers_and_planes_between() {
        let map = ParabolicMap::new(8);
        let value = |at: usize| 3.0 * (at % 8) as f64 - 2.0 * (at / 8) as f64;
        let read = |direction: DVec3| map.taps(direction).map(|(at, weight)| weight * value(at)).iter().sum::<f64>();
        for (column, row) in [(0, 0), (7, 7), (3, 5)] {
            assert!((read(map.direction(column, row)) - value(row * 8 + column)).abs() < 1e-12);
        }
        let between = DVec3::new(0.3, -0.2, (1.0_f64 - 0.13).sqrt());
        let [x, y] = map.coordinates(between).map(|at| 8.0 * at - 0.5);
        assert!((read(between) - (3.0 * x - 2.0 * y)).abs() < 1e-12);
        for map in [ParabolicMap::new(1), ParabolicMap::new(2), map] {
            for direction in [DVec3::X, DVec3::Z, DVec3::NEG_Z, DVec3::new(0.6, 0.0, -0.8), DVec3::NEG_Y] {
                let taps = map.taps(direction);
                assert!((taps.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-15);
                assert!(taps.iter().all(|&(at, weight)| at < map.texels() && (0.0..=1.0).contains(&weight)));
            }
        }
    }

    #[test]
    fn solid_angles_are_the_integral_of_the_density() {
        let map = ParabolicMap::new(32);
        for (column, row) in [(0, 0), (16, 16), (31, 7)] {
            let edge = |at: usize| at as f64 / 16.0 - 1.0;
            let inner = |t: f64| {
                let density = |s: f64| 4.0 / ((1.0 + s * s + t * t) * (1.0 + s * s + t * t));
                integral(edge(column), edge(column + 1), density)
            };
            let expected = integral(edge(row), edge(row + 1), inner);
            let found = map.solid_angle(column, row);
            assert!((found - expected).abs() < 1e-15, "{column} {row}: {found} {expected}");
        }
    }
}
