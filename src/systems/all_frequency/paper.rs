//! Reference solution: exit radiance of a vertex under a light of cube texels (equation 1), in f64, without factors,
//! matrices, wavelets, compression or a card. Every fine direction is tested against every triangle.
//!
//! It shares with the tested code only the vertices and the choice of hat functions, and no arithmetic.

use glam::DVec3;

use crate::elementary::atan2;
use crate::transfer::linear_basis::BasisWidth;
use crate::transfer::{Vertices, plain_hit, plain_origin};

/// Texels of the light along an edge.
const LIGHT: usize = 32;
/// Directions along an edge: 4 x 4 per texel.
const FINE: usize = 128;

/// Input of the reference: vertices, one BRDF, one channel of light.
#[derive(Clone, Copy)]
pub struct AllFrequencyReference<'a> {
    /// The mesh.
    pub vertices: &'a Vertices,
    /// f(v, s) = b(v, s) s_z for local directions of view and light.
    pub product: &'a dyn Fn(DVec3, DVec3) -> f64,
    /// The radiance of each light texel, with index 1024 face + 32 row + column.
    pub light: &'a [f64],
    /// Interpolation of the light between texels.
    pub hats: BasisWidth,
}

impl std::fmt::Debug for AllFrequencyReference<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("AllFrequencyReference").field("hats", &self.hats).finish_non_exhaustive()
    }
}

impl AllFrequencyReference<'_> {
    /// g_p(v), the radiance that a vertex sends towards `view` in its local frame (equation 1). `sees` tells whether
    /// light reaches the vertex from a direction; the direction is a face, row and column of a cube map of 6 x 128 x
    /// 128. [`Self::sees`] answers this exactly. Panics if there is no such vertex.
    pub fn exit_radiance(&self, vertex: usize, view: DVec3, sees: impl Fn(usize, usize, usize) -> bool) -> f64 {
        let frame = &self.vertices.frames()[vertex];
        let mut sum = 0.0;
        for face in 0..6 {
            for row in 0..FINE {
                for column in 0..FINE {
                    let direction = direction(face, row, column, FINE);
                    let s = frame.to_local(direction);
                    if s.z > 0.0 && sees(face, row, column) {
                        let solid_angle = solid_angle(row, column);
                        sum += (self.product)(view, s) * self.light(face, row, column) * solid_angle;
                    }
                }
            }
        }
        sum
    }

    /// True if a vertex sees the light in a direction: the direction lies above its horizon, and no triangle blocks it.
    /// Panics if there is no such vertex or face.
    pub fn sees(&self, vertex: usize, [face, row, column]: [usize; 3]) -> bool {
        let direction = direction(face, row, column, FINE);
        let normal = self.vertices.frames()[vertex].normal();
        let is_above = normal.dot(direction) > 0.0;
        is_above && plain_hit(self.vertices, plain_origin(self.vertices, vertex), direction).is_none()
    }

    /// The light's radiance in a direction.
    fn light(&self, face: usize, row: usize, column: usize) -> f64 {
        let texel = |row: usize, column: usize| self.light[(face * LIGHT + row) * LIGHT + column];
        if self.hats == BasisWidth::OneTexel {
            return texel(row * LIGHT / FINE, column * LIGHT / FINE);
        }
        // Coordinates in texels, from the center of the first texel.
        let [y, x] = [row, column].map(|at| (at as f64 + 0.5) * LIGHT as f64 / FINE as f64 - 0.5);
        let [v, u] = [y - y.floor(), x - x.floor()];
        let radiance = |down: f64, right: f64| self.texel_beyond(face, y.floor() + down, x.floor() + right);
        let corners = [radiance(0.0, 0.0), radiance(0.0, 1.0), radiance(1.0, 0.0), radiance(1.0, 1.0)];
        // At a corner of the cube only three texels meet, and their mean replaces the fourth.
        let there: Vec<f64> = corners.into_iter().flatten().collect();
        let mean = there.iter().sum::<f64>() / there.len() as f64;
        let [a, b, c, d] = corners.map(|corner| corner.unwrap_or(mean));
        (1.0 - v) * ((1.0 - u) * a + u * b) + v * ((1.0 - u) * c + u * d)
    }

    /// The radiance of the texel at a row and column. One texel beyond the face, the neighboring face is unfolded into
    /// this face's plane; `None` beyond a corner.
    fn texel_beyond(&self, face: usize, row: f64, column: f64) -> Option<f64> {
        let along = |at: f64| (2.0 * at + 1.0) / LIGHT as f64 - 1.0;
        let [v, u] = [along(row), along(column)];
        if u.abs() > 1.0 && v.abs() > 1.0 {
            return None;
        }
        let beyond = (u.abs().max(v.abs()) - 1.0).max(0.0);
        let point = point(face, u.clamp(-1.0, 1.0), v.clamp(-1.0, 1.0)) - beyond * point(face, 0.0, 0.0);
        // A point lies on the face along whose axis its component is 1.
        let on = (0..6).find(|&other| (point.dot(self::point(other, 0.0, 0.0)) - 1.0).abs() < 1e-9)?;
        let place = |axis: DVec3| (((point.dot(axis) + 1.0) / 2.0 * LIGHT as f64).floor() as usize).min(LIGHT - 1);
        let right = self::point(on, 1.0, 0.0) - self::point(on, 0.0, 0.0);
        let down = self::point(on, 0.0, 1.0) - self::point(on, 0.0, 0.0);
        Some(self.light[(on * LIGHT + place(down)) * LIGHT + place(right)])
    }
}

/// The point of a face of the cube of half side 1, by Direct3D's table: u grows with the columns, v with the rows.
fn point(face: usize, u: f64, v: f64) -> DVec3 {
    match face {
        0 => DVec3::new(1.0, -v, -u),
        1 => DVec3::new(-1.0, -v, u),
        2 => DVec3::new(u, 1.0, v),
        3 => DVec3::new(u, -1.0, -v),
        4 => DVec3::new(u, -v, 1.0),
        5 => DVec3::new(-u, -v, -1.0),
        _ => panic!("a cube has six faces, there is no face {face}"),
    }
}

/// The direction of a texel's center.
fn direction(face: usize, row: usize, column: usize, side: usize) -> DVec3 {
    let [v, u] = [row, column].map(|at| (2 * at + 1) as f64 / side as f64 - 1.0);
    let point = point(face, u, v);
    point / point.length()
}

/// Solid angle of a texel of 128 x 128, from solid angles of rectangles from (0, 0) to (x, y) at distance 1.
fn solid_angle(row: usize, column: usize) -> f64 {
    let edge = |at: usize| 2.0 * at as f64 / FINE as f64 - 1.0;
    let to = |x: f64, y: f64| atan2(x * y, (x * x + y * y + 1.0).sqrt());
    let [x0, x1, y0, y1] = [edge(column), edge(column + 1), edge(row), edge(row + 1)];
    to(x1, y1) - to(x0, y1) - to(x1, y0) + to(x0, y0)
}
