//! Sampling of f on parabolic maps (section 3, second and third paragraph).

use glam::DVec3;
use rayon::prelude::*;

use super::motion::{Motion, moved, moved_back};
use super::product::ProductFunction;
use super::table::{MAX_MAP_SIDE, ProductTable};
use crate::all_frequency::factor::error::of_svd;
use crate::error::{InputError, ensure};
use crate::linalg::Matrix;
use crate::sphere::ParabolicMap;

/// Largest number of samples along an edge of a texel.
pub const MAX_SUPERSAMPLES: usize = 16;

/// Number of views whose rows are computed between two reports of progress.
const BATCH: usize = 16;

/// Numbers of samples along an edge of a texel of each map. "We supersample each pair of view/light samples by a factor
/// of 16 x 16" may mean [`Self::FOUR_EACH`], 16 x 16 samples of one side, or of both.
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
    /// The limit that the mean over a pair of texels is clamped to, where f is "bigger than 3" in the paper; infinity
    /// for none.
    pub limit: f64,
}

/// The paper's parameters; where it is ambiguous, the first reading.
impl Default for FactorSampling {
    fn default() -> Self {
        Self { side: 32, supersamples: Supersamples::FOUR_EACH, limit: 3.0 }
    }
}

impl FactorSampling {
    /// Checks that all parameters are in range.
    ///
    /// # Errors
    /// [`InputError`] for the first that is not.
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
    /// threads.
    ///
    /// # Errors
    /// [`InputError`] for parameters out of range.
    pub fn table(
        &self,
        product: &dyn ProductFunction,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<ProductTable, InputError> {
        self.check()?;
        let map = ParabolicMap::new(self.side);
        let [views, lights] = [self.supersamples.view, self.supersamples.light].map(|edge| self.directions(edge));
        let motions = product.symmetry().motions();
        let whole = SymmetricMap { motions, side: self.side };
        let first: Vec<usize> = (0..map.texels()).filter(|&texel| whole.first(texel).0 == texel).collect();
        let mut values = Matrix::zeros([map.texels(); 2]).map_err(of_svd)?;
        for (batch, texels) in first.chunks(BATCH).enumerate() {
            progress((batch * BATCH) as u64, first.len() as u64);
            let rows: Vec<Vec<f64>> = texels.par_iter().map(|&view| self.row(product, &views[view], &lights)).collect();
            texels.iter().zip(rows).for_each(|(&view, row)| values.row_mut(view).copy_from_slice(&row));
        }
        // Rows of the other views follow from the symmetry of f: only their lights are permuted.
        for texel in 0..map.texels() {
            let (from, motion) = whole.first(texel);
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

    /// Per texel the directions at which f is sampled. Samples outside the disc of the map, whose directions lie below
    /// the horizon, are left out and count as 0: 212 of 1,024 texels of a map of 32 x 32 have their centers there.
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

/// A map with a group of motions: rotations and mirrorings of its texels.
struct SymmetricMap {
    motions: &'static [Motion],
    side: usize,
}

impl SymmetricMap {
    /// The first texel that a motion of the group takes to `texel`, and that motion.
    fn first(&self, texel: usize) -> (usize, Motion) {
        let from = |&motion: &Motion| (moved_back(motion, self.side, texel), motion);
        let mut all = self.motions.iter().map(from);
        let same = all.next().unwrap_or((texel, [[1, 0], [0, 1]]));
        let first = all.fold(same, |first, other| if other.0 < first.0 { other } else { first });
        debug_assert_eq!(moved(first.1, self.side, first.0), texel, "a motion takes the first texel here");
        first
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::all_frequency::factor::{FresnelForm, Lobe, ProductSymmetry};
    use crate::transfer::brdf::Brdf;

    /// A product function that declares no symmetry.
    struct Plain(Lobe);

    impl ProductFunction for Plain {
        fn value(&self, view: DVec3, light: DVec3) -> f64 {
            self.0.value(view, light)
        }

        fn symmetry(&self) -> ProductSymmetry {
            ProductSymmetry::None
        }
    }

    fn table(sampling: FactorSampling, product: &dyn ProductFunction) -> ProductTable {
        sampling.table(product, &mut |_, _| ()).expect("a table")
    }

    fn largest_difference(a: &ProductTable, b: &ProductTable) -> f64 {
        let pairs = a.values().rows().flatten().zip(b.values().rows().flatten());
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn symmetry_saves_work_and_changes_nothing() {
        for lobe in [Lobe::cook_torrance(0.4, 0.5), Lobe::schlick(0.2, 0.2, 0.8)] {
            for side in [5, 8] {
                let supersamples = Supersamples { view: 2, light: 3 };
                let sampling = FactorSampling { side, supersamples, ..FactorSampling::default() };
                let difference = largest_difference(&table(sampling, &lobe), &table(sampling, &Plain(lobe)));
                assert!(difference < 1e-11, "{lobe:?} {side}: {difference}");
            }
        }
    }

    #[test]
    fn values_are_means_over_the_samples_of_a_pair() {
        let lobe = Lobe { fresnel: FresnelForm::Constant, ..Lobe::cook_torrance(0.5, 0.6) };
        let supersamples = Supersamples { view: 2, light: 2 };
        let sampling = FactorSampling { side: 4, supersamples, limit: f64::INFINITY };
        let found = table(sampling, &lobe);
        let (fine, mut sum) = (ParabolicMap::new(8), 0.0);
        // View texel (1, 2) and light texel (3, 2), part of which lies below the horizon.
        for (a, b, c, d) in (0..16).map(|at| (at & 1, at >> 1 & 1, at >> 2 & 1, at >> 3 & 1)) {
            let [view, light] = [fine.direction(2 + a, 4 + b), fine.direction(6 + c, 4 + d)];
            sum += if light.z > 0.0 { lobe.value(view, light) } else { 0.0 };
        }
        let value = found.values().row(9)[11];
        assert!((value - sum / 16.0).abs() < 1e-15 && value > 0.0, "{value} {}", sum / 16.0);
    }

    #[test]
    fn bad_figures_are_refused() {
        let ward = Brdf::Ward { albedo: 0.0, specular: 0.5, roughness: [0.2, 0.3] };
        let message = |sampling: FactorSampling| {
            sampling.table(&ward, &mut |_, _| ()).map(|_| ()).expect_err("refused").to_string()
        };
        let base = FactorSampling::default();
        assert_eq!(
            message(FactorSampling { side: 0, ..base }),
            "expected 1 to 48 texels for the side of the maps, found 0"
        );
        assert!(message(FactorSampling { limit: f64::NAN, ..base }).contains("limit of f"));
        let supersamples = Supersamples { view: 17, light: 1 };
        assert!(message(FactorSampling { supersamples, ..base }).contains("1 to 16"));
    }
}
