//! Options of drawing compressed transfer, and the format of weights in vertices. The paper does not describe the
//! format; fewer bits make vertices smaller.

use refsim::device::Profile;
use refsim::texture::TexelFormat;

use crate::card::{CardError, signed_format, through_half};
use crate::clustering::Clustering;

/// The format of a weight in a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::Display, strum::EnumIter)]
#[strum(serialize_all = "lowercase")]
pub enum WeightFormat {
    /// Single precision.
    #[default]
    Fp32,
    /// Half precision.
    Fp16,
    /// Fractions of 16 bits of the range of the cluster's weights on the vector.
    Unorm16,
    /// Fractions of 8 bits of that range.
    Unorm8,
}

impl WeightFormat {
    /// The largest code of a fixed-point weight; `None` for floats.
    fn largest_code(self) -> Option<f64> {
        match self {
            Self::Fp32 | Self::Fp16 => None,
            Self::Unorm16 => Some(65535.0),
            Self::Unorm8 => Some(255.0),
        }
    }
}

/// The decoding of all vertices' weights from attributes: weight = low + extent times attribute. Decoding costs the
/// card nothing, because the products include it: M_0 + low_1 M_1 + ..., extent_1 M_1, ...
#[derive(Clone, Debug)]
pub struct CardWeights {
    format: WeightFormat,
    /// For each vector of each cluster, the decoding range of the weights: minimum and extent.
    ranges: Vec<Vec<[f64; 2]>>,
}

impl CardWeights {
    /// Creates the decoding of a clustering's weights in a format.
    pub fn new(clustering: &Clustering, format: WeightFormat) -> Self {
        let mut bounds: Vec<Vec<[f64; 2]>> = clustering
            .subspaces()
            .iter()
            .map(|subspace| vec![[f64::INFINITY, f64::NEG_INFINITY]; subspace.len()])
            .collect();
        for (point, &cluster) in clustering.of_point().iter().enumerate() {
            for ([low, high], &weight) in bounds[cluster as usize].iter_mut().zip(clustering.weights(point)) {
                (*low, *high) = (low.min(weight), high.max(weight));
            }
        }
        let range = |[low, high]: [f64; 2]| match format.largest_code() {
            Some(_) if low <= high => [low, high - low],
            _ => [0.0, 1.0],
        };
        let ranges = bounds.into_iter().map(|cluster| cluster.into_iter().map(range).collect()).collect();
        Self { format, ranges }
    }

    /// Decoding range of the weights on each vector of a cluster: minimum and extent. Panics if there is no such
    /// cluster.
    pub fn ranges(&self, cluster: usize) -> &[[f64; 2]] {
        &self.ranges[cluster]
    }

    /// Encodes a weight on a cluster's vector as the attribute that the vertex program reads. Panics if there is no
    /// such cluster or vector.
    pub fn attribute(&self, cluster: usize, vector: usize, weight: f64) -> f32 {
        let [low, extent] = self.ranges[cluster][vector];
        match (self.format, self.format.largest_code()) {
            (_, Some(largest)) if extent > 0.0 => (((weight - low) / extent * largest).round() / largest) as f32,
            (_, Some(_)) => 0.0,
            (WeightFormat::Fp16, None) => through_half(weight as f32),
            (_, None) => weight as f32,
        }
    }
}

/// Options of drawing compressed transfer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PrtCardOptions {
    /// True if clusters are drawn in superclusters, as large as the constant registers allow; false if each cluster is
    /// drawn alone.
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
    /// The default options, with maps in signed 16 bits if a device has them, otherwise in 8 bits.
    pub fn of(profile: &Profile) -> Self {
        Self { map_format: signed_format(profile, &[TexelFormat::Rgba16Snorm]), ..Self::default() }
    }

    pub(super) fn check(&self) -> Result<(), CardError> {
        if (1..=4096).contains(&self.map_side) {
            return Ok(());
        }
        Err(CardError::figure("1 to 4096 texels along an edge of a map", self.map_side))
    }
}
