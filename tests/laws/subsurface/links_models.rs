//! Models and media for the laws of links.

use crate::environment::by_form;
use crossbar::atlas::Atlas;
use crossbar::geom::Mesh;
use crossbar::subsurface::multipole::{ClusterId, SurfaceMoments};
use crossbar::subsurface::{Coefficients, Dipole};

/// A sphere of radius 1, with dents in proportion to `dents`: the sides of a cube, n x n squares each, pushed outward.
pub(crate) fn sphere(n: u32, dents: f64) -> Mesh {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for side in 0..6 {
        let first = positions.len() as u32;
        for (j, i) in (0..=n).flat_map(|j| (0..=n).map(move |i| (j, i))) {
            let [u, v] = [i, j].map(|k| 2.0 * f64::from(k) / f64::from(n) - 1.0);
            let [x, y, z] = match side {
                0 => [1.0, u, v],
                1 => [-1.0, v, u],
                2 => [v, 1.0, u],
                3 => [u, -1.0, v],
                4 => [u, v, 1.0],
                _ => [v, u, -1.0],
            };
            let length = (x * x + y * y + z * z).sqrt();
            let [x, y, z] = [x / length, y / length, z / length];
            let radius = 1.0 + dents * (x * x * x + 1.5 * x * y * z - z * z * y);
            positions.push([x, y, z].map(|value| (radius * value) as f32));
        }
        for (j, i) in (0..n).flat_map(|j| (0..n).map(move |i| (j, i))) {
            let a = first + j * (n + 1) + i;
            let [b, c, d] = [a + 1, a + n + 1, a + n + 2];
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    Mesh::new(positions, triangles).expect("a mesh").welded()
}

pub(crate) fn marble() -> Dipole {
    Dipole::new(Coefficients { sigma_s_prime: 2.62, sigma_a: 0.0041 }, 1.5).expect("a medium")
}

/// The medium of Figure 7.
pub(crate) fn figure_7() -> Dipole {
    medium(2.21, 0.0012)
}

pub(crate) fn medium(sigma_s_prime: f64, sigma_a: f64) -> Dipole {
    Dipole::new(Coefficients { sigma_s_prime, sigma_a }, 1.3).expect("a medium")
}

pub(crate) fn atlas(mesh: &Mesh, side: u32) -> Atlas {
    Atlas::new(mesh, side).expect("an atlas")
}

pub(crate) fn surface(atlas: &Atlas, mm_per_unit: f64) -> SurfaceMoments {
    SurfaceMoments::new(atlas, mm_per_unit).expect("a scale")
}

pub(crate) fn root(surface: &SurfaceMoments) -> ClusterId {
    ClusterId { level: surface.level_count() - 1, y: 0, x: 0 }
}

/// All clusters of a level.
pub(crate) fn level(surface: &SurfaceMoments, level: u32) -> Vec<ClusterId> {
    let width = surface.side() >> level;
    (0..width).flat_map(|y| (0..width).map(move |x| ClusterId { level, y, x })).collect()
}

/// Columns and rows of all texels, row by row.
pub(crate) fn texels(side: u32) -> impl Iterator<Item = [u32; 2]> {
    (0..side).flat_map(move |y| (0..side).map(move |x| [x, y]))
}

/// The tolerance of the reference factors: a tenth of the tested tolerance, with `CROSSBAR_FULL=1` a hundredth.
pub(crate) fn fine_tolerance() -> f64 {
    by_form(1e-3, 1e-4)
}
