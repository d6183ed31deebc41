//! Rays that meet the inside of a surface, where a miss is a hole and not the rounding of an outline.

use std::collections::BTreeMap;

use crate::geom::Mesh;
use crate::geom::classify::HitVerdict;
use crate::geom::exact::NearestHit;
use crate::geom::vector::wide;

/// Minimum cosine between the normal of a triangle and the direction to the eye for the triangle to count as facing it.
/// With a smaller cosine, a card's rounding may make it face away.
const FACING: f64 = 1.0 / 16.0;

/// Rays whose exact first hit lies inside the surface, and how many of them a card misses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Holes {
    /// Rays that meet the inside of the surface.
    pub rays: u64,
    /// Rays among these that hit nothing.
    pub leaks: u64,
}

/// Marks triangles away from outlines: at each of their corners, all triangles face the eye, and no edge belongs to one
/// triangle only. Triangles without area are ignored.
pub(super) struct Inside(Vec<bool>);

impl Inside {
    /// Finds the triangles, seen from `eye`.
    pub(super) fn new(mesh: &Mesh, eye: [f32; 3]) -> Self {
        let mesh = mesh.welded();
        let mut is_inside = vec![true; mesh.positions().len()];
        let mut triangles_of_edge: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        let with_area = |[a, b, c]: [u32; 3]| a != b && b != c && c != a;
        for (triangle, corners) in mesh.triangles().iter().zip(mesh.iter_corners()) {
            let [a, b, c] = corners.map(wide);
            let (n, ao) = ((b - a).cross(c - a), wide(eye) - a);
            if !with_area(*triangle) || n.length_squared() == 0.0 {
                continue;
            }
            for (i, vertex) in triangle.iter().enumerate() {
                is_inside[*vertex as usize] &= n.dot(ao) > FACING * n.length() * ao.length();
                let next = triangle[(i + 1) % 3];
                *triangles_of_edge.entry([*vertex.min(&next), *vertex.max(&next)]).or_default() += 1;
            }
        }
        for vertex in triangles_of_edge.iter().filter(|(_, count)| **count != 2).flat_map(|(edge, _)| edge) {
            is_inside[*vertex as usize] = false;
        }
        Self(mesh.triangles().iter().map(|corners| corners.iter().all(|vertex| is_inside[*vertex as usize])).collect())
    }

    /// Counts the holes among rays with these exact first hits and verdicts.
    pub(super) fn holes(&self, nearest: &[Option<NearestHit>], verdicts: &[HitVerdict]) -> Holes {
        let mut holes = Holes::default();
        for (nearest, verdict) in nearest.iter().zip(verdicts) {
            let is_inside = |triangle: u32| self.0.get(triangle as usize).is_some_and(|inside| *inside);
            if nearest.as_ref().is_some_and(|hit| is_inside(hit.triangle)) {
                holes.rays += 1;
                holes.leaks += u64::from(*verdict == HitVerdict::Leak);
            }
        }
        holes
    }
}
