//! A light's Haar coefficients, and the few that matter most (section 6; \[NRH03\]'s "non-linear" approximation).

use super::cube_light::CubeLight;
use crate::transfer::grid::{FineDirections, LIGHT_TEXELS, Segmentation, light_texel};
use crate::transfer::haar::Haar;

/// The vector L of a light: Haar coefficients of each segment's texels, for red, green and blue.
///
/// Coefficient c of segment s has the index s n + c, with n texels per segment. The basis is orthonormal over texels,
/// not over the sphere, because texels differ in solid angle. The transfer includes solid angles.
#[derive(Clone, Debug, PartialEq)]
pub struct HaarLight {
    segmentation: Segmentation,
    channels: [Vec<f64>; 3],
}

impl HaarLight {
    /// The coefficients of a light.
    pub fn new(light: &CubeLight, segmentation: Segmentation) -> Self {
        Self::of_radiances(light.texels(), segmentation)
    }

    fn of_radiances(radiances: &[[f64; 3]], segmentation: Segmentation) -> Self {
        let mut haar = Haar::new(segmentation.side());
        let channels = [0, 1, 2].map(|channel| {
            let texel = |at| segmentation.texel(at / segmentation.len(), at % segmentation.len());
            let mut values: Vec<f64> = (0..LIGHT_TEXELS).map(|at| radiances[texel(at)][channel]).collect();
            values.chunks_exact_mut(segmentation.len()).for_each(|square| haar.forward(square));
            values
        });
        Self { segmentation, channels }
    }

    /// The segments of the coefficients.
    pub const fn segmentation(&self) -> Segmentation {
        self.segmentation
    }

    /// The coefficients of red, green and blue.
    pub const fn channels(&self) -> &[Vec<f64>; 3] {
        &self.channels
    }

    /// [`Self::coefficients`] in single precision, for rendering.
    pub fn singles(&self) -> Vec<[f32; 3]> {
        self.coefficients().into_iter().map(|rgb| rgb.map(|value| value as f32)).collect()
    }

    /// All coefficients, segment by segment, each with its three channels.
    pub fn coefficients(&self) -> Vec<[f64; 3]> {
        (0..LIGHT_TEXELS).map(|at| self.channels.each_ref().map(|channel| channel[at])).collect()
    }

    /// The coefficients of a segment in a channel. Panics if there is no such channel or segment.
    pub fn segment(&self, channel: usize, segment: usize) -> &[f64] {
        let len = self.segmentation.len();
        &self.channels[channel][segment * len..(segment + 1) * len]
    }

    /// The light's radiances by texel index; truncated light may be negative.
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

    /// The coefficients of this light in other segments, as in Figure 6 for a truncated light of six faces.
    #[must_use]
    pub fn reprojected(&self, segmentation: Segmentation) -> Self {
        Self::of_radiances(&self.radiances(), segmentation)
    }

    /// Number of coefficients that are not 0 in at least one channel.
    pub fn nonzero(&self) -> usize {
        (0..LIGHT_TEXELS).filter(|&at| self.channels.iter().any(|channel| channel[at] != 0.0)).count()
    }

    /// The sum of the squares of all coefficients, which equals the sum over the texels' radiances.
    pub fn energy(&self) -> f64 {
        (0..LIGHT_TEXELS).map(|at| self.energy_at(at)).sum()
    }

    /// The sum over the channels of the square of a coefficient.
    pub(super) fn energy_at(&self, at: usize) -> f64 {
        self.channels.iter().map(|channel| channel[at] * channel[at]).sum()
    }
}

/// Criterion by which coefficients are chosen, as in \[NRH03\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum TruncationPriority {
    /// Magnitude of the coefficient.
    #[default]
    Magnitude,
    /// Magnitude times the solid angle of the basis function's support.
    Area,
}

/// A truncated light and the kept energy.
#[derive(Clone, Debug, PartialEq)]
pub struct LightTruncation {
    /// The light, with dropped coefficients set to 0.
    pub light: HaarLight,
    /// Number of non-zero coefficients of the whole light.
    pub nonzero: usize,
    /// Number of kept coefficients; lower than requested if the light has fewer.
    pub kept: usize,
    /// The energy of the whole light.
    pub energy: f64,
    /// The fraction of the energy that is kept, in [0, 1]; 1 for a black light.
    pub kept_energy: f64,
}

impl HaarLight {
    /// The light with at most `keep` coefficients. A coefficient is kept in all three channels or in none; its
    /// magnitude is the root of the sum of the channels' squares, so that all channels have the same zeros. Among equal
    /// priorities the lowest index is kept.
    pub fn truncated(&self, keep: usize, priority: TruncationPriority) -> LightTruncation {
        let weights = match priority {
            TruncationPriority::Magnitude => vec![1.0; LIGHT_TEXELS],
            TruncationPriority::Area => support_areas(self.segmentation()),
        };
        let mut order: Vec<(f64, usize)> = (0..LIGHT_TEXELS)
            .filter(|&at| self.energy_at(at) != 0.0)
            .map(|at| (self.energy_at(at).sqrt() * weights[at], at))
            .collect();
        let nonzero = order.len();
        order.sort_by(|(a, at), (b, other)| b.total_cmp(a).then(at.cmp(other)));
        order.truncate(keep);
        let mut channels = [0, 1, 2].map(|_| vec![0.0; LIGHT_TEXELS]);
        for &(_, at) in &order {
            channels.iter_mut().zip(self.channels()).for_each(|(into, from)| into[at] = from[at]);
        }
        let light = Self { segmentation: self.segmentation, channels };
        let (energy, kept) = (self.energy(), light.energy());
        let kept_energy = if energy > 0.0 { kept / energy } else { 1.0 };
        LightTruncation { light, nonzero, kept: order.len(), energy, kept_energy }
    }
}

/// The solid angle of each basis function's support.
fn support_areas(segmentation: Segmentation) -> Vec<f64> {
    let mut texels = vec![0.0; LIGHT_TEXELS];
    for (fine, solid_angle) in FineDirections::get().solid_angles().iter().enumerate() {
        texels[light_texel(fine)] += solid_angle;
    }
    let (haar, side, len) = (Haar::new(segmentation.side()), segmentation.side(), segmentation.len());
    let area = |at: usize| {
        let support = haar.support(at % len);
        let rows = support.row..support.row + support.side;
        let places = rows.flat_map(|row| (support.column..support.column + support.side).map(move |c| row * side + c));
        places.map(|place| texels[segmentation.texel(at / len, place)]).sum()
    };
    (0..LIGHT_TEXELS).map(area).collect()
}
