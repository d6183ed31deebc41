//! Links (section 4.2.1): the clusters from which each texel gathers irradiance, each with its throughput factor.
//!
//! - [`Links`]: fixed or adaptive links, with one factor per link or three;
//! - [`IrradianceMeans`]: the mean irradiance of every cluster, by area or by number of texels;
//! - [`EncodedLinks`]: links as texels of textures, and the numbers that fp16 cannot represent.

mod bands;
mod choice;
mod encode;
mod gather;

use super::Dipole;
use super::multipole::{ClusterId, Factors, SurfaceMoments};
use crate::error::{InputError, input_error};
use bands::{LinkBands, PackedCluster, check, fixed_clusters};

pub use bands::MAX_FACTORS;
pub use choice::LinkChoice;
pub(super) use encode::link_textures;
pub use encode::{EncodedLinks, LinkPlace, LostFactors};
pub use gather::{IrradianceMeans, MeanWeighting};

/// The channel whose dipole gives scalar factors: green. Means of factors would not be the factors of any dipole.
pub const SCALAR_CHANNEL: usize = 1;

/// The links of all texels of an atlas. A factor is F_iC of equation 10: B_i is the sum of factor times the cluster's
/// area-weighted mean irradiance. Factors are rounded to f32 once.
#[derive(Clone, Debug, PartialEq)]
pub struct Links {
    side: u32,
    choice: LinkChoice,
    channels: usize,
    per_texel: usize,
    /// Clusters: for fixed links, one per link; for adaptive links, texel by texel, row by row, then link by link.
    clusters: Vec<PackedCluster>,
    /// Factors texel by texel, row by row, then link by link, then channel by channel.
    factors: Vec<f32>,
}

impl Links {
    /// Computes the links of every texel, for one dipole (scalar factors) or for red, green and blue.
    pub fn new(
        surface: &SurfaceMoments,
        dipoles: &[Dipole],
        choice: LinkChoice,
        tolerance: f64,
    ) -> Result<Self, InputError> {
        match *dipoles {
            [dipole] => Self::with(&Factors::new(surface, [dipole], tolerance)?, choice),
            [r, g, b] => Self::with(&Factors::new(surface, [r, g, b], tolerance)?, choice),
            // One dipole per channel: one channel, or red, green and blue.
            _ => Err(input_error!("subsurface::links" => "expected one dipole, or three, found {}", dipoles.len())),
        }
    }

    /// Computes the links of every texel with given factors. Fails as [`Self::new`] does.
    pub fn with<const N: usize>(factors: &Factors<'_, N>, choice: LinkChoice) -> Result<Self, InputError> {
        let (side, per_texel) = (factors.surface().side(), check(factors.surface(), choice, N)?);
        let LinkBands { mut clusters, factors } = LinkBands::with(factors, choice, per_texel);
        if let LinkChoice::Fixed { level } = choice {
            clusters = fixed_clusters(side, level).map(PackedCluster::new).collect();
        }
        Ok(Self { side, choice, channels: N, per_texel, clusters, factors })
    }

    /// Texels along a side of the atlas.
    pub fn side(&self) -> u32 {
        self.side
    }

    /// Choice of the links.
    pub fn choice(&self) -> LinkChoice {
        self.choice
    }

    /// Factors per link: 1 or 3.
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// Links per texel. An adaptive texel uses 1 + 3 k links; the others have the factor 0.
    pub fn per_texel(&self) -> usize {
        self.per_texel
    }

    /// The links of a texel: clusters with a factor per channel. Panics if there is no such texel.
    pub fn of(&self, [x, y]: [u32; 2]) -> impl ExactSizeIterator<Item = (ClusterId, &[f32])> {
        assert!(x < self.side && y < self.side, "there is no texel ({x}, {y})");
        let texel = y as usize * self.side as usize + x as usize;
        let factors = &self.factors[texel * self.per_texel * self.channels..][..self.per_texel * self.channels];
        let clusters = match self.choice {
            LinkChoice::Fixed { .. } => &self.clusters[..],
            LinkChoice::Adaptive { .. } => &self.clusters[texel * self.per_texel..][..self.per_texel],
        };
        clusters.iter().map(|cluster| cluster.id()).zip(factors.chunks_exact(self.channels))
    }

    /// Factors texel by texel, row by row, then link by link, then channel by channel.
    pub fn factors(&self) -> &[f32] {
        &self.factors
    }
}
