//! Rays aimed at shared edges and at vertices.
//!
//! The direction is `target - eye`, computed in f64 and rounded to f32. So a ray passes its edge within the rounding of
//! f32, and only exact arithmetic can decide on which side.

use glam::DVec3;

use super::random::CounterRng;
use super::vector::{narrow, wide};
use super::{Mesh, Ray};

/// Ray with its target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aimed {
    /// The ray.
    pub ray: Ray,
    /// Index of the edge in [`Mesh::edges`], or of the vertex in [`Mesh::positions`].
    pub target: u32,
}

/// Generates `per_edge` rays from `eye` to random points strictly inside every edge that two or more triangles share.
/// The same seed gives the same rays. An edge is omitted if it is so near the eye, or so far from it, that the
/// direction vanishes or overflows.
pub fn aimed_at_edges(mesh: &Mesh, eye: [f32; 3], per_edge: u32, seed: u64) -> Vec<Aimed> {
    let stream = CounterRng::new(seed);
    let mut rays = Vec::new();
    for (target, edge) in (0_u32..).zip(mesh.edges()) {
        if edge.triangles.len() < 2 {
            continue;
        }
        let [from, to] = edge.vertices.map(|vertex| wide(mesh.positions()[vertex as usize]));
        for sample in 0..per_edge {
            // Half a step is added, so that neither end is hit.
            let at = stream.unit(u64::from(target), u64::from(sample), 0) + 0.5 / 16_777_216.0;
            let point = from + at * (to - from);
            rays.extend(aim(eye, point).map(|ray| Aimed { ray, target }));
        }
    }
    rays
}

/// Generates one ray from `eye` to every vertex that a triangle uses.
pub fn aimed_at_vertices(mesh: &Mesh, eye: [f32; 3]) -> Vec<Aimed> {
    let mut used = vec![false; mesh.positions().len()];
    for &index in mesh.triangles().iter().flatten() {
        used[index as usize] = true;
    }
    let vertices = (0_u32..).zip(mesh.positions()).zip(used).filter(|&(_, used)| used);
    vertices.filter_map(|((target, &position), _)| Some(Aimed { ray: aim(eye, wide(position))?, target })).collect()
}

/// Returns the ray from an eye towards a point, if f32 can represent its direction.
fn aim(eye: [f32; 3], point: DVec3) -> Option<Ray> {
    Ray::new(eye, narrow(point - wide(eye))).ok()
}
