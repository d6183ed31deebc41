//! Shading of first hits: smooth normals, two lights, a plain background.
//!
//! A study's picture must show wrong hits and nothing else, so shading depends on the ray and the reported triangle,
//! never on the reported t.

use glam::DVec3;

use crate::geom::vector::{unit, wide};
use crate::geom::{Mesh, Ray};
use crate::picture::{RgbImage, rgb8};
use crate::ray_engine::{RayBatch, paper};

/// Background color: linear RGB.
const BACKGROUND: DVec3 = DVec3::new(0.012, 0.016, 0.024);
/// Albedo of the surface, a clay: linear RGB.
const ALBEDO: DVec3 = DVec3::new(0.78, 0.60, 0.42);

/// Vertex normals: area-weighted averages over the adjoining triangles.
pub struct TeapotShader<'a> {
    mesh: &'a Mesh,
    normals: Vec<DVec3>,
}

impl<'a> TeapotShader<'a> {
    /// Computes the normals.
    pub fn new(mesh: &'a Mesh) -> Self {
        Self { mesh, normals: mesh.vertex_normals() }
    }

    /// Shades a batch of rays. `hits` holds the triangle of each ray, or `None`.
    pub fn picture(&self, rays: &RayBatch, hits: &[Option<u32>]) -> RgbImage {
        let pixel = |(ray, hit): (&Ray, &Option<u32>)| {
            hit.map_or(BACKGROUND, |triangle| self.shade(ray, triangle)).to_array().map(encode)
        };
        rgb8(rays.width(), rays.height(), rays.rays().iter().zip(hits).map(pixel))
    }

    fn shade(&self, ray: &Ray, triangle: u32) -> DVec3 {
        let (origin, direction) = (wide(ray.origin()), wide(ray.direction()));
        let Some(corners) = self.mesh.corners(triangle) else { return DVec3::new(1.0, 0.0, 1.0) };
        let crossing = paper::intersect(origin, direction, corners.map(wide));
        let weights = DVec3::new(crossing.w, crossing.u, crossing.v);
        // u belongs to b, v to c, w to a. If a ray misses its reported triangle, its weights are clamped to the
        // triangle's border.
        let sign = if crossing.n_dot_d < 0.0 { 1.0 } else { -1.0 };
        let weights = weights.map(|x| (x * sign).max(0.0));
        let sum = weights.element_sum();
        let barycentric = if sum > 0.0 { weights / sum } else { DVec3::splat(1.0 / 3.0) };
        let indices = self.mesh.triangles()[triangle as usize];
        let corners = barycentric.to_array().into_iter().zip(indices);
        let normal = unit_or_zero(corners.map(|(weight, index)| weight * self.normals[index as usize]).sum());
        let view = unit_or_zero(-direction);
        light(if normal.dot(view) < 0.0 { -normal } else { normal }, view)
    }
}

/// Radiance from a key light from above, a fill light from the eye, and a highlight.
fn light(normal: DVec3, view: DVec3) -> DVec3 {
    let key = unit_or_zero(DVec3::new(-0.35, -0.55, 0.9));
    let diffuse = 0.05 + 0.25 * normal.dot(view).max(0.0) + 0.75 * normal.dot(key).max(0.0);
    let half = unit_or_zero(key + view);
    let mut highlight = normal.dot(half).max(0.0);
    for _ in 0..5 {
        highlight *= highlight; // to the 32nd power
    }
    ALBEDO.map(|a| a * diffuse + 0.25 * highlight)
}

fn unit_or_zero(v: DVec3) -> DVec3 {
    unit(v).unwrap_or(v)
}

/// Encodes linear light with gamma 2. The study counts pixels whose bytes differ, so the curve affects its results and
/// is kept instead of sRGB.
fn encode(linear: f64) -> u8 {
    (linear.clamp(0.0, 1.0).sqrt() * 255.0 + 0.5) as u8
}
