//! Ground planes below a model, which receive its shadow.

use glam::DVec3;

use super::grid::{grid_triangles, with_attributes};
use crate::error::InputError;
use crate::geom::Mesh;
use crate::geom::vector::{area_vector, narrow, unit, wide};

/// Vertices along an edge of the ground in the paper on all-frequency transfer (its section 7): 36,864 in all.
pub const GROUND_SIDE: u32 = 192;

/// Distance of a ground below a model's flat base, relative to the longest side of the model's box: far beyond
/// rounding, too small to be visible. If base and ground were coplanar, rays would hit either one, in stripes.
const BELOW_A_FLAT_BASE: f64 = 1.0 / 1024.0;

/// Builds a horizontal square of `side` x `side` vertices that faces up, around `middle`, with normals and texture
/// coordinates.
pub fn ground(side: u32, middle: DVec3, half_width: f64) -> Mesh {
    assert!(side >= 2, "two vertices along an edge, not {side}");
    let along = |at: u32| f64::from(at) / f64::from(side - 1);
    let grid = || (0..side).flat_map(move |row| (0..side).map(move |column| [along(column), along(row)]));
    let place = |[u, v]: [f64; 2]| narrow(middle + half_width * DVec3::new(2.0 * u - 1.0, 2.0 * v - 1.0, 0.0));
    let normals = vec![[0.0, 0.0, 1.0]; (side * side) as usize];
    let texture = grid().map(|at| at.map(|at| at as f32)).collect();
    with_attributes(grid().map(place).collect(), grid_triangles(0, [side - 1; 2]).collect(), normals, texture)
}

/// Builds a ground of `side` x `side` vertices that touches a model's lowest point, twice as wide as the model's larger
/// extent in x or y. If triangles of the model lie in that plane, the ground is lowered by 1/1024 of the longest side
/// of the model's box. Panics as [`ground`] does.
pub fn ground_of(model: &Mesh, side: u32) -> Mesh {
    let [low, high] = model.bounds().unwrap_or_default().map(wide);
    let gap = if has_flat_base(model, low.z) { BELOW_A_FLAT_BASE * (high - low).max_element() } else { 0.0 };
    let middle = (low / 2.0 + high / 2.0).with_z(low.z - gap);
    let width = (high - low).truncate().max_element();
    ground(side, middle, if width > 0.0 { width } else { 1.0 })
}

/// Returns `true` if a triangle with an area lies at this height.
fn has_flat_base(model: &Mesh, height: f64) -> bool {
    model
        .iter_corners()
        .map(|corners| corners.map(wide))
        .any(|corners| corners.iter().all(|corner| corner.z == height) && unit(area_vector(corners)).is_some())
}

/// Combines a model and its ground ([`ground_of`]) in one mesh, with a material per triangle: 0 for the model and 1 for
/// the ground.
///
/// The ground's vertices have normals; the model keeps its normals, or receives mean normals of its triangles.
pub fn on_ground(model: &Mesh, side: u32) -> Result<(Mesh, Vec<u32>), InputError> {
    let ground = ground_of(model, side);
    let first = model.positions().len() as u32;
    let positions = [model.positions(), ground.positions()].concat();
    let moved = ground.triangles().iter().map(|corners| corners.map(|corner| corner + first));
    let triangles: Vec<[u32; 3]> = model.triangles().iter().copied().chain(moved).collect();
    let of_model = match model.normals() {
        Some(normals) => normals.to_vec(),
        None => model.vertex_normals().into_iter().map(narrow).collect(),
    };
    let normals = of_model.into_iter().chain(std::iter::repeat_n([0.0, 0.0, 1.0], ground.positions().len())).collect();
    let materials = (0..triangles.len()).map(|triangle| u32::from(triangle >= model.len())).collect();
    Ok((Mesh::new(positions, triangles)?.with_normals(normals)?, materials))
}
