//! Links, section 4.2.1: per texel, clusters whose irradiance it gathers, each with its throughput factor.
//!
//! - [`Links`]: fixed or adaptive, with one factor per link or three;
//! - [`IrradianceMeans`]: the mean irradiance of every cluster, by area or by number of texels;
//! - [`EncodedLinks`]: links as texels of textures, and what fp16 loses of them;
//! - [`Fitness`]: texels compared with the lengths of a medium.

mod choice;
mod encode;
mod fitness;
mod gather;

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::Dipole;
use super::factor::{BLOCK_LEVEL, BlockReceiver, ClusterId, FactorError, Factors, SurfaceMoments};

pub use choice::LinkChoice;
pub use encode::{EncodedLinks, LinkPlace, LostFactors};
pub use fitness::Fitness;
pub use gather::{IrradianceMeans, MeanWeighting};

/// The channel whose coefficients make scalar factors: green. One dipole's factors, unlike a mean of three.
pub const SCALAR_CHANNEL: usize = 1;
/// The largest number of factors: 1 GiB of them.
pub const MAX_FACTORS: usize = 1 << 28;

/// Rows of texels that are computed together.
const BAND: usize = 1 << BLOCK_LEVEL;

/// The links of all texels of an atlas. A factor is F_iC of equation 10: B_i is the sum of factor times the mean
/// irradiance of the cluster, weighted by area. Factors are rounded to f32 once.
#[derive(Clone, Debug, PartialEq)]
pub struct Links {
    side: u32,
    choice: LinkChoice,
    channels: usize,
    per_texel: usize,
    /// Of fixed links one per link; of adaptive ones per texel, row by row, and link.
    clusters: Vec<PackedCluster>,
    /// Per texel, row by row, then per link, then per channel.
    factors: Vec<f32>,
}

impl Links {
    /// The links of every texel, for one dipole (scalar factors) or for red, green and blue. `done` is called with the
    /// number of rows of texels done and of all, in any order and from any thread.
    ///
    /// # Errors
    /// [`FactorError`] for another number of dipoles, a level that the atlas does not have, a tolerance out of range,
    /// no links, or more than [`MAX_FACTORS`] factors.
    pub fn new(
        surface: &SurfaceMoments,
        dipoles: &[Dipole],
        choice: LinkChoice,
        tolerance: f64,
        done: &(dyn Fn(usize, usize) + Sync),
    ) -> Result<Self, FactorError> {
        match *dipoles {
            [dipole] => Self::with(&Factors::new(surface, [dipole], tolerance)?, choice, done),
            [r, g, b] => Self::with(&Factors::new(surface, [r, g, b], tolerance)?, choice, done),
            _ => Err(FactorError::Channels { found: dipoles.len() }),
        }
    }

