//! Pictures of vertex colors, interpolated over triangles.

use glam::DVec3;
use rayon::prelude::*;

use crate::card::SeenPixel;
use crate::geom::exact::Sides;
use crate::geom::vector::wide;
use crate::geom::{Hit, Mesh};
use crate::scene::Camera;
use crate::tracer::HostTracer;
use crate::transfer::Vertices;
use crate::transfer::brdf::ExitBasis;

/// The surface point at each pixel: corners of a triangle and weights with sum 1, or `None`.
pub(in crate::study) struct SeenSurface {
    pixels: Vec<Option<([u32; 3], DVec3)>>,
}

impl SeenSurface {
    /// Casts a camera's rays, front faces only.
    pub(in crate::study) fn new(mesh: &Mesh, vertices: &Vertices, camera: &Camera) -> Self {
        Self::of_parts([(mesh, vertices)], camera)
    }

    /// Uses the surface points that a device's rasterizer produced.
    pub(super) fn by_raster(pixels: &[Option<SeenPixel>]) -> Self {
        let pixel = |pixel: &SeenPixel| (pixel.corners, DVec3::from(pixel.weights));
        Self { pixels: pixels.iter().map(|seen| seen.as_ref().map(pixel)).collect() }
    }

    /// Finds the nearest of several meshes; vertex indices continue from mesh to mesh.
    pub(super) fn of_parts<'a>(parts: impl IntoIterator<Item = (&'a Mesh, &'a Vertices)>, camera: &Camera) -> Self {
        let rays = camera.rays();
        let mut nearest: Vec<Option<(f32, [u32; 3], DVec3)>> = vec![None; rays.len()];
        let mut first = 0;
        for (mesh, vertices) in parts {
            let (hits, _) = HostTracer::new(mesh, Sides::Front).nearest_all(&rays);
            nearest.par_iter_mut().zip(&rays).zip(&hits).for_each(|((nearest, ray), hit)| {
                let is_nearer = |hit: &&Hit| nearest.is_none_or(|(before, ..)| hit.t < before);
                let Some(hit) = hit.as_ref().filter(is_nearer) else { return };
                let corners = vertices.triangles()[hit.triangle as usize];
                let places = corners.map(|corner| wide(vertices.positions()[corner as usize]));
                let at = wide(ray.origin()) + f64::from(hit.t) * wide(ray.direction());
                *nearest = Some((hit.t, corners.map(|corner| corner + first), weights(at, places)));
            });
            first += vertices.len() as u32;
        }
        let pixels = nearest.into_iter().map(|pixel| pixel.map(|(_, corners, weights)| (corners, weights)));
        Self { pixels: pixels.collect() }
    }

    /// Number of pixels that show the model.
    pub(super) fn count(&self) -> usize {
        self.pixels.iter().flatten().count()
    }

    /// Colors of vertices, interpolated; `background` where no surface is visible.
    pub(in crate::study) fn colors(&self, of_vertex: &[[f64; 3]], background: [f64; 3]) -> Vec<[f64; 3]> {
        let color = |pixel: &Option<([u32; 3], DVec3)>| {
            let Some((corners, weights)) = pixel else { return background };
            let mix = |channel: usize| (0..3).map(|i| weights[i] * of_vertex[corners[i] as usize][channel]).sum();
            [0, 1, 2].map(mix)
        };
        self.pixels.par_iter().map(color).collect()
    }

    /// Radiance of each pixel: exit coefficients towards the view vector, both interpolated as on a card, but without
    /// rounding.
    pub(super) fn radiance(&self, exit: &[Vec<[f64; 3]>], view: &[DVec3], basis: &ExitBasis) -> Vec<[f64; 3]> {
        let color = |pixel: &Option<([u32; 3], DVec3)>| {
            let Some((corners, weights)) = pixel else { return [0.0; 3] };
            let parts = || corners.iter().zip(weights.to_array());
            let towards = parts().map(|(&corner, weight)| weight * view[corner as usize]).sum::<DVec3>();
            let mut y = vec![0.0; exit[corners[0] as usize].len()];
            basis.values(towards.normalize_or_zero(), &mut y);
            let of = |row: usize, channel: usize| -> f64 {
                parts().map(|(&corner, weight)| weight * exit[corner as usize][row][channel]).sum()
            };
            [0, 1, 2].map(|channel| y.iter().enumerate().map(|(row, y)| y * of(row, channel)).sum())
        };
        self.pixels.par_iter().map(color).collect()
    }

    /// The vertex with the largest weight at each pixel.
    pub(in crate::study) fn nearest(&self) -> impl Iterator<Item = Option<u32>> + '_ {
        self.pixels.iter().map(|pixel| pixel.map(|(corners, weights)| corners[weights.max_position()]))
    }
}

/// Barycentric weights of a point in a triangle's plane; clamped to the edge if rounding moves it outside.
pub(super) fn weights(at: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let normal = (b - a).cross(c - a);
    let opposite = |from: DVec3, to: DVec3| (from - at).cross(to - at).dot(normal).max(0.0);
    let areas = DVec3::new(opposite(b, c), opposite(c, a), opposite(a, b));
    let sum = areas.element_sum();
    if sum > 0.0 { areas / sum } else { DVec3::splat(1.0 / 3.0) }
}
