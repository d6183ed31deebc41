//! Surface point of a hit: position, normals, material, and the offset of the next ray.
//!
//! The position is recomputed in f64, on the triangle itself, instead of from t in f32. So a caster's choice of
//! triangle affects the picture, but not its rounding of t.

use crate::geom::vector::{narrow, unit, wide};
use crate::geom::{Hit, Ray};
use crate::scene::{Material, Scene};
use crate::tracer::offset::SurfacePoint;
use glam::DVec3;

/// Minimum cosine between the shading normal and the view; shading normals below it are bent to it.
const LEAST_COSINE: f64 = 1e-3;

/// Surface point of a hit, as seen from the origin of its ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surfel<'a> {
    pub(super) triangle: u32,
    /// Position, and the triangle's front normal.
    pub(super) place: SurfacePoint,
    /// Normal of the triangle on the side that was hit.
    pub(super) normal: DVec3,
    /// Shading normal: interpolated, on the side that was hit, and bent so that it faces the viewer.
    pub(super) shading: DVec3,
    /// Unit vector back along the ray.
    pub(super) view: DVec3,
    pub(super) front: bool,
    pub(super) material: &'a Material,
}

impl<'a> Surfel<'a> {
    /// Computes the surface point of a hit; `None` for a triangle without area.
    pub(super) fn new(scene: &'a Scene, rounding: f64, ray: &Ray, hit: Hit) -> Option<Self> {
        let corners = scene.mesh().corners(hit.triangle)?.map(wide);
        let (origin, direction) = (wide(ray.origin()), wide(ray.direction()));
        let view = -unit(direction)?;
        let weights = barycentric(corners, origin, direction, f64::from(hit.t));
        let place = SurfacePoint::of(corners, weights, rounding)?;
        let front = place.normal.dot(view) >= 0.0;
        let normal = if front { place.normal } else { -place.normal };
        let smooth = scene.corner_normals(hit.triangle).and_then(|corners| interpolated(corners, weights));
        let shading = smooth.map_or(normal, |smooth| {
            let smooth = if front { smooth } else { -smooth };
            facing_viewer(smooth, normal, view)
        });
        let (triangle, material) = (hit.triangle, scene.material(hit.triangle));
        Some(Self { triangle, place, normal, shading, view, front, material })
    }

    pub(super) fn ray(&self, towards: DVec3) -> Option<Ray> {
        Ray::new(self.place.lifted(towards, 0.0), narrow(towards)).ok()
    }

    /// Returns a ray to a point in space, which it reaches at t = 1.
    pub(super) fn ray_to_point(&self, point: DVec3) -> Option<Ray> {
        let start = self.place.lifted(point - self.place.at, 0.0);
        Ray::new(start, narrow(point - wide(start))).ok()
    }
}

/// Weights at which the ray crosses the triangle's plane, clamped; of the point at `t` if the plane is edge-on.
fn barycentric([a, b, c]: [DVec3; 3], origin: DVec3, direction: DVec3, t: f64) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(ac);
    let (ao, n_dot_d) = (origin - a, normal.dot(direction));
    let crossing = -normal.dot(ao) / n_dot_d;
    let t = if crossing.is_finite() { crossing } else { t };
    let p = ao + t * direction;
    let square = normal.dot(normal);
    let v = p.cross(ac).dot(normal) / square;
    let w = ab.cross(p).dot(normal) / square;
    let weights = DVec3::new(1.0 - v - w, v, w).map(|x| if x > 0.0 { x } else { 0.0 });
    let sum = weights.element_sum();
    if sum > 0.0 && sum.is_finite() { weights / sum } else { DVec3::splat(1.0 / 3.0) }
}

fn interpolated(corners: [[f32; 3]; 3], weights: DVec3) -> Option<DVec3> {
    let [a, b, c] = corners.map(wide);
    unit(weights[0] * a + weights[1] * b + weights[2] * c)
}

/// Returns a shading normal that faces the viewer. If the normal faces away from the viewer, it is bent towards the
/// viewer as little as necessary. If it faces away from the triangle's normal, it is replaced by the triangle's normal.
fn facing_viewer(smooth: DVec3, normal: DVec3, view: DVec3) -> DVec3 {
    if smooth.dot(normal) <= 0.0 {
        return normal;
    }
    let cosine = smooth.dot(view);
    if cosine >= LEAST_COSINE {
        return smooth;
    }
    unit(smooth + (LEAST_COSINE - cosine) * view).filter(|bent| bent.dot(normal) > 0.0).unwrap_or(normal)
}
