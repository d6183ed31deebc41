//! A bidirectional texture function b(u, e, d) as samples: a square patch, repeated over the surface, for each pair of
//! local directions of view and light.
//!
//! A sample is, per color channel, the radiance towards the view per radiance times solid angle from the light. It
//! includes the cosine at the surface and all shadows of the patch itself. (The paper leaves open where the cosine
//! belongs; transfer does not contain it.) Texel (row, column) has its center at u = (column + 1/2) / size, v = (row +
//! 1/2) / size of the texture coordinates; u runs along the tangent of the local frame, v along the bitangent.

use glam::DVec3;
use rayon::prelude::*;

use super::patch::{MesoPatch, SeenPoint};
use crate::bi_scale::directions::{LocalDirections, square};
use crate::error::{InputError, ensure, input_error};

/// b(u, e, d), sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct BidirectionalTexture {
    size: usize,
    light: LocalDirections,
    view: LocalDirections,
    samples: Vec<[f32; 3]>,
}

/// Largest size of samples that are made or read, in bytes (8 GiB).
pub(super) const MAX_BYTES: u64 = 1 << 33;

/// The number of samples of a texture. Fails with [`InputError`] for a size out of range, or for more samples than a
/// file holds.
fn sample_count(size: usize, view: &LocalDirections, light: &LocalDirections) -> Result<usize, InputError> {
    ensure!(
        (1..=BidirectionalTexture::MOST).contains(&size),
        "expected a patch of 1 to {} texels along an edge, found {size}",
        BidirectionalTexture::MOST
    );
    let [views, lights] = [view, light].map(|directions| directions.directions().len());
    let (count, most) = (views * lights * size * size, MAX_BYTES as usize / size_of::<[f32; 3]>());
    ensure!(
        count <= most,
        "expected at most {most} samples, found {count} ({views} views x {lights} lights x {size} x {size} texels)"
    );
    Ok(count)
}

/// The four samples around a place of a square grid, and their weights, which sum to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridSamples {
    /// Indices of the samples, row by row; at the rim of the views' square they repeat.
    pub numbers: [usize; 4],
    /// Bilinear weights.
    pub weights: [f64; 4],
}

impl BidirectionalTexture {
    /// Maximum number of texels along an edge of the patch.
    pub const MOST: usize = 1024;

    /// Creates a texture from samples, ordered by view, light, and texel row by row.
    pub fn new(
        size: usize,
        view: LocalDirections,
        light: LocalDirections,
        samples: Vec<[f32; 3]>,
    ) -> Result<Self, InputError> {
        let expected = sample_count(size, &view, &light)?;
        let [views, lights] = [&view, &light].map(|directions| directions.directions().len());
        if samples.len() != expected {
            let found = samples.len();
            return Err(input_error!(
                "expected {expected} samples ({views} views x {lights} lights x {size} x {size} texels), \
         found {found}"
            ));
        }
        let is_good = |sample: &[f32; 3]| sample.iter().all(|value| value.is_finite() && *value >= 0.0);
        if let Some(at) = samples.iter().position(|sample| !is_good(sample)) {
            let (texel, pair) = (at % (size * size), at / (size * size));
            return Err(input_error!(
                "expected finite samples of 0 or more, found another number at view {}, light {}, row {}, column {}",
                pair / lights,
                pair % lights,
                texel / size,
                texel % size
            ));
        }
        Ok(Self { size, light, view, samples })
    }

    /// Texels along an edge of the patch.
    pub fn size(&self) -> usize {
        self.size
    }

    /// The M directions of light, as in the rows of transfer.
    pub fn light(&self) -> &LocalDirections {
        &self.light
    }

    /// The directions of the view.
    pub fn view(&self) -> &LocalDirections {
        &self.view
    }

    /// All samples, in the order of [`Self::new`].
    pub fn samples(&self) -> &[[f32; 3]] {
        &self.samples
    }

    /// The patch under one light, seen from one view: rows of texels. Panics if there is no such view or light.
    pub fn patch(&self, view: usize, light: usize) -> &[[f32; 3]] {
        let lights = self.light.directions().len();
        assert!(light < lights, "light {light} of {lights}");
        let texels = self.size * self.size;
        &self.samples[(view * lights + light) * texels..][..texels]
    }
}

impl GridSamples {
    /// The views around a local direction, bilinear in the square that is mapped to the hemisphere (section V: "we map
    /// the view direction back" and take "the four adjacent samples"). At the square's rim, the horizon, the nearest
    /// samples are taken.
    pub fn of_view(view: &LocalDirections, direction: DVec3) -> Self {
        let side = view.side();
        let along = |at: f64| {
            let center = ((at + 1.0) / 2.0 * side as f64 - 0.5).clamp(0.0, (side - 1) as f64);
            let low = (center as usize).min(side - 1);
            (low, (low + 1).min(side - 1), center - low as f64)
        };
        Self::of(side, square(direction).map(along))
    }

    /// The texels around texture coordinates of a repeating patch of `size` x `size` texels, with centers at (texel +
    /// 1/2) / `size`.
    pub fn of_texels(size: usize, place: [f64; 2]) -> Self {
        let along = |at: f64| {
            let texels = (at - at.floor()) * size as f64 - 0.5;
            let low = texels.floor();
            // -1 is the last texel of the previous repetition.
            let index = (low as isize).rem_euclid(size.cast_signed()).cast_unsigned();
            (index, (index + 1) % size, texels - low)
        };
        Self::of(size, place.map(along))
    }

    fn of(side: usize, [(u0, u1, fu), (v0, v1, fv)]: [(usize, usize, f64); 2]) -> Self {
        Self {
            numbers: [v0 * side + u0, v0 * side + u1, v1 * side + u0, v1 * side + u1],
            weights: [(1.0 - fu) * (1.0 - fv), fu * (1.0 - fv), (1.0 - fu) * fv, fu * fv],
        }
    }
}

impl MesoPatch {
    /// Samples a patch at the centers of `size` x `size` texels for views and directions of light, with the same bits on
    /// any number of threads. `done` is called with the number of finished views and their total. Fails with
    /// [`InputError`] for a size out of range, or for more than 8 GiB of samples.
    pub fn texture(
        &self,
        size: usize,
        view: &LocalDirections,
        light: &LocalDirections,
        done: &mut dyn FnMut(usize, usize),
    ) -> Result<BidirectionalTexture, InputError> {
        let mut samples = vec![[0.0_f32; 3]; sample_count(size, view, light)?];
        let (views, lights, texels) = (view.directions(), light.directions(), size * size);
        let center = |texel: usize| [texel % size, texel / size].map(|at| (at as f64 + 0.5) / size as f64);
        let of_views = samples.chunks_exact_mut(lights.len() * texels).zip(views);
        for (number, (samples, &view)) in of_views.enumerate() {
            let points: Vec<SeenPoint> =
                (0..texels).into_par_iter().map(|texel| self.seen(center(texel), view)).collect();
            samples.par_chunks_exact_mut(texels).zip(lights).for_each(|(patch, &light)| {
                for (texel, seen) in patch.iter_mut().zip(&points) {
                    *texel = self.reflected(seen, light).map(|value| value as f32);
                }
            });
            done(number + 1, views.len());
        }
        BidirectionalTexture::new(size, view.clone(), light.clone(), samples)
    }
}
