//! Singular value decomposition of a table of f, its truncation to a number of terms (equation 8), and G and F of
//! equation 9.

use glam::DVec3;

use super::table::ProductTable;
use crate::error::{InputError, ensure};
use crate::linalg::{LeadingSvd, dot};
use crate::sphere::ParabolicMap;

/// f(v, s) as the sum over k of G_k(v) F_k(s). G and F are stored in texels of parabolic maps, with bilinear
/// interpolation.
#[derive(Clone, Debug, PartialEq)]
pub struct ProductFactors {
    terms: usize,
    view: FactorMap,
    light: FactorMap,
}

/// Map of all terms.
#[derive(Clone, Debug, PartialEq)]
struct FactorMap {
    map: ParabolicMap,
    /// Values texel by texel, all terms of a texel together.
    values: Vec<f64>,
}

impl FactorMap {
    fn texel(&self, terms: usize, texel: usize) -> &[f64] {
        &self.values[texel * terms..(texel + 1) * terms]
    }

    fn read(&self, direction: DVec3, into: &mut [f64]) {
        let taps = self.map.taps(direction).map(|(texel, weight)| (self.texel(into.len(), texel), weight));
        for (k, value) in into.iter_mut().enumerate() {
            *value = taps.iter().map(|(texel, weight)| weight * texel[k]).sum();
        }
    }
}

impl ProductFactors {
    /// Creates factors of this many terms from two maps, each with its texels' values, term by term. Panics if a map
    /// does not have `terms` values per texel.
    pub fn new(terms: usize, view: (ParabolicMap, Vec<f64>), light: (ParabolicMap, Vec<f64>)) -> Self {
        let of = |(map, values): (ParabolicMap, Vec<f64>)| FactorMap { map, values };
        let (view, light) = (of(view), of(light));
        for map in [&view, &light] {
            assert_eq!(map.values.len(), map.map.texels() * terms, "all terms of each texel");
        }
        Self { terms, view, light }
    }

    /// m, the number of terms.
    pub const fn terms(&self) -> usize {
        self.terms
    }

    /// The map of G.
    pub const fn view_map(&self) -> ParabolicMap {
        self.view.map
    }

    /// The map of F.
    pub const fn light_map(&self) -> ParabolicMap {
        self.light.map
    }

    /// Both maps' values, texel by texel: G, then F.
    pub fn values(&self) -> [&[f64]; 2] {
        [&self.view.values, &self.light.values]
    }

    /// G at the texel with index row times side plus column. Panics if there is no such texel.
    pub fn view_texel(&self, texel: usize) -> &[f64] {
        self.view.texel(self.terms, texel)
    }

    /// F at a texel. Panics if there is no such texel.
    pub fn light_texel(&self, texel: usize) -> &[f64] {
        self.light.texel(self.terms, texel)
    }

    /// G at a direction of length 1 towards the viewer. Panics if `into` does not have one element per term.
    pub fn view(&self, direction: DVec3, into: &mut [f64]) {
        assert_eq!(into.len(), self.terms, "a place per term");
        self.view.read(direction, into);
    }

    /// F at a direction of length 1 towards the light. Panics if `into` does not have one element per term.
    pub fn light(&self, direction: DVec3, into: &mut [f64]) {
        assert_eq!(into.len(), self.terms, "a place per term");
        self.light.read(direction, into);
    }

    /// G(v) . F(s).
    pub fn product(&self, view: DVec3, light: DVec3) -> f64 {
        let [mut g, mut f] = [vec![0.0; self.terms], vec![0.0; self.terms]];
        self.view(view, &mut g);
        self.light(light, &mut f);
        dot(&g, &f)
    }
}

/// Two singular values whose relative difference is below this count as a pair. A lobe that is symmetric around the
/// normal has pairs of equal singular values; in a table they differ by rounding, or by the square of a texel's size:
/// by 4e-4 in a map of 32 x 32.
pub const PAIR_DISTANCE: f64 = 1e-3;

