//! Possible forms of the paper's two reflectances, and their errors.

use super::{HOST, RunResult, StudyError};
use crate::all_frequency::factor::{
    Denominators, DiscSamples, FacetDistribution, FactorSampling, Factorization, FresnelForm, HemisphereSamples, Lobe,
    ProductErrors, Shadowing, Supersamples, TangentCosine, harmonic_errors,
};
use crate::sphere::MAX_ORDER;

/// Number of terms, m.
pub(super) const TERMS: usize = 10;
/// Harmonic orders of the printed table.
pub(super) const ORDERS: [usize; 4] = [4, 5, 6, 7];

/// Interpretation: its name, the reflectance, and its sampling.
pub(super) type Form = (&'static str, Lobe, FactorSampling);

/// Errors of one form.
pub(super) struct FormErrors {
    /// Errors of ten terms.
    pub(super) terms: ProductErrors,
    /// Errors of each of [`ORDERS`].
    pub(super) harmonics: [ProductErrors; 4],
    /// Number of functions of the first order whose RMS does not exceed the terms' RMS; the number for the highest
    /// order if there is none.
    pub(super) functions: usize,
}

/// Sampling at texel centers, one sample per pair.
fn centers() -> FactorSampling {
    FactorSampling { supersamples: Supersamples::NONE, ..FactorSampling::default() }
}

/// Forms of Cook and Torrance's model, the textbook form first.
pub(super) fn cook_torrance() -> Vec<Form> {
    let lobe = Lobe::cook_torrance(0.4, 0.5);
    let bare = bare(lobe);
    vec![
        ("normalised", lobe, FactorSampling::default()),
        ("printed_1982", Lobe { denominators: Denominators::Printed1982, ..lobe }, FactorSampling::default()),
        ("distribution_alone", bare, FactorSampling::default()),
        ("distribution_at_centers", bare, centers()),
    ]
}

/// Reduces a lobe to the distribution times the reflectance at normal incidence and the cosine.
pub(super) fn bare(lobe: Lobe) -> Lobe {
    Lobe { denominators: Denominators::Product, fresnel: FresnelForm::Constant, shadowing: Shadowing::None, ..lobe }
}

/// Forms of Schlick's model, his own first.
pub(super) fn schlick() -> Vec<Form> {
    let lobe = Lobe::schlick(0.2, 0.2, 0.8);
    let half = quarter_of_half_vector(lobe);
    vec![
        ("normalised", lobe, FactorSampling::default()),
        ("quarter", Lobe { denominators: Denominators::Quarter, ..lobe }, FactorSampling::default()),
        ("quarter_of_half_vector", half, FactorSampling::default()),
        ("half_vector_at_centers", half, centers()),
    ]
}

/// Divides the product of distribution, shadowing and Fresnel reflectance by four, and uses the half vector's own
/// component along the tangent.
pub(super) fn quarter_of_half_vector(lobe: Lobe) -> Lobe {
    let distribution = match lobe.distribution {
        FacetDistribution::Schlick { roughness, isotropy, .. } => {
            FacetDistribution::Schlick { roughness, isotropy, tangent: TangentCosine::HalfVector }
        }
        other => other,
    };
    Lobe { distribution, denominators: Denominators::Quarter, ..lobe }
}

/// The different lobes of some forms, named for samples at equal solid angles: the paper's "1024 samples in both light
/// direction and view direction sampled over the hemisphere" need not be texels of a map.
pub(super) fn at_equal_angles(forms: &[Form]) -> Vec<(String, Lobe)> {
    let mut found: Vec<(String, Lobe)> = Vec::new();
    for (name, lobe, _) in forms {
        if !found.iter().any(|(_, other)| other == lobe) {
            found.push((format!("{name}_at_equal_angles"), *lobe));
        }
    }
    found
}

impl FormErrors {
    /// Computes the errors of an interpretation.
    pub(super) fn new((_, lobe, sampling): &Form) -> Result<Self, StudyError> {
        let table = sampling.table(lobe, &mut |_, _| ()).on(HOST)?;
        let found = Factorization::new(&table, TERMS).on(HOST)?;
        let disc = DiscSamples::new(&table);
        Self::beside(disc.errors(&found.factors(TERMS)), disc.samples())
    }

    /// Computes the errors of a lobe at directions with equal solid angles, clamped as texels are clamped.
    pub(super) fn at_equal_angles(lobe: &Lobe) -> Result<Self, StudyError> {
        let samples = HemisphereSamples::of_equal_angles(lobe, FactorSampling::default().limit);
        let terms = samples.term_errors(TERMS).on(HOST)?;
        Self::beside(terms, &samples)
    }

    fn beside(terms: ProductErrors, samples: &HemisphereSamples) -> Result<Self, StudyError> {
        let of = |order: usize| harmonic_errors(samples, order).on(HOST);
        let mut functions = MAX_ORDER * MAX_ORDER;
        for order in 1..=MAX_ORDER {
            if of(order)?.rms <= terms.rms {
                functions = order * order;
                break;
            }
        }
        let [four, five, six, seven] = ORDERS;
        Ok(Self { terms, harmonics: [of(four)?, of(five)?, of(six)?, of(seven)?], functions })
    }

    /// Values in the order of the printed table: RMS and maximum of the terms, then of each order; then the two RMS
    /// comparisons, and the ratio of functions to terms.
    pub(super) fn values(&self) -> Vec<f64> {
        let all = std::iter::once(&self.terms).chain(&self.harmonics);
        let [.., six, seven] = &self.harmonics;
        all.flat_map(|errors| [errors.rms, errors.max])
            .chain([six.rms / self.terms.rms, self.terms.rms / seven.rms, self.functions as f64 / TERMS as f64])
            .collect()
    }
}
