//! One patch: a flat convex polygon of three or four corners.

use crate::geom::vector::unit;
use glam::DVec3;

/// A flat convex patch of constant radiosity. Its corners run counter-clockwise from its front; its back is black.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    corners: [DVec3; 4],
    sides: usize,
    area: f64,
    center: DVec3,
    normal: DVec3,
    radius: f64,
    /// Index of the patch's face; patches of the same face lie in one plane, so none is visible from another.
    pub face: u32,
    /// Index of its material in the scene.
    pub material: u32,
}

/// A point of a patch, with the parametrisation's density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchPoint {
    /// Position of the point.
    pub at: DVec3,
    /// Area of the patch per unit area of the parameter square.
    pub density: f64,
}

impl Patch {
    /// Creates a patch of three or four corners; `None` for any other number, or if it has no area.
    pub fn new(outline: &[DVec3], face: u32, material: u32) -> Option<Self> {
        let sides = outline.len();
        let corners = match *outline {
            [a, b, c] => [a, b, c, c],
            [a, b, c, d] => [a, b, c, d],
            _ => return None,
        };
        let doubled = (corners[2] - corners[0]).cross(corners[sides - 1] - corners[1]);
        let normal = if sides == 3 { (corners[1] - corners[0]).cross(corners[2] - corners[0]) } else { doubled };
        let area = 0.5 * normal.length();
        let longest = (0..sides).map(|i| (corners[(i + 1) % sides] - corners[i]).length()).fold(0.0, f64::max);
        // Corners are rounded to f32, so a height of 2^-40 of the longest side is a rounding error.
        let least = longest * longest * f64::EPSILON * 4096.0;
        if area.is_nan() || area <= least {
            return None;
        }
        let center = centroid(&corners[..sides], normal);
        let radius = corners[..sides].iter().map(|&c| (c - center).length()).fold(0.0, f64::max);
        Some(Self { corners, sides, area, center, normal: unit(normal)?, radius, face, material })
    }

    /// Its corners, counter-clockwise from the front: three or four.
    pub fn corners(&self) -> &[DVec3] {
        &self.corners[..self.sides]
    }

    /// Its area, above 0, in the square of the scene's unit.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// Its centre of gravity.
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// Its normal, of length 1.
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// The distance of the farthest corner from the centre.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Signed distance of a point from its plane, positive in front.
    pub fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.center)
    }

    /// Evaluates a parametrisation over the unit square: bilinear for four corners; for three, one side of the square
    /// collapses to a corner. Integrals over the patch are integrals over the square of value times density.
    pub fn at(&self, u: f64, v: f64) -> PatchPoint {
        let [a, b, c, d] = self.corners;
        if self.sides == 3 {
            let along = b - a + v * (c - b);
            return PatchPoint { at: a + u * along, density: 2.0 * self.area * u };
        }
        let (near, far) = (b - a, c - d);
        let (left, right) = (d - a, c - b);
        let du = (1.0 - v) * near + v * far;
        let dv = (1.0 - u) * left + u * right;
        let at = a + u * near + v * dv;
        PatchPoint { at, density: self.normal.dot(du.cross(dv)) }
    }
}

/// The centre of gravity of a flat convex polygon.
fn centroid(corners: &[DVec3], normal: DVec3) -> DVec3 {
    let first = corners[0];
    let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
    for pair in corners[1..].windows(2) {
        let (a, b) = (pair[0] - first, pair[1] - first);
        let part = a.cross(b).dot(normal);
        sum += part / 3.0 * (a + b);
        weight += part;
    }
    first + 1.0 / weight * sum
}
