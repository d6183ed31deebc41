//! Factors by descent from a cluster to its children.

use super::kernel::{DistanceTable, add};
use super::near::{PieceCache, texel_mean};
use super::surface::{ClusterId, SurfaceMoments, to_morton};
use super::{MAX_TOLERANCE, MIN_TOLERANCE};
use crate::error::{InputError, ensure};
use crate::subsurface::Dipole;

/// Factors of N channels between the texels and clusters of a surface.
///
/// The error of a factor is at most the tolerance times the factor, plus the tolerance times 1e-5 of the plane's total
/// ([`Dipole::total`]): clusters whose light is of that order are not divided.
#[derive(Clone, Debug)]
pub struct Factors<'a, const N: usize> {
    surface: &'a SurfaceMoments,
    kernel: DistanceTable<N>,
}

impl<'a, const N: usize> Factors<'a, N> {
    /// Creates factors within a tolerance of [`MIN_TOLERANCE`] to [`MAX_TOLERANCE`], such as [`super::TOLERANCE`].
    pub fn new(surface: &'a SurfaceMoments, dipoles: [Dipole; N], tolerance: f64) -> Result<Self, InputError> {
        ensure!((MIN_TOLERANCE..=MAX_TOLERANCE).contains(&tolerance), "subsurface::links" =>
            "expected a tolerance of factors from {MIN_TOLERANCE} to {MAX_TOLERANCE}, found {tolerance}");
        Ok(Self { surface, kernel: DistanceTable::new(dipoles, surface.diameter(), surface.area(), tolerance) })
    }

    /// The surface.
    pub fn surface(&self) -> &'a SurfaceMoments {
        self.surface
    }

    /// F_iC per channel for a texel and a cluster. Panics if there is no such texel or cluster.
    pub fn factor(&self, texel: [u32; 2], cluster: ClusterId) -> [f64; N] {
        self.receiver().factor(texel, cluster)
    }

    /// A receiver that computes many factors; it is fastest for successive near texels.
    pub fn receiver(&self) -> Receiver<'_, N> {
        Receiver { factors: self, cache: PieceCache::new() }
    }
}

/// Computes factors, and caches pieces of near texels. The cache changes the time, never a factor.
#[derive(Clone, Debug)]
pub struct Receiver<'a, const N: usize> {
    factors: &'a Factors<'a, N>,
    cache: PieceCache<N>,
}

impl<'a, const N: usize> Receiver<'a, N> {
    /// Like [`Factors::factor`].
    pub fn factor(&mut self, [x, y]: [u32; 2], cluster: ClusterId) -> [f64; N] {
        let side = self.factors.surface.side();
        assert!(x < side && y < side, "there is no texel ({x}, {y})");
        self.descend(to_morton(x, y), cluster.level, to_morton(cluster.x, cluster.y))
    }

    pub(super) fn surface(&self) -> &'a SurfaceMoments {
        self.factors.surface
    }

    pub(super) fn kernel(&self) -> &'a DistanceTable<N> {
        &self.factors.kernel
    }

    /// The factor of a texel and a cluster of a level, both by Morton index.
    pub(super) fn descend(&mut self, texel: usize, level: u32, place: usize) -> [f64; N] {
        if let Some(factor) = self.undivided(texel, level, place) {
            return factor;
        }
        let mut sum = [0.0; N];
        for child in 4 * place..4 * place + 4 {
            add(&mut sum, &self.descend(texel, level - 1, child));
        }
        sum
    }

    /// The factor of a cluster that is far or a texel; `None` if it must be divided.
    #[inline]
    pub(super) fn undivided(&mut self, texel: usize, level: u32, place: usize) -> Option<[f64; N]> {
        let Factors { surface, kernel } = self.factors;
        let receiver = &surface.level(0)[texel];
        let cluster = &surface.level(level)[place];
        let mean = match kernel.mean(receiver, cluster) {
            Some(mean) => mean,
            None if level == 0 => texel_mean(surface, kernel, [texel, place], &mut self.cache),
            None => return None,
        };
        Some(mean.map(|mean| cluster.area * mean))
    }
}
