//! The reflectance to be factored, the errors of choosing it, and Figure 3: the same lobe with different roughnesses.

use super::sphere;
use crate::all_frequency::factor::{
    DiscSamples, FacetDistribution, FactorSampling, Factorization, Lobe, ProductErrors, ProductFunction, ProductTable,
};
use crate::error::{InputError, ensure};
use crate::picture::metrics::{ScreenPicture, flip};
use crate::report::{Cell, Table};
use crate::study::StudyError;
use crate::study::prt::auto_exposure;
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

/// Pixels per degree of the observer: a screen 0.7 m wide with 3,840 pixels seen from 0.7 m, FLIP's usual value.
const PIXELS_PER_DEGREE: f64 = 67.0;

pub(in crate::study) struct SweptRoughness {
    pub(in crate::study) roughness: f64,
    pub(in crate::study) relative_squared_error: f64,
    pub(in crate::study) errors: ProductErrors,
    /// Mean FLIP error between spheres shaded by the table and by the terms.
    pub(in crate::study) flip: f64,
}

fn with_roughness(lobe: &Lobe, roughness: f64) -> Result<Lobe, InputError> {
    let distribution = match lobe.distribution {
        FacetDistribution::Beckmann { .. } => FacetDistribution::Beckmann { roughness },
        FacetDistribution::Schlick { isotropy, tangent, .. } => {
            FacetDistribution::Schlick { roughness, isotropy, tangent }
        }
    };
    let swept = Lobe { distribution, ..*lobe };
    swept.check().map_err(|error| error.coded("crossbar::factor::brdf"))?;
    Ok(swept)
}

impl BrdfFactors {
    /// The lobe of [`FactorSubject::Lobe`] with each roughness.
    pub(in crate::study) fn sweep(&self, roughnesses: &[f64]) -> Result<Vec<SweptRoughness>, StudyError> {
        let FactorSubject::Lobe(lobe) = &self.subject else {
            let what = format!("expected a model of microfacets whose roughness can be swept, found {}", self.name);
            let help = "roughness is swept for Cook and Torrance's and for Schlick's model";
            return Err(StudyError::new("crossbar::factor::sweep", what).with_help(help));
        };
        roughnesses.iter().map(|&roughness| self.swept(&with_roughness(lobe, roughness)?, roughness)).collect()
    }

    fn swept(&self, lobe: &Lobe, roughness: f64) -> Result<SweptRoughness, StudyError> {
        let table = self.sampling.table(lobe, &mut |_, _| ())?;
        let found = self.factorization(&table)?;
        let factors = found.factors(found.terms());
        let limit = self.sampling.limit;
        let [original, drawn] = [
            sphere::radiance(&|view, light| lobe.value(view, light).min(limit)),
            sphere::radiance(&|view, light| factors.product(view, light)),
        ];
        let exposure = auto_exposure(&original);
        let screen = |radiance: &[[f64; 3]]| ScreenPicture::new(&sphere::picture(radiance), exposure);
        let seen = flip(&screen(&original)?, &screen(&drawn)?, PIXELS_PER_DEGREE);
        Ok(SweptRoughness {
            roughness,
            relative_squared_error: found.relative_squared_error(found.terms()),
            errors: DiscSamples::new(&table).errors(&factors),
            flip: seen.map_or(0.0, |seen| seen.mean),
        })
    }
}

pub(in crate::study) fn roughness_table(rows: &[SweptRoughness], title: &str) -> Table {
    let row = |row: &SweptRoughness| {
        let errors = [row.relative_squared_error, row.errors.rms, row.errors.max, row.flip].map(Cell::error);
        [Cell::from(row.roughness)].into_iter().chain(errors)
    };
    Table::of(title, "roughness relative_squared_error rms max flip_of_spheres").with(rows.iter().map(row))
}
