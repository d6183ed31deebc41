//! Figure 3: the same lobe with different roughnesses.

use super::sphere;
use super::subject::{BrdfFactors, FactorSubject};
use crate::all_frequency::factor::{DiscSamples, FacetDistribution, Lobe, ProductErrors, ProductFunction as _};
use crate::error::InputError;
use crate::picture::metrics::{ScreenPicture, flip};
use crate::report::{Cell, Table};
use crate::study::StudyError;

/// Pixels per degree of the observer: a screen 0.7 m wide with 3,840 pixels seen from 0.7 m, FLIP's usual value.
const PIXELS_PER_DEGREE: f64 = 67.0;

/// Result for one roughness.
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
        let exposure = sphere::exposure(&original);
        let screen = |radiance: &[f64]| ScreenPicture::new(&sphere::picture(radiance), exposure);
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