/// A pair of equal singular values, one kept and one dropped. The terms then prefer a direction although f does not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitPair {
    /// Number of terms that are kept.
    pub terms: usize,
    /// The last value that is kept and the first that is dropped.
    pub values: [f64; 2],
}

/// A table's singular values, with the vectors of the largest.
#[derive(Clone, Debug, PartialEq)]
pub struct Factorization {
    view: ParabolicMap,
    light: ParabolicMap,
    svd: LeadingSvd,
}

impl Factorization {
    /// Factors a table, with vectors for up to `terms` terms. The bits do not depend on the number of threads. Fails
    /// with [`InputError`] for no terms, for more than the table's rank, and for a table of zeros.
    pub fn new(table: &ProductTable, terms: usize) -> Result<Self, InputError> {
        let found = Self::up_to(table, terms)?;
        ensure!((1..=found.rank()).contains(&terms), "crossbar::factor::terms" =>
            "expected 1 to {} terms, the rank of the table, found {terms}", found.rank(); help "use fewer terms");
        Ok(found)
    }

    /// Like [`Self::new`], with fewer terms if the rank is lower. Fails with [`InputError`] for a table of zeros.
    pub fn up_to(table: &ProductTable, terms: usize) -> Result<Self, InputError> {
        let svd = LeadingSvd::new(table.values(), terms.max(1)).map_err(of_svd)?;
        ensure!(svd.rank != 0, "crossbar::factor::dark" =>
            "expected reflectance above 0 somewhere, found 0 in all {} texels of the table",
            table.view().texels() * table.light().texels(); help "a diffuse or specular part must be above 0");
        Ok(Self { view: table.view(), light: table.light(), svd })
    }

    /// All singular values, largest first.
    pub fn singular_values(&self) -> &[f64] {
        &self.svd.values
    }

    /// Number of singular values distinguishable from 0.
    pub const fn rank(&self) -> usize {
        self.svd.rank
    }

    /// Largest number of terms for which there are vectors.
    pub fn terms(&self) -> usize {
        self.svd.right.row_count()
    }

    /// The error of Figure 2: the sum of squared differences divided by the sum of squares, over all pairs of texels.
    /// It is computed from the squared singular values that are dropped.
    pub fn relative_squared_error(&self, terms: usize) -> f64 {
        // Summed from the smallest value.
        let squares = |values: &[f64]| values.iter().rev().map(|value| value * value).sum::<f64>();
        let values = self.singular_values();
        squares(&values[terms.min(values.len())..]) / squares(values)
    }

    /// The pair of singular values that a number of terms splits, if any ([`PAIR_DISTANCE`]).
    pub fn split_pair(&self, terms: usize) -> Option<SplitPair> {
        let values = [*self.svd.values.get(terms.checked_sub(1)?)?, *self.svd.values.get(terms)?];
        let is_pair = terms < self.rank() && values[0] - values[1] < PAIR_DISTANCE * values[0];
        is_pair.then_some(SplitPair { terms, values })
    }

    /// The factors of the largest singular values; G and F both contain the square roots of the values (equation 9).
    /// The component of F_k of largest magnitude is positive. Panics if there are no vectors for this many terms.
    pub fn factors(&self, terms: usize) -> ProductFactors {
        assert!((1..=self.terms()).contains(&terms), "1 to {} terms, not {terms}", self.terms());
        let by_texel = |vectors: &crate::linalg::Matrix| {
            let texel = |at: usize| (0..terms).map(move |k| self.svd.values[k].sqrt() * vectors.row(k)[at]);
            (0..vectors.column_count()).flat_map(texel).collect()
        };
        ProductFactors::new(terms, (self.view, by_texel(&self.svd.left)), (self.light, by_texel(&self.svd.right)))
    }
}

/// Error: the singular value decomposition failed.
pub(super) fn of_svd(error: InputError) -> InputError {
    error.coded("crossbar::factor::svd")
}
