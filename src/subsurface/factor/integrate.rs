//! Factors by descent from a cluster.

use super::error::FactorError;
use super::kernel::DistanceTable;
use super::near::{PieceCache, texel_mean};
use super::surface::{ClusterId, SurfaceMoments, from_morton, to_morton};
use super::{MAX_TOLERANCE, MIN_TOLERANCE};
use crate::subsurface::Dipole;

/// Factors of N channels between the texels and clusters of a surface.
///
/// The error of a factor is at most the tolerance times the factor, plus the tolerance times 1e-5 of the light that
/// the plane would return: what is farther away than light of that order comes from is not divided.
#[derive(Clone, Debug)]
pub struct Factors<'a, const N: usize> {
    surface: &'a SurfaceMoments,
    kernel: DistanceTable<N>,
}

/// A cluster in the tree of those that the descent visited, with its factor.
#[derive(Clone, Copy, Debug)]
pub(in crate::subsurface) struct Branch<const N: usize> {
    pub(in crate::subsurface) level: u32,
    /// In Morton order.
    place: u32,
    pub(in crate::subsurface) factor: [f64; N],
    /// Where the four children stand, or 0.
    children: u32,
}

/// Of a cluster that was not divided.
const NO_CHILDREN: u32 = 0;

impl<const N: usize> Branch<N> {
    pub(in crate::subsurface) fn cluster(&self) -> ClusterId {
        let (x, y) = from_morton(self.place as usize);
        ClusterId { level: self.level, y, x }
    }

    fn new(level: u32, place: u32) -> Self {
        Self { level, place, factor: [0.0; N], children: NO_CHILDREN }
    }
}

impl<'a, const N: usize> Factors<'a, N> {
    /// Factors within a tolerance, for example [`super::TOLERANCE`].
    ///
    /// # Errors
    /// [`FactorError::Tolerance`] if it is out of range.
    pub fn new(surface: &'a SurfaceMoments, dipoles: [Dipole; N], tolerance: f64) -> Result<Self, FactorError> {
        if !(MIN_TOLERANCE..=MAX_TOLERANCE).contains(&tolerance) {
            return Err(FactorError::Tolerance { found: tolerance });
        }
        Ok(Self { surface, kernel: DistanceTable::new(dipoles, surface.diameter(), surface.area(), tolerance) })
    }

    /// The surface.
    pub fn surface(&self) -> &'a SurfaceMoments {
        self.surface
    }

    /// A proved bound on the relative error of the tabulated R_d, within 25 diffusion lengths.
    pub fn interpolation_error(&self) -> f64 {
        self.kernel.interpolation_error()
    }

    /// F_iC per channel, of the texel in column `x` and row `y` and a cluster.
    ///
    /// # Panics
    /// If there is no such texel or cluster.
    pub fn factor(&self, texel: [u32; 2], cluster: ClusterId) -> [f64; N] {
        self.receiver().factor(texel, cluster)
    }

    /// The same for many factors, whose texels are best near each other.
    pub fn receiver(&self) -> Receiver<'_, N> {
        Receiver { factors: self, cache: PieceCache::new() }
    }
}

/// Computes factors, and keeps pieces of near texels for the next ones. What is kept changes the time, never a factor.
#[derive(Clone, Debug)]
pub struct Receiver<'a, const N: usize> {
    factors: &'a Factors<'a, N>,
    cache: PieceCache,
}

impl<const N: usize> Receiver<'_, N> {
    /// As [`Factors::factor`].
    ///
    /// # Panics
    /// If there is no such texel or cluster.
    pub fn factor(&mut self, [x, y]: [u32; 2], cluster: ClusterId) -> [f64; N] {
        let side = self.factors.surface.side();
        assert!(x < side && y < side, "there is no texel ({x}, {y})");
        self.descend(to_morton(x, y), cluster.level, to_morton(cluster.x, cluster.y))
    }

    fn descend(&mut self, texel: usize, level: u32, place: usize) -> [f64; N] {
        if let Some(factor) = self.undivided(texel, level, place) {
            return factor;
        }
        let mut sum = [0.0; N];
        for child in 4 * place..4 * place + 4 {
            let factor = self.descend(texel, level - 1, child);
            sum.iter_mut().zip(factor).for_each(|(sum, factor)| *sum += factor);
        }
        sum
    }

    /// The factor of a cluster that is far, or a texel.
    #[inline]
    fn undivided(&mut self, texel: usize, level: u32, place: usize) -> Option<[f64; N]> {
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

    /// The tree of clusters that the descent from the root visits for the texel in column `x` and row `y`, the root
    /// first.
    pub(in crate::subsurface) fn tree(&mut self, [x, y]: [u32; 2], tree: &mut Vec<Branch<N>>) {
        tree.clear();
        tree.push(Branch::new(self.factors.surface.level_count() - 1, 0));
        self.grow(to_morton(x, y), tree, 0);
    }

    /// Where the children of a branch stand; they are computed if the descent left them out. `None` of a texel.
    pub(in crate::subsurface) fn children(
        &mut self,
        [x, y]: [u32; 2],
        tree: &mut Vec<Branch<N>>,
        at: usize,
    ) -> Option<usize> {
        let branch = tree[at];
        if branch.level == 0 {
            return None;
        }
        if branch.children == NO_CHILDREN {
            self.divide(to_morton(x, y), tree, at);
        }
        Some(tree[at].children as usize)
    }

    fn grow(&mut self, texel: usize, tree: &mut Vec<Branch<N>>, at: usize) {
        let Branch { level, place, .. } = tree[at];
        match self.undivided(texel, level, place as usize) {
            Some(factor) => tree[at].factor = factor,
            None => tree[at].factor = self.divide(texel, tree, at),
        }
    }

    /// Appends the children of a branch. Returns the sum of their factors.
    fn divide(&mut self, texel: usize, tree: &mut Vec<Branch<N>>, at: usize) -> [f64; N] {
        let Branch { level, place, .. } = tree[at];
        let first = tree.len();
        tree.extend((4 * place..4 * place + 4).map(|child| Branch::new(level - 1, child)));
        tree[at].children = first as u32;
        let mut sum = [0.0; N];
        for child in first..first + 4 {
            self.grow(texel, tree, child);
            sum.iter_mut().zip(tree[child].factor).for_each(|(sum, factor)| *sum += factor);
        }
        sum
    }
}
