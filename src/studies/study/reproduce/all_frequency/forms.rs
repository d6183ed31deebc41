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

/// Sampling at texel centers, one sample per pair.
pub(super) fn centers() -> FactorSampling {
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

/// Factors a reflectance by its singular vectors into `terms` terms.
pub(super) fn factorization(lobe: &Lobe, terms: usize) -> Result<Factorization, StudyError> {
    let table = FactorSampling::default().table(lobe, &mut |_, _| ()).on(HOST)?;
    Factorization::new(&table, terms).on(HOST)
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

/// Errors of a form, in the order of the printed table: RMS and maximum of ten terms, then of each of [`ORDERS`]; then
/// the two RMS comparisons, and the ratio of functions to terms.
pub(super) fn errors((_, lobe, sampling): &Form) -> Result<Vec<f64>, StudyError> {
    let table = sampling.table(lobe, &mut |_, _| ()).on(HOST)?;
    let found = Factorization::new(&table, TERMS).on(HOST)?;
    let disc = DiscSamples::new(&table);
    with_harmonics(disc.errors(&found.factors(TERMS)), disc.samples())
}

/// Errors of a lobe at directions with equal solid angles, clamped as texels are clamped.
pub(super) fn errors_at_equal_angles(lobe: &Lobe) -> Result<Vec<f64>, StudyError> {
    let samples = HemisphereSamples::of_equal_angles(lobe, FactorSampling::default().limit);
    with_harmonics(samples.term_errors(TERMS).on(HOST)?, &samples)
}

fn with_harmonics(terms: ProductErrors, samples: &HemisphereSamples) -> Result<Vec<f64>, StudyError> {
    let of = |order: usize| harmonic_errors(samples, order).on(HOST);
    // The functions of the first order whose RMS does not exceed the terms', or of the highest order.
    let mut functions = MAX_ORDER * MAX_ORDER;
    for order in 1..=MAX_ORDER {
        if of(order)?.rms <= terms.rms {
            functions = order * order;
            break;
        }
    }
    let [four, five, six, seven] = ORDERS;
    let harmonics = [of(four)?, of(five)?, of(six)?, of(seven)?];
    let [.., six, seven] = &harmonics;
    let ratios = [six.rms / terms.rms, terms.rms / seven.rms, functions as f64 / TERMS as f64];
    let all = std::iter::once(&terms).chain(&harmonics).flat_map(|errors| [errors.rms, errors.max]);
    Ok(all.chain(ratios).collect())
}
