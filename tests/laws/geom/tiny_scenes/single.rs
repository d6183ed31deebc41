//! The f32 test of one triangle, written independently of the tracer.

use crossbar::geom::{Mesh, Ray, Sides};

/// The power of two that brings the largest coordinate of a mesh into (2, 4]: the units of single-precision tests.
pub(crate) fn scale(mesh: &Mesh) -> f64 {
    let largest = mesh.iter_corners().flatten().flatten().fold(0.0f64, |m, x| m.max(f64::from(x).abs()));
    let mut scale = 1.0;
    while largest * scale > 4.0 {
        scale /= 2.0;
    }
    while largest > 0.0 && largest * scale <= 2.0 {
        scale *= 2.0;
    }
    scale
}

/// A component of a direction, scaled by the power of two that brings the largest component into [1/2, 1).
fn half_to_one(x: f32, largest: f32) -> f64 {
    let mut scaled = (f64::from(x), f64::from(largest));
    while scaled.1 >= 1.0 {
        scaled = (scaled.0 / 2.0, scaled.1 / 2.0);
    }
    while scaled.1 < 0.5 {
        scaled = (scaled.0 * 2.0, scaled.1 * 2.0);
    }
    scaled.0
}

/// Equations (1) to (8): true if the ray meets the triangle, at a scale of lengths, with t along the direction scaled
/// into range.
pub(crate) fn meets(ray: &Ray, corners: [[f32; 3]; 3], sides: Sides, scale: f64) -> bool {
    let largest = ray.direction().iter().fold(0.0f32, |m, x| m.max(x.abs()));
    let d = ray.direction().map(|x| half_to_one(x, largest) as f32);
    let scaled = |p: [f32; 3]| p.map(|x| (f64::from(x) * scale) as f32);
    let (o, [a, b, c]) = (scaled(ray.origin()), corners.map(scaled));
    let sub = |p: [f32; 3], q: [f32; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let dot = |p: [f32; 3], q: [f32; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let cross =
        |p: [f32; 3], q: [f32; 3]| [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    let (ab, ac, bc, ao, bo) = (sub(b, a), sub(c, a), sub(c, b), sub(o, a), sub(o, b));
    let (n, aod, bod) = (cross(ab, ac), cross(ao, d), cross(bo, d));
    let inside = [dot(ac, aod), dot(ab.map(|x| -x), aod), dot(bc.map(|x| -x), bod)];
    let (n_ao, n_d) = (dot(n, ao), dot(n, d));
    let faces = n_d < 0.0 || (sides == Sides::Both && n_d > 0.0);
    let sign = if n_d < 0.0 { 1.0 } else { -1.0 };
    faces && !inside.iter().any(|x| x * sign < 0.0) && (0.0..f32::INFINITY).contains(&(n_ao * -n_d.recip()))
}
