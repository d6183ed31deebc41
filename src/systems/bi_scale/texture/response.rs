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
use crate::error::{InputError, input_error};

/// b(u, e, d), sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct BidirectionalTexture {
    size: usize,
    light: LocalDirections,
    view: LocalDirections,
    samples: Vec<[f32; 3]>,
}

pub(super) fn size_error(found: usize) -> InputError {
    input_error!("expected a patch of 1 to {} texels along an edge, found {found}", BidirectionalTexture::MOST)
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
        if !(1..=Self::MOST).contains(&size) {
            return Err(size_error(size));
        }
        let [views, lights] = [&view, &light].map(|directions| directions.directions().len());
        let expected = views * lights * size * size;
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

/// Options of sampling a patch.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureSampling {
    /// Texels along an edge of the texture.
    pub size: usize,
    /// The views.
    pub view: LocalDirections,
    /// The M directions of light.
    pub light: LocalDirections,
    /// Number n: a texel is the mean over n x n points, or its middle if n is 1.
    pub samples: usize,
}

impl MesoPatch {
    /// Samples a patch into a texture, with the same bits on any number of threads. `done` is called with the number of
    /// finished views and their total. Panics if there are no samples per texel.
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

/// The texture coordinates of point `at`; points are ordered by texel, then row by row within the texel.
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
