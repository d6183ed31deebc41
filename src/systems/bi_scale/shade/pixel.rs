//! Inputs of equation 3 for a pixel, and a fast evaluation of equation 3 with a texture in which all directions of
//! light of a texel are adjacent. Sums have the order of [`paper`](crate::bi_scale::paper), so bits are equal on any
//! number of threads.

use glam::DVec3;
use rayon::prelude::*;

use crate::bi_scale::texture::{BidirectionalTexture, GridSamples};
use crate::transfer::{LocalFrame, Vertices};

/// A pixel that shows a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadedPixel {
    /// The vertices of the triangle.
    pub corners: [u32; 3],
    /// Their barycentric weights, which sum to 1.
    pub weights: [f64; 3],
    /// Texture coordinates u; the patch has length 1.
    pub place: [f64; 2],
    /// Direction e to the eye in the pixel's local frame, of length 1.
    pub view: DVec3,
}

/// The local frame of a pixel: normals and tangents of the vertices, interpolated and orthonormalised. If they cancel,
/// the result is the frame of the vertex with the largest weight.
pub fn pixel_frame(vertices: &Vertices, corners: [u32; 3], weights: [f64; 3]) -> LocalFrame {
    let frames = corners.map(|corner| vertices.frames()[corner as usize]);
    let mix = |axis: fn(&LocalFrame) -> DVec3| -> DVec3 {
        frames.iter().zip(weights).fold(DVec3::ZERO, |sum, (frame, weight)| sum + weight * axis(frame))
    };
    let (normal, tangent) = (mix(LocalFrame::normal), mix(LocalFrame::tangent));
    let heaviest = (1..3).fold(0, |most, at| if weights[at] > weights[most] { at } else { most });
    let frame = crate::geom::vector::unit(normal).and_then(|normal| LocalFrame::new(normal, tangent));
    frame.unwrap_or(frames[heaviest])
}

/// A texture laid out for shading.
#[derive(Clone, Debug)]
pub struct TextureLookup {
    size: usize,
    view: crate::bi_scale::directions::LocalDirections,
    lights: usize,
    /// Samples ordered by view, texel, and light.
    samples: Vec<[f32; 3]>,
}

impl TextureLookup {
    /// Lays out a texture for shading.
    pub fn new(texture: &BidirectionalTexture) -> Self {
        let lights = texture.light().directions().len();
        let (size, texels) = (texture.size(), texture.size() * texture.size());
        let mut samples = vec![[0.0; 3]; texture.samples().len()];
        samples
            .par_chunks_exact_mut(lights * texels)
            .zip(texture.samples().par_chunks_exact(lights * texels))
            .for_each(|(into, of_view)| {
                for (light, patch) in of_view.chunks_exact(texels).enumerate() {
                    into[light..].iter_mut().step_by(lights).zip(patch).for_each(|(into, &sample)| *into = sample);
                }
            });
        Self { size, view: texture.view().clone(), lights, samples }
    }

    /// Equation 3 for a pixel: [`paper::radiance`](crate::bi_scale::paper::radiance). `b` is scratch memory for M
    /// samples. Panics if a corner has no row.
    pub fn radiance(&self, local: &[[f64; 3]], pixel: &ShadedPixel, b: &mut Vec<[f64; 3]>) -> [f64; 3] {
        b.clear();
        b.resize(self.lights, [0.0; 3]);
        let views = GridSamples::of_view(&self.view, pixel.view);
        let texels = GridSamples::of_texels(self.size, pixel.place);
        for (view, of_view) in views.numbers.into_iter().zip(views.weights) {
            for (texel, of_texel) in texels.numbers.into_iter().zip(texels.weights) {
                let weight = of_view * of_texel;
                let samples = &self.samples[(view * self.size * self.size + texel) * self.lights..][..self.lights];
                for (b, sample) in b.iter_mut().zip(samples) {
                    (0..3).for_each(|channel| b[channel] += weight * f64::from(sample[channel]));
                }
            }
        }
        let rows = pixel.corners.map(|corner| &local[corner as usize * self.lights..][..self.lights]);
        let mut radiance = [0.0; 3];
        for (light, b) in b.iter().enumerate() {
            for channel in 0..3 {
                let mut arriving = 0.0;
                for (row, weight) in rows.iter().zip(pixel.weights) {
                    arriving += weight * row[light][channel];
                }
                radiance[channel] += b[channel] * arriving;
            }
        }
        radiance
    }
}
