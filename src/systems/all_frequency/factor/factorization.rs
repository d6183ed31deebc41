//! Singular values of a table of f, and what a number of terms keeps of it (equation 8).

use super::factors::ProductFactors;
use super::table::ProductTable;
use crate::all_frequency::factor::error::of_svd;
use crate::error::{InputError, ensure};
use crate::linalg::LeadingSvd;
use crate::sphere::ParabolicMap;

/// Two singular values whose relative difference is less than this count as a pair. A lobe that is symmetric around the
/// normal has its values in such pairs, which differ by rounding, or by the square of a texel's size: by 4e-4 in a map
/// of 32 x 32.
pub const PAIR_DISTANCE: f64 = 1e-3;

/// A pair of equal singular values of which one is kept and one is not: the terms then prefer a direction that f does
/// not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitPair {
    /// The terms that are kept.
    pub terms: usize,
    /// The last value that is kept and the first that is not.
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
    /// Factors a table, with vectors for up to `terms` terms. The bits do not depend on the number of threads.
    ///
    /// # Errors
    /// [`InputError`] for no terms, for more than the table's rank, and for a table of zeros.
    pub fn new(table: &ProductTable, terms: usize) -> Result<Self, InputError> {
        let found = Self::up_to(table, terms)?;
        ensure!((1..=found.rank()).contains(&terms), "crossbar::factor::terms" =>
            "expected 1 to {} terms, the rank of the table, found {terms}", found.rank(); help "ask for fewer terms");
        Ok(found)
    }

    /// As [`Self::new`], with fewer terms where the rank is lower.
    ///
    /// # Errors
    /// [`InputError`] for a table of zeros.
    pub fn up_to(table: &ProductTable, terms: usize) -> Result<Self, InputError> {
        let svd = LeadingSvd::new(table.values(), terms.max(1)).map_err(of_svd)?;
        ensure!(svd.rank != 0, "crossbar::factor::dark" =>
            "expected reflectance above 0 somewhere, found 0 in all {} texels of the table",
            table.view().texels() * table.light().texels(); help "a diffuse or specular part must be above 0");
        Ok(Self { view: table.view(), light: table.light(), svd })
    }

    /// All singular values, the largest first.
    pub fn singular_values(&self) -> &[f64] {
        &self.svd.values
    }

    /// Number of singular values distinguishable from 0.
    pub const fn rank(&self) -> usize {
        self.svd.rank
    }

    /// The most terms that there are vectors for.
    pub fn terms(&self) -> usize {
        self.svd.right.row_count()
    }

    /// The error of Figure 2: the sum of squared differences by the sum of squares, over all pairs of texels. It is
    /// that of the squared singular values that are left out.
    pub fn relative_squared_error(&self, terms: usize) -> f64 {
        // From the smallest.
        let squares = |values: &[f64]| values.iter().rev().map(|value| value * value).sum::<f64>();
        let values = self.singular_values();
        squares(&values[terms.min(values.len())..]) / squares(values)
    }

    /// The pair that a number of terms splits, if it does ([`PAIR_DISTANCE`]).
    pub fn split_pair(&self, terms: usize) -> Option<SplitPair> {
        let values = [*self.svd.values.get(terms.checked_sub(1)?)?, *self.svd.values.get(terms)?];
        let is_pair = terms < self.rank() && values[0] - values[1] < PAIR_DISTANCE * values[0];
        is_pair.then_some(SplitPair { terms, values })
    }

    /// The factors of the largest singular values, whose square roots are multiplied into both (equation 9). The
    /// component of F_k of largest magnitude is positive.
    ///
    /// # Panics
    /// If there are no vectors for this many terms.
    pub fn factors(&self, terms: usize) -> ProductFactors {
        assert!((1..=self.terms()).contains(&terms), "1 to {} terms, not {terms}", self.terms());
        let by_texel = |vectors: &crate::linalg::Matrix| {
            let texel = |at: usize| (0..terms).map(move |k| self.svd.values[k].sqrt() * vectors.row(k)[at]);
            (0..vectors.column_count()).flat_map(texel).collect()
        };
        ProductFactors::new(terms, (self.view, by_texel(&self.svd.left)), (self.light, by_texel(&self.svd.right)))
    }
}
