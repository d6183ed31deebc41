//! From first hits to a picture: smooth normals, two lights, a plain background.
//!
//! A study's picture must show where hits are wrong and nothing else, so shading depends on the ray and the triangle
//! reported for it, never on the reported t.

use crate::geom::{Mesh, Ray};
use crate::picture::{RgbImage, rgb8};
use crate::ray_engine::{RayBatch, reference};

type Vec3 = [f64; 3];

/// Color where no surface is: linear RGB.
const BACKGROUND: Vec3 = [0.012, 0.016, 0.024];
/// The clay of the surface: linear RGB.
const ALBEDO: Vec3 = [0.78, 0.60, 0.42];

/// Normals of the corners, averaged over the triangles that meet there and weighted by their areas.
pub struct TeapotShader<'a> {
    mesh: &'a Mesh,
    normals: Vec<Vec3>,
}

impl<'a> TeapotShader<'a> {
    /// Prepares the normals.
    pub fn new(mesh: &'a Mesh) -> Self {
        let mut normals = vec![[0.0; 3]; mesh.positions().len()];
        for (corners, indices) in mesh.iter_corners().zip(mesh.triangles()) {
            let [a, b, c] = corners.map(|p| p.map(f64::from));
            let n = reference::cross(reference::sub(b, a), reference::sub(c, a));
            for &i in indices {
                let sum = &mut normals[i as usize];
                *sum = [sum[0] + n[0], sum[1] + n[1], sum[2] + n[2]];
            }
        }
        Self { mesh, normals: normals.into_iter().map(unit).collect() }
    }

    /// The picture of a batch of rays. `hits` holds the triangle of each ray, or none.
    pub fn picture(&self, rays: &RayBatch, hits: &[Option<u32>]) -> RgbImage {
        let pixel =
            |(ray, hit): (&Ray, &Option<u32>)| hit.map_or(BACKGROUND, |triangle| self.shade(ray, triangle)).map(encode);
        rgb8(rays.width(), rays.height(), rays.rays().iter().zip(hits).map(pixel))
    }

    fn shade(&self, ray: &Ray, triangle: u32) -> Vec3 {
        let (origin, direction) = (ray.origin().map(f64::from), ray.direction().map(f64::from));
        let Some(corners) = self.mesh.corners(triangle) else { return [1.0, 0.0, 1.0] };
        let crossing = reference::intersect(origin, direction, corners.map(|p| p.map(f64::from)));
        let weights = [crossing.w, crossing.u, crossing.v];
        // u belongs to b, v to c, w to a. Rays that miss the triangle they are said to hit are pulled onto its rim.
        let sign = if crossing.n_dot_d < 0.0 { 1.0 } else { -1.0 };
        let barycentric = area_weights(weights.map(|x| (x * sign).max(0.0)));
        let indices = self.mesh.triangles()[triangle as usize];
        let mut normal = [0.0; 3];
        for (weight, index) in barycentric.into_iter().zip(indices) {
            let corner = self.normals[index as usize];
            normal = [normal[0] + weight * corner[0], normal[1] + weight * corner[1], normal[2] + weight * corner[2]];
        }
        let normal = unit(normal);
        let view = unit(direction.map(|x| -x));
        light(if reference::dot(normal, view) < 0.0 { normal.map(|x| -x) } else { normal }, view)
    }
}

fn area_weights(w: Vec3) -> Vec3 {
    let sum = w[0] + w[1] + w[2];
    if sum > 0.0 { w.map(|x| x / sum) } else { [1.0 / 3.0; 3] }
}

/// A key light from above, a fill from the eye, and a highlight.
fn light(normal: Vec3, view: Vec3) -> Vec3 {
    let key = unit([-0.35, -0.55, 0.9]);
    let diffuse = 0.05 + 0.25 * reference::dot(normal, view).max(0.0) + 0.75 * reference::dot(normal, key).max(0.0);
    let half = unit([key[0] + view[0], key[1] + view[1], key[2] + view[2]]);
    let mut highlight = reference::dot(normal, half).max(0.0);
    for _ in 0..5 {
        highlight *= highlight; // to the 32nd power
    }
    ALBEDO.map(|a| a * diffuse + 0.25 * highlight)
}

fn unit(v: Vec3) -> Vec3 {
    let length = reference::dot(v, v).sqrt();
    if length > 0.0 { v.map(|x| x / length) } else { v }
}

/// Linear light to a byte by a curve of gamma 2. The study counts pixels whose bytes differ, so this curve is part of
/// its figures, and stays beside sRGB.
fn encode(linear: f64) -> u8 {
    (linear.clamp(0.0, 1.0).sqrt() * 255.0 + 0.5) as u8
}
