//! Origins of the rays from vertices: moved off all triangles on which the vertex lies, even where it is not a corner
//! of them.

use glam::DVec3;
use rayon::prelude::*;

use super::skyline::Occluders;
use super::vertices::Vertices;
use crate::geom::vector::{narrow, wide};
use crate::tracer::offset::{SINGLE, SurfacePoint};

/// Largest number of rounds in which an origin is moved; after that it stays, even if it is not clear of all triangles.
const MAX_ROUNDS: usize = 16;
/// The largest distance at which a vertex can count as lying on a triangle, relative to the triangle's size or the
/// vertex's coordinates: more than a few rounding errors.
const SHARE: f64 = 1e-5;

/// The origin of a vertex's rays, and the triangles on which the vertex lies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RayOrigin {
    /// The origin, in single precision as rays have it.
    pub(crate) at: [f32; 3],
    /// Unit normals of the triangles.
    pub(crate) planes: Vec<DVec3>,
    /// True if it lies in front of all of them, at the required distance.
    pub(crate) is_clear: bool,
}

impl RayOrigin {
    /// True if a direction lies below the geometric horizon: behind every triangle on which the vertex lies.
    pub(crate) fn is_below_horizon(&self, direction: DVec3) -> bool {
        self.planes.iter().all(|plane| plane.dot(direction) < 0.0)
    }
}

/// The origins of all vertices.
pub(crate) fn origins(vertices: &Vertices, occluders: &Occluders) -> Vec<RayOrigin> {
    vertices.positions().par_iter().map(|&at| origin(wide(at), occluders)).collect()
}

/// Moves the vertex repeatedly along the normal of each triangle that it is not yet clear of.
fn origin(place: DVec3, occluders: &Occluders) -> RayOrigin {
    let mut planes: Vec<(DVec3, f64)> = Vec::new();
    occluders.around(place, SHARE, |corners| planes.extend(plane(corners, place)));
    // Sorted, so that the result does not depend on the order of the triangles.
    planes.sort_by(|(one, _), (other, _)| {
        let keys = one.to_array().into_iter().zip(other.to_array());
        keys.fold(std::cmp::Ordering::Equal, |order, (one, other)| order.then(one.total_cmp(&other)))
    });
    let mut at = place;
    let clear = |at: DVec3| planes.iter().all(|&(normal, clearance)| normal.dot(wide(narrow(at)) - place) >= clearance);
    for _ in 0..MAX_ROUNDS {
        if clear(at) {
            break;
        }
        for &(normal, clearance) in &planes {
            // Twice the clearance, which leaves room for rounding to single precision.
            let missing = 2.0 * clearance - normal.dot(at - place);
            if missing > 0.0 {
                at += missing * normal;
            }
        }
    }
    let is_clear = clear(at);
    RayOrigin { at: narrow(at), planes: planes.into_iter().map(|(normal, _)| normal).collect(), is_clear }
}

/// The normal of a triangle on which `place` lies, and the distance from it at which rays must start; `None` if it lies
/// elsewhere.
fn plane(corners: [DVec3; 3], place: DVec3) -> Option<(DVec3, f64)> {
    let [a, b, c] = corners;
    let weights = DVec3::from([a, b, c].map(|corner| f64::from(u8::from(corner == place))));
    let point = SurfacePoint::of(corners, weights, SINGLE)?;
    let (normal, clearance) = (point.normal, point.clearance(place.distance(a)));
    // The tolerance covers a few rounding errors of the coordinates.
    let largest = corners.iter().fold(place.abs().max_element(), |most, corner| most.max(corner.abs().max_element()));
    let reach = 8.0 * SINGLE * largest;
    let inside = |from: DVec3, to: DVec3| (to - from).cross(place - from).dot(normal) >= -reach * from.distance(to);
    let on = normal.dot(place - a).abs() <= reach && inside(a, b) && inside(b, c) && inside(c, a);
    on.then_some((normal, clearance))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Mesh;
    use crate::transfer::Tangents;

    #[test]
    fn corners_of_a_room_are_left_to_the_inside() {
        let mesh = Mesh::new(
            vec![[7.0; 3], [8.0, 7.0, 7.0], [7.0, 8.0, 7.0], [7.0, 7.0, 8.0]],
            vec![[0, 1, 2], [0, 3, 1], [0, 2, 3]],
        );
        let vertices = Vertices::new(&mesh.expect("a mesh"), Tangents::Any).expect("vertices");
        let corner = &origins(&vertices, &Occluders::new(&vertices))[0];
        assert!(corner.is_clear && corner.planes.len() == 3);
        let lift = wide(corner.at) - DVec3::splat(7.0);
        assert!(lift.min_element() > 0.0 && lift.max_element() < 1e-3, "{lift}");
        assert!(corner.is_below_horizon(DVec3::splat(-1.0)) && !corner.is_below_horizon(DVec3::new(1.0, -1.0, -1.0)));
    }
}
