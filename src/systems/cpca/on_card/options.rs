//! Options of drawing compressed transfer.

use refsim::texture::TexelFormat;

use super::weights::WeightFormat;
use crate::card::CardError;

/// Options of drawing compressed transfer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PrtCardOptions {
    /// Clusters are drawn together, in the superclusters of the transfer or as far as the constant registers hold;
    /// otherwise each alone.
    pub superclusters: bool,
    /// Texels along an edge of the maps of y; 32 in the paper.
    pub map_side: usize,
    /// The format of the maps.
    pub map_format: TexelFormat,
    /// The format of weights in vertices.
    pub weights: WeightFormat,
}

impl Default for PrtCardOptions {
    fn default() -> Self {
        let (map_side, map_format) = (32, TexelFormat::Rgba16Snorm);
        Self { superclusters: true, map_side, map_format, weights: WeightFormat::default() }
    }
}

impl PrtCardOptions {
    /// Checks the ranges.
    pub(super) fn check(&self) -> Result<(), CardError> {
        if (1..=4096).contains(&self.map_side) {
            return Ok(());
        }
        Err(CardError::figure("1 to 4096 texels along an edge of a map", self.map_side))
    }
}
