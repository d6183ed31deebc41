//! Thickness of a model, as a measure of its difference from a half space.

use glam::DVec3;

use crate::geom::vector::narrow;
use crate::geom::{Mesh, Ray, Sides};
use crate::tracer::HostTracer;
use crate::tracer::offset::{SINGLE, SurfacePoint};

/// Returns the area-weighted median thickness of a mesh, in the mesh's units: the distance from the centre of a face
/// along its inward normal to the next surface. `None` if at least half of the area has no surface behind it, as on
/// open meshes.
pub fn median_thickness(mesh: &Mesh) -> Option<f64> {
    // Degenerate faces have no ray, and do not count.
    let inward = (0..mesh.len() as u32).filter_map(|face| Some((inward_ray(mesh, face)?, mesh.area(face))));
    let (starts, areas): (Vec<(Ray, f64)>, Vec<f64>) = inward.unzip();
    let (rays, clearances): (Vec<Ray>, Vec<f64>) = starts.into_iter().unzip();
    let (hits, _) = HostTracer::new(mesh, Sides::Both).nearest_all(&rays);
    let distances = hits.iter().zip(&clearances).map(|(hit, clearance)| match hit {
        Some(hit) => f64::from(hit.t) + clearance,
        None => f64::INFINITY,
    });
    let mut thicknesses: Vec<(f64, f64)> = distances.zip(areas).collect();
    thicknesses.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let half = thicknesses.iter().map(|(_, area)| area).sum::<f64>() / 2.0;
    let mut below = 0.0;
    let median = thicknesses.iter().find(|(_, area)| {
        below += area;
        below >= half
    });
    median.map(|&(thickness, _)| thickness).filter(|thickness| thickness.is_finite())
}

/// The ray from the centre of a face along its inward normal, and the distance of its origin below the face.
fn inward_ray(mesh: &Mesh, face: u32) -> Option<(Ray, f64)> {
    let center = SurfacePoint::new(mesh, face, DVec3::splat(1.0 / 3.0), SINGLE)?;
    let inward = -center.normal;
    let ray = Ray::new(center.lifted(inward, 0.0), narrow(inward)).ok()?;
    Some((ray, center.clearance(0.0)))
}
