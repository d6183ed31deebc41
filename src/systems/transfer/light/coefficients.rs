//! A light's Haar coefficients.

use super::cube_light::CubeLight;
use crate::transfer::grid::{LIGHT_TEXELS, Segmentation};
use crate::transfer::haar::Haar;

/// The vector L of a light: Haar coefficients of each segment's texels, for red, green and blue.
///
/// Coefficient c of segment s has the number s n + c, n texels per segment. The basis is orthonormal over texels, not
/// over the sphere: texels differ in solid angle. Solid angles are in the transfer.
#[derive(Clone, Debug, PartialEq)]
pub struct HaarLight {
    segmentation: Segmentation,
    channels: [Vec<f64>; 3],
}

impl HaarLight {
    /// The coefficients of a light.
    pub fn new(light: &CubeLight, segmentation: Segmentation) -> Self {
        let mut haar = Haar::new(segmentation.side());
        let channels = [0, 1, 2].map(|channel| {
            let mut values: Vec<f64> = (0..LIGHT_TEXELS)
                .map(|at| segmentation.texel(at / segmentation.len(), at % segmentation.len()))
                .map(|texel| light.texels()[texel][channel])
                .collect();
            values.chunks_exact_mut(segmentation.len()).for_each(|square| haar.forward(square));
            values
        });
        Self { segmentation, channels }
    }

    pub(super) const fn of_channels(segmentation: Segmentation, channels: [Vec<f64>; 3]) -> Self {
        Self { segmentation, channels }
    }

    /// The segments that the coefficients are of.
    pub const fn segmentation(&self) -> Segmentation {
        self.segmentation
    }

    /// The coefficients of red, green and blue.
    pub const fn channels(&self) -> &[Vec<f64>; 3] {
        &self.channels
    }

    /// [`Self::coefficients`] in single precision, as rendering takes them.
    pub fn singles(&self) -> Vec<[f32; 3]> {
        self.coefficients().into_iter().map(|rgb| rgb.map(|value| value as f32)).collect()
    }

    /// All coefficients, segment by segment, each with its three channels.
    pub fn coefficients(&self) -> Vec<[f64; 3]> {
        (0..LIGHT_TEXELS).map(|at| self.channels.each_ref().map(|channel| channel[at])).collect()
    }

    /// The coefficients of a segment in a channel.
    ///
    /// # Panics
    /// If there is no such channel or segment.
    pub fn segment(&self, channel: usize, segment: usize) -> &[f64] {
        let len = self.segmentation.len();
        &self.channels[channel][segment * len..(segment + 1) * len]
    }

    /// The radiances of the light with these coefficients, by texel number. Truncated ones may be negative.
    pub fn radiances(&self) -> Vec<[f64; 3]> {
        let (mut haar, len) = (Haar::new(self.segmentation.side()), self.segmentation.len());
        let squares = self.channels.each_ref().map(|channel| {
            let mut values = channel.clone();
            values.chunks_exact_mut(len).for_each(|square| haar.inverse(square));
            values
        });
        let at = |texel| {
            let [segment, place] = self.segmentation.place(texel);
            segment * len + place
        };
        (0..LIGHT_TEXELS).map(at).map(|at| squares.each_ref().map(|channel| channel[at])).collect()
    }

    /// The coefficients of the same light in other segments, as in Figure 6 for a truncated light of six faces.
    #[must_use]
    pub fn reprojected(&self, segmentation: Segmentation) -> Self {
        let radiances = self.radiances();
        let mut haar = Haar::new(segmentation.side());
        let channels = [0, 1, 2].map(|channel| {
            let texel = |at| segmentation.texel(at / segmentation.len(), at % segmentation.len());
            let mut values: Vec<f64> = (0..LIGHT_TEXELS).map(|at| radiances[texel(at)][channel]).collect();
            values.chunks_exact_mut(segmentation.len()).for_each(|square| haar.forward(square));
            values
        });
        Self { segmentation, channels }
    }

    /// Coefficients that are not 0 in at least one channel.
    pub fn nonzero(&self) -> usize {
        (0..LIGHT_TEXELS).filter(|&at| self.channels.iter().any(|channel| channel[at] != 0.0)).count()
    }

    /// The sum of the squares of all coefficients: that of the texels' radiances.
    pub fn energy(&self) -> f64 {
        (0..LIGHT_TEXELS).map(|at| self.energy_at(at)).sum()
    }

    /// The sum over the channels of the square of a coefficient.
    pub(super) fn energy_at(&self, at: usize) -> f64 {
        self.channels.iter().map(|channel| channel[at] * channel[at]).sum()
    }
}
