//! The reflectance to be factored, and the errors of choosing it.

use crate::all_frequency::factor::{FactorSampling, Factorization, Lobe, ProductFunction, ProductTable};
use crate::error::{InputError, ensure};
use crate::transfer::brdf::Brdf;

/// A reflectance to be factored.
#[derive(Clone, Debug)]
pub enum FactorSubject {
    /// Microfacets in a custom form.
    Lobe(Lobe),
    /// A model of `transfer::brdf`.
    Brdf(Brdf),
    /// A table of f by texels.
    Table(ProductTable),
}

/// A reflectance, the parameters of its sampling, and the number of terms.
#[derive(Clone, Debug)]
pub struct BrdfFactors {
    /// Its name.
    pub name: String,
    /// The reflectance.
    pub subject: FactorSubject,
    /// Sampling of f; a table is used unchanged.
    pub sampling: FactorSampling,
    /// Number of terms m; `None` for ten, or for the rank of the table if that is smaller.
    pub terms: Option<usize>,
}

/// The paper's m for glossy surfaces.
const TERMS: usize = 10;

impl BrdfFactors {
    /// Rejects more terms than a map has texels, before any table is computed; no rank exceeds this number.
    pub(super) fn check_terms(&self) -> Result<(), InputError> {
        let texels = match &self.subject {
            FactorSubject::Table(table) => table.view().texels().min(table.light().texels()),
            _ => self.sampling.side.saturating_pow(2),
        };
        let terms = self.terms.unwrap_or_default();
        ensure!(terms <= texels, "crossbar::factor::terms" =>
            "expected at most {texels} terms, as many as a map has texels, found {terms}"; help "ask for fewer terms");
        Ok(())
    }

    /// Singular values of a table, with vectors for the terms that are wanted.
    pub(super) fn factorization(&self, table: &ProductTable) -> Result<Factorization, InputError> {
        self.terms.map_or_else(|| Factorization::up_to(table, TERMS), |terms| Factorization::new(table, terms))
    }
}

impl FactorSubject {
    /// Calls `of` with f as a formula; returns `None` for a table.
    pub(super) fn with_product<T>(&self, of: impl FnOnce(&dyn ProductFunction) -> T) -> Option<T> {
        match self {
            Self::Lobe(lobe) => Some(of(lobe)),
            Self::Brdf(brdf) => Some(of(brdf)),
            Self::Table(_) => None,
        }
    }

    /// The table of f.
    pub(super) fn table(
        &self,
        sampling: &FactorSampling,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<ProductTable, InputError> {
        match self {
            Self::Table(table) => Ok(table.clone()),
            _ => self.with_product(|product| sampling.table(product, progress)).expect("all others are formulas"),
        }
    }
}
