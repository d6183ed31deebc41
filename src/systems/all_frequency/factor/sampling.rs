//! Sampling of f on parabolic maps (section 3, second and third paragraph).

use glam::DVec3;
use rayon::prelude::*;

use super::product::{Motion, ProductFunction, moved_back};
use super::table::{MAX_MAP_SIDE, ProductTable};
use crate::all_frequency::factor::factors::of_svd;
use crate::error::{InputError, ensure};
use crate::linalg::Matrix;
use crate::sphere::ParabolicMap;

/// Largest number of samples along an edge of a texel.
pub const MAX_SUPERSAMPLES: usize = 16;

/// Number of views whose rows are computed between two reports of progress.
const BATCH: usize = 16;

/// Numbers of samples along an edge of a texel of each map. "We supersample each pair of view/light samples by a factor
/// of 16 x 16" may mean [`Self::FOUR_EACH`], 16 x 16 samples of one map's texels, or of both maps' texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Supersamples {
    /// Along an edge of the view's texel.
    pub view: usize,
    /// Along an edge of the light's texel.
    pub light: usize,
}

impl Supersamples {
    /// One sample per pair of texels, at their centers.
    pub const NONE: Self = Self { view: 1, light: 1 };
    /// 4 x 4 views times 4 x 4 lights: 256 samples per pair.
    pub const FOUR_EACH: Self = Self { view: 4, light: 4 };
}

/// Options of the sampling of f.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FactorSampling {
    /// Texels along an edge of both maps, 1 to [`MAX_MAP_SIDE`].
    pub side: usize,
    /// Samples per texel, 1 to [`MAX_SUPERSAMPLES`] along an edge.
    pub supersamples: Supersamples,
    /// The limit to which the mean over a pair of texels is clamped (in the paper where f is "bigger than 3"); infinity
    /// for no clamping.
    pub limit: f64,
}

/// The paper's parameters; where the paper is ambiguous, the first reading.
impl Default for FactorSampling {
    fn default() -> Self {
        Self { side: 32, supersamples: Supersamples::FOUR_EACH, limit: 3.0 }
    }
}

impl FactorSampling {
    /// Checks that all parameters are in range. Fails with [`InputError`] for the first that is not.
    pub fn check(&self) -> Result<(), InputError> {
        let of = |what, expected, found: f64, fits: bool| {
            ensure!(fits, "crossbar::factor::range" => "expected {expected} for the {what}, found {found}");
            Ok(())
        };
        let within = |most: usize, found: usize| (1..=most).contains(&found);
        of("side of the maps", "1 to 48 texels", self.side as f64, within(MAX_MAP_SIDE, self.side))?;
        for found in [self.supersamples.view, self.supersamples.light] {
            let what = "samples along an edge of a texel";
            of(what, "1 to 16", found as f64, within(MAX_SUPERSAMPLES, found))?;
        }
        of("limit of f", "a number above 0", self.limit, self.limit > 0.0)
    }

    /// The table of f: each value is the mean over the samples of a pair of texels, summed view by view, light by
    /// light. `progress` is called with the number of finished views and their total. The bits do not depend on
    /// threads. Fails with [`InputError`] for parameters out of range.
    pub fn table(
        &self,
        product: &dyn ProductFunction,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<ProductTable, InputError> {
        self.check()?;
        let map = ParabolicMap::new(self.side);
        let [views, lights] = [self.supersamples.view, self.supersamples.light].map(|edge| self.directions(edge));
        let motions = product.symmetry().motions();
        let first_of = |texel| first(motions, self.side, texel);
        let first: Vec<usize> = (0..map.texels()).filter(|&texel| first_of(texel).0 == texel).collect();
        let mut values = Matrix::zeros([map.texels(); 2]).map_err(of_svd)?;
        for (batch, texels) in first.chunks(BATCH).enumerate() {
            progress((batch * BATCH) as u64, first.len() as u64);
            let rows: Vec<Vec<f64>> = texels.par_iter().map(|&view| self.row(product, &views[view], &lights)).collect();
            texels.iter().zip(rows).for_each(|(&view, row)| values.row_mut(view).copy_from_slice(&row));
        }
        // Rows of the other views follow from the symmetry of f: only their lights are permuted.
        for texel in 0..map.texels() {
            let (from, motion) = first_of(texel);
            if from != texel {
                let row: Vec<f64> =
                    (0..map.texels()).map(|light| values.row(from)[moved_back(motion, self.side, light)]).collect();
                values.row_mut(texel).copy_from_slice(&row);
            }
        }
        Ok(ProductTable::new([map; 2], values))
    }

    fn row(&self, product: &dyn ProductFunction, views: &[DVec3], lights: &[Vec<DVec3>]) -> Vec<f64> {
        let Supersamples { view, light } = self.supersamples;
        let count = (view * view * light * light) as f64;
        let mean = |lights: &Vec<DVec3>| {
            let mut sum = 0.0;
            for &view in views {
                for &light in lights {
                    sum += product.value(view, light);
                }
            }
            (sum / count).min(self.limit)
        };
        lights.iter().map(mean).collect()
    }

    /// For each texel, the directions at which f is sampled. Samples outside the map's disc, whose directions lie below
    /// the horizon, are skipped and count as 0. In a map of 32 x 32, 212 of 1,024 texels have their centers outside.
    fn directions(&self, edge: usize) -> Vec<Vec<DVec3>> {
        let (coarse, fine) = (self.side, ParabolicMap::new(self.side * edge));
        let of_texel = |texel: usize| {
            let [column, row] = [texel % coarse * edge, texel / coarse * edge];
            let samples = (0..edge * edge).map(|at| fine.direction(column + at % edge, row + at / edge));
            samples.filter(|direction| direction.z > 0.0).collect()
        };
        (0..coarse * coarse).map(of_texel).collect()
    }
}

/// The first texel of a map that one of `motions` moves to `texel`, and the motion.
fn first(motions: &'static [Motion], side: usize, texel: usize) -> (usize, Motion) {
    let from = |&motion: &Motion| (moved_back(motion, side, texel), motion);
    motions.iter().map(from).min_by_key(|&(first, _)| first).unwrap_or((texel, [[1, 0], [0, 1]]))
}
