//! Equation 3 for many pixels: the texture laid out so that all directions of light of a texel are adjacent, and pixels
//! in parallel. Sums have the order of the reference, so that the bits are equal, on any number of threads.

use rayon::prelude::*;

use super::pixel::{ShadedPixel, TexelSamples};
use crate::bi_scale::texture::{BidirectionalTexture, ViewSamples};

/// A texture laid out for shading.
#[derive(Clone, Debug)]
pub struct TextureLookup {
    size: usize,
    view: crate::bi_scale::directions::LocalDirections,
    lights: usize,
    /// View by view, texel by texel, light by light.
    samples: Vec<[f32; 3]>,
}

impl TextureLookup {
    /// Lays a texture out.
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

    /// The number M of directions of light.
    pub fn lights(&self) -> usize {
        self.lights
    }

    /// Equation 3 for a pixel: [`reference::radiance`](super::reference::radiance). `b` is scratch memory for M
    /// samples.
    ///
    /// # Panics
    /// If a corner has no row.
    pub fn radiance(&self, local: &[[f64; 3]], pixel: &ShadedPixel, b: &mut Vec<[f64; 3]>) -> [f64; 3] {
        b.clear();
        b.resize(self.lights, [0.0; 3]);
        let views = ViewSamples::around(&self.view, pixel.view);
        let texels = TexelSamples::around(self.size, pixel.place);
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
