//! Links of bands (rows of texels), which are computed in parallel.

use rayon::prelude::*;

use super::choice::{self, LinkChoice};
use crate::error::{InputError, ensure};
use crate::subsurface::multipole::{BLOCK_LEVEL, BlockReceiver, ClusterId, Factors, SurfaceMoments};

/// Maximum number of factors: 1 GiB.
pub const MAX_FACTORS: usize = 1 << 28;

/// Rows of texels that are computed together.
const BAND: usize = 1 << BLOCK_LEVEL;

/// Links of all texels of an atlas: clusters and factors.
pub(super) struct LinkBands {
    /// Clusters of adaptive links: texel by texel, row by row, then link by link. Empty for fixed links.
    pub(super) clusters: Vec<PackedCluster>,
    /// Factors texel by texel, row by row, then link by link, then channel by channel.
    pub(super) factors: Vec<f32>,
}

impl LinkBands {
    /// Computes all links with given factors, `per_texel` of them per texel.
    pub(super) fn with<const N: usize>(factors: &Factors<'_, N>, choice: LinkChoice, per_texel: usize) -> Self {
        let (side, root) = (factors.surface().side(), root(factors.surface()));
        let links = side as usize * side as usize * per_texel;
        let (roots, clusters) = match choice {
            LinkChoice::Fixed { level } => (fixed_clusters(side, level).collect(), 0),
            LinkChoice::Adaptive { .. } => (vec![root], links),
        };
        // An unused link has the factor 0 and points to the root.
        let mut bands = Self { clusters: vec![PackedCluster::new(root); clusters], factors: vec![0.0; links * N] };
        let band = BAND * side as usize * per_texel;
        let mut ids: Vec<&mut [PackedCluster]> = bands.clusters.chunks_mut(band).collect();
        ids.resize_with((side as usize).div_ceil(BAND), Default::default);
        let parts = ids.into_par_iter().zip(bands.factors.par_chunks_mut(band * N));
        parts.enumerate().for_each(|(band, (ids, into))| {
            let mut block = BlockReceiver::new(factors.receiver());
            for square in squares(side, band) {
                block.visit(square, &roots, &mut |texel| {
                    let at = place_in_band(side, texel.texel()) * per_texel;
                    let into = into[at * N..][..per_texel * N].chunks_exact_mut(N);
                    let set = |into: &mut [f32], factor: [f64; N]| {
                        into.iter_mut().zip(factor).for_each(|(into, factor)| *into = factor as f32);
                    };
                    match choice {
                        LinkChoice::Fixed { .. } => {
                            into.enumerate().for_each(|(node, into)| set(into, texel.factor(node)));
                        }
                        LinkChoice::Adaptive { count } => {
                            let links = choice::adaptive(texel, count);
                            for ((id, into), link) in ids[at..][..per_texel].iter_mut().zip(into).zip(&links) {
                                *id = PackedCluster::new(link.cluster);
                                set(into, link.factor);
                            }
                        }
                    }
                });
            }
        });
        bands
    }
}

/// A cluster in 32 bits: level, row and column of 4, 14 and 14 bits. Atlases have at most 8192 texels per side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PackedCluster(u32);

impl PackedCluster {
    pub(super) fn new(ClusterId { level, y, x }: ClusterId) -> Self {
        Self(level << 28 | y << 14 | x)
    }

    pub(super) fn id(self) -> ClusterId {
        ClusterId { level: self.0 >> 28, y: self.0 >> 14 & 0x3fff, x: self.0 & 0x3fff }
    }
}

/// Checks a choice, and returns its number of links per texel.
pub(super) fn check(surface: &SurfaceMoments, choice: LinkChoice, channels: usize) -> Result<usize, InputError> {
    let side = surface.side();
    if let LinkChoice::Fixed { level } = choice {
        let levels = surface.level_count();
        ensure!(level < levels, "subsurface::links" => "expected a level below {levels}, found {level}");
    }
    let is_empty = choice == LinkChoice::Adaptive { count: 0 };
    ensure!(!is_empty, "subsurface::links" => "expected at least one link per texel");
    let links = choice.per_texel(side) as usize;
    let factors = u128::from(side) * u128::from(side) * links as u128 * channels as u128;
    ensure!(factors <= MAX_FACTORS as u128, "subsurface::links" =>
        "{links} links of {channels} channels per texel at {side} x {side} texels are {factors} numbers, \
         expected at most {MAX_FACTORS}");
    Ok(links)
}

/// The clusters of fixed links, which all texels share.
pub(super) fn fixed_clusters(side: u32, level: u32) -> impl Iterator<Item = ClusterId> {
    let width = side >> level;
    (0..width).flat_map(move |y| (0..width).map(move |x| ClusterId { level, y, x }))
}

fn root(surface: &SurfaceMoments) -> ClusterId {
    ClusterId { level: surface.level_count() - 1, y: 0, x: 0 }
}

fn squares(side: u32, band: usize) -> impl Iterator<Item = ClusterId> {
    let level = BLOCK_LEVEL.min(side.ilog2());
    (0..side >> level).map(move |x| ClusterId { level, y: band as u32, x })
}

fn place_in_band(side: u32, (x, y): (u32, u32)) -> usize {
    ((y % BAND as u32) * side + x) as usize
}
