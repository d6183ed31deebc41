//! Links of bands of rows of texels, which do not depend on each other.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::choice::{self, LinkChoice};
use crate::error::{InputError, ensure, input_error};
use crate::subsurface::Dipole;
use crate::subsurface::multipole::{BLOCK_LEVEL, BlockReceiver, ClusterId, Factors, SurfaceMoments};

/// The largest number of factors: 1 GiB of them.
pub const MAX_FACTORS: usize = 1 << 28;

/// Rows of texels that are computed together.
const BAND: usize = 1 << BLOCK_LEVEL;

/// The links of the texels of consecutive bands: of rows of texels that are computed together.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LinkBands {
    /// For adaptive links per texel, row by row, then per link; for fixed ones empty.
    pub(super) clusters: Vec<PackedCluster>,
    /// Per texel, row by row, then per link, then per channel.
    pub(super) factors: Vec<f32>,
}

impl LinkBands {
    /// Number of bands of an atlas.
    pub fn count(side: u32) -> usize {
        side as usize / Self::rows(side)
    }

    /// Rows of texels of a band.
    pub fn rows(side: u32) -> usize {
        BAND.min(side as usize)
    }

    /// The links of a range of bands; otherwise as [`Links::new`](super::Links::new). Fails as
    /// [`Links::new`](super::Links::new) does.
    pub fn new(
        surface: &SurfaceMoments,
        dipoles: &[Dipole],
        choice: LinkChoice,
        tolerance: f64,
        range: Range<usize>,
        done: &(dyn Fn(usize, usize) + Sync),
    ) -> Result<Self, InputError> {
        match *dipoles {
            [dipole] => Self::with(&Factors::new(surface, [dipole], tolerance)?, choice, range, done),
            [r, g, b] => Self::with(&Factors::new(surface, [r, g, b], tolerance)?, choice, range, done),
            // As many dipoles as channels: one, or red, green and blue.
            _ => Err(input_error!("subsurface::links" => "expected one dipole, or three, found {}", dipoles.len())),
        }
    }

    /// The links of a range of bands with given factors.
    pub(super) fn with<const N: usize>(
        factors: &Factors<'_, N>,
        choice: LinkChoice,
        range: Range<usize>,
        done: &(dyn Fn(usize, usize) + Sync),
    ) -> Result<Self, InputError> {
        let side = factors.surface().side();
        let per_texel = check(factors.surface(), choice, N)?;
        let rows = range.len() * Self::rows(side);
        let links = rows * side as usize * per_texel;
        let mut bands = Self { clusters: Vec::new(), factors: vec![0.0; links * N] };
        let count_of_rows = AtomicUsize::new(0);
        let band_done = || {
            let before = count_of_rows.fetch_add(Self::rows(side), Ordering::Relaxed);
            done(before + Self::rows(side), rows);
        };
        match choice {
            LinkChoice::Fixed { level } => bands.fill_fixed(factors, level, range.start, &band_done),
            LinkChoice::Adaptive { count } => {
                // A link that is not used has the factor 0; it points to the root.
                bands.clusters = vec![PackedCluster::new(root(factors.surface())); links];
                bands.fill_adaptive(factors, per_texel, count, range.start, &band_done);
            }
        }
        Ok(bands)
    }

    fn fill_fixed<const N: usize>(
        &mut self,
        factors: &Factors<'_, N>,
        level: u32,
        first: usize,
        band_done: &(dyn Fn() + Sync),
    ) {
        let side = factors.surface().side();
        let ids: Vec<ClusterId> = fixed_clusters(side, level).collect();
        let per_texel = ids.len();
        let bands = self.factors.par_chunks_mut(BAND * side as usize * per_texel * N);
        bands.enumerate().for_each(|(band, into)| {
            let mut block = BlockReceiver::new(factors.receiver());
            for square in squares(side, first + band) {
                block.visit(square, &ids, &mut |texel| {
                    let into = &mut into[place_in_band(side, texel.texel()) * per_texel * N..][..per_texel * N];
                    for (node, into) in into.chunks_exact_mut(N).enumerate() {
                        into.iter_mut().zip(texel.factor(node)).for_each(|(into, factor)| *into = factor as f32);
                    }
                });
            }
            band_done();
        });
    }

    fn fill_adaptive<const N: usize>(
        &mut self,
        factors: &Factors<'_, N>,
        per_texel: usize,
        count: usize,
        first: usize,
        band_done: &(dyn Fn() + Sync),
    ) {
        let (side, root) = (factors.surface().side(), root(factors.surface()));
        let bands = self.clusters.par_chunks_mut(BAND * side as usize * per_texel);
        let bands = bands.zip(self.factors.par_chunks_mut(BAND * side as usize * per_texel * N));
        bands.enumerate().for_each(|(band, (ids, into))| {
            let mut block = BlockReceiver::new(factors.receiver());
            for square in squares(side, first + band) {
                block.visit(square, &[root], &mut |texel| {
                    let links = choice::adaptive(texel, count);
                    let at = place_in_band(side, texel.texel());
                    let ids = &mut ids[at * per_texel..][..per_texel];
                    let into = into[at * per_texel * N..][..per_texel * N].chunks_exact_mut(N);
                    for ((id, into), link) in ids.iter_mut().zip(into).zip(&links) {
                        *id = PackedCluster::new(link.cluster);
                        into.iter_mut().zip(link.factor).for_each(|(into, factor)| *into = factor as f32);
                    }
                });
            }
            band_done();
        });
    }

    /// Appends the bands that follow.
    pub fn append(&mut self, next: Self) {
        self.clusters.extend(next.clusters);
        self.factors.extend(next.factors);
    }
}

/// A cluster in 32 bits: level, row, column, of 4, 14 and 14 bits. Atlases have at most 8192 texels along a side.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct PackedCluster(u32);

impl PackedCluster {
    pub(super) fn new(ClusterId { level, y, x }: ClusterId) -> Self {
        Self(level << 28 | y << 14 | x)
    }

    pub(super) fn id(self) -> ClusterId {
        ClusterId { level: self.0 >> 28, y: self.0 >> 14 & 0x3fff, x: self.0 & 0x3fff }
    }
}

/// The number of links per texel of a choice.
pub(super) fn check(surface: &SurfaceMoments, choice: LinkChoice, channels: usize) -> Result<usize, InputError> {
    let side = surface.side();
    match choice {
        LinkChoice::Fixed { level } if level >= surface.level_count() => {
            return Err(level_error(level, surface.level_count()));
        }
        LinkChoice::Adaptive { count: 0 } => {
            return Err(input_error!("subsurface::links" => "expected at least one link per texel"));
        }
        LinkChoice::Fixed { .. } | LinkChoice::Adaptive { .. } => {}
    }
    let links = choice.per_texel(side) as usize;
    let factors = u128::from(side) * u128::from(side) * links as u128 * channels as u128;
    ensure!(factors <= MAX_FACTORS as u128, "subsurface::links" =>
        "{links} links of {channels} channels per texel at {side} x {side} texels are {factors} numbers, \
         expected at most {MAX_FACTORS}");
    Ok(links)
}

/// The error of a level that an atlas does not have.
pub(super) fn level_error(found: u32, levels: u32) -> InputError {
    input_error!("subsurface::links" => "expected a level below {levels}, found {found}")
}

/// The clusters of fixed links, the same for each texel.
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
