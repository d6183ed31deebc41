//! Where the rays of vertices start: lifted off all triangles that meet at the vertex's position.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;

use super::vertices::Vertices;
use crate::geom::vector::{narrow, wide};
use crate::tracer::offset::{SINGLE, SurfacePoint};

/// Rounds after which an origin that is not yet clear of all triangles stays where it is.
const MAX_ROUNDS: usize = 16;

/// Where the rays of a vertex start, and the triangles that meet there.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Origin {
    /// In the precision of rays.
    pub(crate) at: [f32; 3],
    /// Unit normals of the triangles at the position.
    pub(crate) planes: Vec<DVec3>,
    /// Whether it lies in front of all of them.
    pub(crate) is_clear: bool,
}

impl Origin {
    /// Whether a direction runs below the geometric horizon: behind every triangle that meets at the vertex.
    pub(crate) fn is_below_horizon(&self, direction: DVec3) -> bool {
        self.planes.iter().all(|plane| plane.dot(direction) < 0.0)
    }
}

/// The origins of all vertices.
pub(crate) fn origins(vertices: &Vertices) -> Vec<Origin> {
    let mut at_place: BTreeMap<[u32; 3], Vec<u32>> = BTreeMap::new();
    for (indices, triangle) in vertices.triangles().iter().zip(0..) {
        for &vertex in indices {
            let triangles = at_place.entry(key(vertices, vertex)).or_default();
            if triangles.last() != Some(&triangle) {
                triangles.push(triangle);
            }
        }
    }
    (0..vertices.len() as u32)
        .into_par_iter()
        .map(|vertex| {
            let around = at_place.get(&key(vertices, vertex)).map_or(&[][..], Vec::as_slice);
            origin(vertices, vertex, around)
        })
        .collect()
}

fn key(vertices: &Vertices, vertex: u32) -> [u32; 3] {
    vertices.positions()[vertex as usize].map(|value| (value + 0.0).to_bits())
}

/// Moves the vertex in turn along the normal of each triangle that it is not yet clear of.
fn origin(vertices: &Vertices, vertex: u32, around: &[u32]) -> Origin {
    let place = wide(vertices.positions()[vertex as usize]);
    let planes: Vec<(DVec3, f64)> = around
        .iter()
        .filter_map(|&triangle| {
            let corners = vertices.corners(triangle);
            let weights = DVec3::from(corners.map(|corner| f64::from(u8::from(corner == place))));
            let point = SurfacePoint::of(corners, weights, SINGLE)?;
            Some((point.normal, point.clearance(0.0)))
        })
        .collect();
    let mut at = place;
    let clear = |at: DVec3| planes.iter().all(|&(normal, clearance)| normal.dot(wide(narrow(at)) - place) >= clearance);
    for _ in 0..MAX_ROUNDS {
        if clear(at) {
            break;
        }
        for &(normal, clearance) in &planes {
            // Twice the clearance, so that rounding to single precision does not eat it up.
            let missing = 2.0 * clearance - normal.dot(at - place);
            if missing > 0.0 {
                at += missing * normal;
            }
        }
    }
    let is_clear = clear(at);
    Origin { at: narrow(at), planes: planes.into_iter().map(|(normal, _)| normal).collect(), is_clear }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Mesh;
    use crate::prt::transfer::Tangents;

    #[test]
    fn corners_of_a_room_are_left_to_the_inside() {
        let mesh = Mesh::new(
            vec![[7.0; 3], [8.0, 7.0, 7.0], [7.0, 8.0, 7.0], [7.0, 7.0, 8.0]],
            vec![[0, 1, 2], [0, 3, 1], [0, 2, 3]],
        );
        let vertices = Vertices::new(&mesh.expect("a mesh"), Tangents::Any).expect("vertices");
        let corner = &origins(&vertices)[0];
        assert!(corner.is_clear && corner.planes.len() == 3);
        let lift = wide(corner.at) - DVec3::splat(7.0);
        assert!(lift.min_element() > 0.0 && lift.max_element() < 1e-4, "{lift}");
        assert!(corner.is_below_horizon(DVec3::splat(-1.0)) && !corner.is_below_horizon(DVec3::new(1.0, -1.0, -1.0)));
    }
}
