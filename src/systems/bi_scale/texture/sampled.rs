//! Bidirectional textures of patches by rays: a sample per view, light and texel (section VI: 12 x 12 views, patches of
//! 64 x 64 or 32 x 32).

use rayon::prelude::*;

use super::patch::{MesoPatch, SeenPoint};
use super::response::BidirectionalTexture;
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::texture::response::size_error;
use crate::error::InputError;

/// Options of sampling a patch.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureSampling {
    /// Texels along an edge of the texture.
    pub size: usize,
    /// The views.
    pub view: LocalDirections,
    /// The M directions of light.
    pub light: LocalDirections,
    /// n x n points per texel, of which the mean is taken; with 1 its middle.
    pub samples: usize,
}

impl MesoPatch {
    /// The texture of a patch, with the same bits on any number of threads. `done` is called with the number of
    /// finished views and their total.
    ///
    /// # Errors
    /// [`InputError`].
    ///
    /// # Panics
    /// If there are no samples per texel.
    pub fn texture(
        &self,
        sampling: &TextureSampling,
        done: &mut dyn FnMut(usize, usize),
    ) -> Result<BidirectionalTexture, InputError> {
        let TextureSampling { size, view, light, samples: fine } = sampling;
        assert!(*fine > 0, "a sample in a texel");
        if !(1..=BidirectionalTexture::MOST).contains(size) {
            return Err(size_error(*size));
        }
        let (lights, texels) = (light.directions(), size * size);
        let mut samples = vec![[0.0_f32; 3]; view.directions().len() * lights.len() * texels];
        let of_views = samples.chunks_exact_mut(lights.len() * texels).zip(view.directions());
        for (number, (samples, &view)) in of_views.enumerate() {
            let points: Vec<SeenPoint> =
                (0..texels * fine * fine).into_par_iter().map(|at| self.seen(place(at, *size, *fine), view)).collect();
            samples.par_chunks_exact_mut(texels).zip(lights).for_each(|(patch, &light)| {
                for (texel, points) in patch.iter_mut().zip(points.chunks_exact(fine * fine)) {
                    *texel = mean(points.iter().map(|seen| self.reflected(seen, light)), fine * fine);
                }
            });
            done(number + 1, sampling.view.directions().len());
        }
        BidirectionalTexture::new(*size, view.clone(), light.clone(), samples)
    }
}

/// The texture coordinates of a point: texel by texel, in a texel row by row.
fn place(at: usize, size: usize, fine: usize) -> [f64; 2] {
    let (texel, point) = (at / (fine * fine), at % (fine * fine));
    let along = |texel: usize, point: usize| (texel as f64 + (point as f64 + 0.5) / fine as f64) / size as f64;
    [along(texel % size, point % fine), along(texel / size, point / fine)]
}

fn mean(values: impl Iterator<Item = [f64; 3]>, count: usize) -> [f32; 3] {
    let mut sum = [0.0; 3];
    for value in values {
        (0..3).for_each(|channel| sum[channel] += value[channel]);
    }
    sum.map(|sum| (sum / count as f64) as f32)
}
