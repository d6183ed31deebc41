//! Links encoded as texels of textures, for pass 2 on the card.
//!
//! The card's map contains E_t a_t / (mean texel area of the atlas), so that unweighted means of its levels are
//! weighted by area. The factor of a link to cluster C is stored as F_iC times (mean texel area of the atlas) / (mean
//! texel area of C). If the map contains irradiance ([`MeanWeighting::Count`]), the stored factor is F_iC.
//!
//! | choice, channels | textures | a texel |
//! |---|---|---|
//! | fixed, 1 | L / 4 | factors of links 4 k to 4 k + 3 |
//! | fixed, 3 | 3 L / 4 | texture 3 k + c: factors of channel c of links 4 k to 4 k + 3 |
//! | adaptive, 1 | L | u, v, factor, level |
//! | adaptive, 3 | 2 L | texture 2 k: u, v, red factor, level; texture 2 k + 1: red, green, blue factor, 0 |
//!
//! If L is not a multiple of 4, the last texels are padded with factors 0. A place (u, v) is the cluster's center in
//! the atlas, whose sides are 1.

use refsim::num::{Format, FormatKind, ops, power_of_two};

use super::super::multipole::{ClusterId, SurfaceMoments};
use super::{LinkChoice, Links, MeanWeighting};
use crate::card::Texels;

/// Place in the map that is read for a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkPlace {
    /// The center of the cluster, from 0 to 1.
    pub u: f32,
    /// The center of the cluster, from 0 to 1.
    pub v: f32,
    /// The cluster's level.
    pub level: f32,
}

impl LinkPlace {
    /// The place of a cluster in an atlas with `side` texels per side. It is exact in fp32, and in fp16, which has 11
    /// bits, up to 1024 texels per side (odd multiples of 1/2048). At 2048, some texel centers beyond 1/2 are rounded.
    pub fn new(side: u32, ClusterId { level, y, x }: ClusterId) -> Self {
        let center = |at: u32| ((2 * at + 1) as f64 / (2 * (side >> level)) as f64) as f32;
        Self { u: center(x), v: center(y), level: level as f32 }
    }
}

/// Counts of factors and places that a format cannot represent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LostFactors {
    /// Number of factors of used links, which are above 0.
    pub factors: usize,
    /// Number of factors that round to 0.
    pub flushed: usize,
    /// Number of denormal factors, which a card may flush to 0.
    pub denormal: usize,
    /// Number of adaptive links with a rounded coordinate.
    pub places: usize,
}

/// Links with the factors that a card stores, texture by texture.
#[derive(Clone, Copy, Debug)]
pub struct EncodedLinks<'a> {
    links: &'a Links,
    surface: &'a SurfaceMoments,
    weighting: MeanWeighting,
}

impl<'a> EncodedLinks<'a> {
    /// Encodes links for a map whose unweighted means weigh texels by `weighting`.
    pub fn new(links: &'a Links, surface: &'a SurfaceMoments, weighting: MeanWeighting) -> Self {
        Self { links, surface, weighting }
    }

    /// The number of textures.
    pub fn texture_count(&self) -> usize {
        let is_fixed = matches!(self.links.choice(), LinkChoice::Fixed { .. });
        link_textures(is_fixed, self.links.channels() == 3, self.links.per_texel())
    }

    /// A texture before rounding to its format. Panics if there is no such texture.
    pub fn texture(&self, index: usize) -> Texels {
        assert!(index < self.texture_count(), "there is no texture {index}");
        let side = self.links.side() as usize;
        let texel = |x: usize, y: usize| match self.links.choice() {
            LinkChoice::Fixed { .. } => self.four_factors(x, y, index),
            LinkChoice::Adaptive { .. } => self.one_link(x, y, index),
        };
        Texels::from_fn([side, side], texel)
    }

    fn four_factors(&self, x: usize, y: usize, index: usize) -> [f32; 4] {
        let channels = self.links.channels();
        let [group, channel] = [index / channels, index % channels];
        let mut links = self.links.of([x as u32, y as u32]).skip(4 * group);
        std::array::from_fn(|_| links.next().map_or(0.0, |(cluster, factors)| self.stored(cluster, factors[channel])))
    }

    fn one_link(&self, x: usize, y: usize, index: usize) -> [f32; 4] {
        let channels = self.links.channels();
        let link = if channels == 1 { index } else { index / 2 };
        let Some((cluster, factors)) = self.links.of([x as u32, y as u32]).nth(link) else { return [0.0; 4] };
        if channels == 3 && index % 2 == 1 {
            let [red, green, blue] = [0, 1, 2].map(|channel| self.stored(cluster, factors[channel]));
            return [red, green, blue, 0.0];
        }
        let LinkPlace { u, v, level } = LinkPlace::new(self.links.side(), cluster);
        [u, v, self.stored(cluster, factors[0]), level]
    }

    /// The factor as the card stores it.
    fn stored(&self, cluster: ClusterId, factor: f32) -> f32 {
        match self.weighting {
            MeanWeighting::Area => (f64::from(factor) * self.surface.area_ratio(cluster)) as f32,
            MeanWeighting::Count => factor,
        }
    }

    /// Counts of factors and places that a format cannot represent.
    pub fn lost(&self, format: Format) -> LostFactors {
        let mut lost = LostFactors::default();
        let least_normal = least_normal(format);
        let side = self.links.side();
        let is_adaptive = matches!(self.links.choice(), LinkChoice::Adaptive { .. });
        let is_rounded = |at: f32| {
            let stored = ops::convert(&Format::FP32, format, at.to_bits()).bits;
            ops::convert(&format, Format::FP32, stored).bits != at.to_bits()
        };
        for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
            for (cluster, factors) in self.links.of([x, y]) {
                if is_adaptive && factors.iter().any(|factor| *factor > 0.0) {
                    let LinkPlace { u, v, .. } = LinkPlace::new(side, cluster);
                    lost.places += usize::from(is_rounded(u) || is_rounded(v));
                }
                for &factor in factors.iter().filter(|factor| **factor > 0.0) {
                    let stored = self.stored(cluster, factor);
                    let bits = ops::convert(&Format::FP32, format, stored.to_bits()).bits;
                    lost.factors += 1;
                    lost.flushed += usize::from(bits == 0);
                    lost.denormal += usize::from(bits != 0 && f64::from(stored) < least_normal);
                }
            }
        }
        lost
    }
}

/// The number of textures of `links` links per texel.
pub(in crate::subsurface) fn link_textures(is_fixed: bool, rgb: bool, links: usize) -> usize {
    if is_fixed { links.div_ceil(4) * if rgb { 3 } else { 1 } } else { links * if rgb { 2 } else { 1 } }
}

fn least_normal(format: Format) -> f64 {
    match format.kind {
        FormatKind::Float { .. } => power_of_two(format.exponents().0),
        FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => 0.0,
    }
}
