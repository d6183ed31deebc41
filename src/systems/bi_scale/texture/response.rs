//! A bidirectional texture function b(u, e, d) as samples: a square patch, repeated over the surface, for each of the
//! view's and each of the light's local directions.
//!
//! A sample is the radiance that leaves towards the view per radiance times solid angle that comes from the light, per
//! color channel: the cosine at the surface and all shadows of the patch itself are in it (the paper leaves open where
//! the cosine stands; transfer holds none). Texel (row, column) has its center at u = (column + 1/2) / size,
//! v = (row + 1/2) / size of the texture coordinates; u runs along the tangent of the local frame, v along the
//! bitangent.

use glam::DVec3;

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

/// The four samples of the view around a direction, and their weights, which sum to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewSamples {
    /// Numbers of the view's directions; equal ones at the square's rim.
    pub numbers: [usize; 4],
    /// Bilinear weights in the square.
    pub weights: [f64; 4],
}

impl BidirectionalTexture {
    /// The most texels along an edge of the patch.
    pub const MOST: usize = 1024;

    /// A texture of samples: view by view, in a view light by light, then row by row.
    ///
    /// # Errors
    /// [`InputError`].
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
                "expected samples of 0 or more, finite ones; found another at view {}, light {}, row {}, column {}",
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

    /// The M directions of light, which are those of the rows of transfer.
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

    /// The patch under one light, seen from one view: rows of texels.
    ///
    /// # Panics
    /// If there is no such view or light.
    pub fn patch(&self, view: usize, light: usize) -> &[[f32; 3]] {
        let lights = self.light.directions().len();
        assert!(light < lights, "light {light} of {lights}");
        let texels = self.size * self.size;
        &self.samples[(view * lights + light) * texels..][..texels]
    }
}

impl ViewSamples {
    /// The samples around a local direction, bilinear in the square that the hemisphere is mapped from (section V: "we
    /// map the view direction back" and take "the four adjacent samples"); at the square's rim, the horizon, the
    /// nearest ones.
    pub fn around(view: &LocalDirections, direction: DVec3) -> Self {
        let side = view.side();
        let [across, down] = square(direction).map(|at| {
            let center = ((at + 1.0) / 2.0 * side as f64 - 0.5).clamp(0.0, (side - 1) as f64);
            let low = (center as usize).min(side - 1);
            (low, (low + 1).min(side - 1), center - low as f64)
        });
        let ((u0, u1, fu), (v0, v1, fv)) = (across, down);
        Self {
            numbers: [v0 * side + u0, v0 * side + u1, v1 * side + u0, v1 * side + u1],
            weights: [(1.0 - fu) * (1.0 - fv), fu * (1.0 - fv), (1.0 - fu) * fv, fu * fv],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    fn directions(side: usize) -> LocalDirections {
        LocalDirections::new(side).unwrap()
    }

    #[test]
    fn samples_stand_where_their_numbers_say() {
        let samples: Vec<[f32; 3]> = (0..4 * 9 * 25).map(|at| [at as f32; 3]).collect();
        let texture = BidirectionalTexture::new(5, directions(2), directions(3), samples).unwrap();
        assert_eq!(texture.patch(3, 7)[2 * 5 + 4], [((3 * 9 + 7) * 25 + 14) as f32; 3]);
    }

    #[test]
    fn what_is_no_texture_is_refused() {
        let of = |size, count, value: f32| {
            BidirectionalTexture::new(size, directions(1), directions(2), vec![[value; 3]; count]).unwrap_err()
        };
        let text = [of(0, 0, 1.0), of(2, 15, 1.0), of(2, 16, -1.0), of(2, 16, f32::NAN)].map(|error| error.to_string());
        insta::assert_snapshot!(text.join("\n"), @"
        expected a patch of 1 to 1024 texels along an edge, found 0
        expected 16 samples (1 views x 4 lights x 2 x 2 texels), found 15
        expected samples of 0 or more, finite ones; found another at view 0, light 0, row 0, column 0
        expected samples of 0 or more, finite ones; found another at view 0, light 0, row 0, column 0
        ");
    }

    #[test]
    fn a_center_has_its_own_sample_alone_and_weights_sum_to_1() {
        let view = directions(12);
        for (number, &direction) in view.directions().iter().enumerate() {
            let found = ViewSamples::around(&view, direction);
            let own: f64 = found.numbers.iter().zip(found.weights).filter(|(n, _)| **n == number).map(|(_, w)| w).sum();
            assert_abs_diff_eq!(own, 1.0, epsilon = 1e-6);
            assert_abs_diff_eq!(found.weights.iter().sum::<f64>(), 1.0, epsilon = 1e-12);
        }
        let horizon = ViewSamples::around(&view, DVec3::new(1.0, 0.0, -0.5).normalize());
        assert!(horizon.numbers.iter().all(|number| number % 12 == 11));
        assert_eq!(ViewSamples::around(&directions(1), DVec3::Z).numbers, [0; 4]);
    }
}