    /// The links of every texel with given factors.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with<const N: usize>(
        factors: &Factors<'_, N>,
        choice: LinkChoice,
        done: &(dyn Fn(usize, usize) + Sync),
    ) -> Result<Self, FactorError> {
        let side = factors.surface().side();
        let per_texel = check(factors.surface(), choice, N)?;
        let texels = side as usize * side as usize;
        let mut links = Self {
            side,
            choice,
            channels: N,
            per_texel,
            clusters: Vec::new(),
            factors: vec![0.0; texels * per_texel * N],
        };
        let progress = Progress { side: side as usize, done, count: AtomicUsize::new(0) };
        match choice {
            LinkChoice::Fixed { level } => links.fill_fixed(factors, level, &progress),
            LinkChoice::Adaptive { count } => links.fill_adaptive(factors, count, &progress),
        }
        Ok(links)
    }

    fn fill_fixed<const N: usize>(&mut self, factors: &Factors<'_, N>, level: u32, progress: &Progress<'_>) {
        let ([width, side], per_texel) = ([self.side >> level, self.side], self.per_texel);
        let ids: Vec<_> = (0..width).flat_map(|y| (0..width).map(move |x| ClusterId { level, y, x })).collect();
        self.clusters = ids.iter().copied().map(PackedCluster::new).collect();
        let bands = self.factors.par_chunks_mut(BAND * side as usize * per_texel * N);
        bands.enumerate().for_each(|(band, into)| {
            let mut block = BlockReceiver::new(factors.receiver());
            for square in squares(side, band) {
                block.visit(square, &ids, &mut |texel| {
                    let into = &mut into[place_in_band(side, texel.texel()) * per_texel * N..][..per_texel * N];
                    for (node, into) in into.chunks_exact_mut(N).enumerate() {
                        into.iter_mut().zip(texel.factor(node)).for_each(|(into, factor)| *into = factor as f32);
                    }
                });
            }
            progress.band_done();
        });
    }

    fn fill_adaptive<const N: usize>(&mut self, factors: &Factors<'_, N>, count: usize, progress: &Progress<'_>) {
        let [side, per_texel] = [self.side as usize, self.per_texel];
        // A link that is not used has the factor 0; it points to the root.
        let root = ClusterId { level: factors.surface().level_count() - 1, y: 0, x: 0 };
        self.clusters = vec![PackedCluster::new(root); side * side * per_texel];
        let bands = self.clusters.par_chunks_mut(BAND * side * per_texel);
        let bands = bands.zip(self.factors.par_chunks_mut(BAND * side * per_texel * N));
        bands.enumerate().for_each(|(band, (ids, into))| {
            let mut block = BlockReceiver::new(factors.receiver());
            for square in squares(side as u32, band) {
                block.visit(square, &[root], &mut |texel| {
                    let links = choice::adaptive(texel, count);
                    let at = place_in_band(side as u32, texel.texel());
                    let ids = &mut ids[at * per_texel..][..per_texel];
                    let into = into[at * per_texel * N..][..per_texel * N].chunks_exact_mut(N);
                    for ((id, into), link) in ids.iter_mut().zip(into).zip(&links) {
                        *id = PackedCluster::new(link.cluster);
                        into.iter_mut().zip(link.factor).for_each(|(into, factor)| *into = factor as f32);
                    }
                });
            }
            progress.band_done();
        });
    }

    /// Texels along a side of the atlas.
    pub fn side(&self) -> u32 {
        self.side
    }

    /// How the links were chosen.
    pub fn choice(&self) -> LinkChoice {
        self.choice
    }

    /// Factors per link: 1 or 3.
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// Links per texel. An adaptive texel uses 1 + 3 k of them; the others have the factor 0.
    pub fn per_texel(&self) -> usize {
        self.per_texel
    }

    /// The links of the texel in column `x` and row `y`: clusters with a factor per channel.
    ///
    /// # Panics
    /// If there is no such texel.
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

    /// Per texel, row by row, then per link, then per channel.
    pub fn factors(&self) -> &[f32] {
        &self.factors
    }

    /// The clusters of fixed links; none of adaptive ones.
    pub fn fixed_clusters(&self) -> Vec<ClusterId> {
        match self.choice {
            LinkChoice::Fixed { .. } => self.clusters.iter().map(|cluster| cluster.id()).collect(),
            LinkChoice::Adaptive { .. } => Vec::new(),
        }
    }
}

/// A cluster in 32 bits: level, row, column, of 4, 14 and 14 bits. Atlases have at most 8192 texels along a side.
#[derive(Clone, Copy, Debug, PartialEq)]
struct PackedCluster(u32);

impl PackedCluster {
    fn new(ClusterId { level, y, x }: ClusterId) -> Self {
        Self(level << 28 | y << 14 | x)
    }

    fn id(self) -> ClusterId {
        ClusterId { level: self.0 >> 28, y: self.0 >> 14 & 0x3fff, x: self.0 & 0x3fff }
    }
}

/// The number of links per texel of a choice.
fn check(surface: &SurfaceMoments, choice: LinkChoice, channels: usize) -> Result<usize, FactorError> {
    let side = surface.side();
    match choice {
        LinkChoice::Fixed { level } if level >= surface.level_count() => {
            return Err(FactorError::Level { found: level, levels: surface.level_count() });
        }
        LinkChoice::Adaptive { count: 0 } => return Err(FactorError::NoLinks),
        LinkChoice::Fixed { .. } | LinkChoice::Adaptive { .. } => {}
    }
    let links = choice.per_texel(side) as usize;
    let texels = side as usize * side as usize;
    match texels.checked_mul(links).and_then(|all| all.checked_mul(channels)) {
        Some(all) if all <= MAX_FACTORS => Ok(links),
        _ => Err(FactorError::TooMany { side, links, channels, limit: MAX_FACTORS }),
    }
}

/// The squares of a band of rows.
fn squares(side: u32, band: usize) -> impl Iterator<Item = ClusterId> {
    let level = BLOCK_LEVEL.min(side.ilog2());
    (0..side >> level).map(move |x| ClusterId { level, y: band as u32, x })
}

/// Where a texel stands in its band.
fn place_in_band(side: u32, (x, y): (u32, u32)) -> usize {
    ((y % BAND as u32) * side + x) as usize
}

/// Counts rows of texels.
struct Progress<'a> {
    side: usize,
    done: &'a (dyn Fn(usize, usize) + Sync),
    count: AtomicUsize,
}

impl Progress<'_> {
    fn band_done(&self) {
        let rows = BAND.min(self.side);
        let before = self.count.fetch_add(rows, Ordering::Relaxed);
        (self.done)(before + rows, self.side);
    }
}
