//! Section 3: errors of ten terms and of spherical harmonics for two reflectances, and Figure 3.

use super::forms::{Form, FormErrors, ORDERS, TERMS, at_equal_angles, cook_torrance, schlick};
use super::{EntryFindings, PaperRow, Setting, Shared, StudyError, Sweep, number, paragraph, roughness, solved};
use crate::all_frequency::factor::ProductErrors;

/// A reflectance of the paper with the name in its figures, and the possible forms of its model.
struct PrintedReflectance {
    id: &'static str,
    name: &'static str,
    forms: fn() -> Vec<Form>,
    sweep: &'static str,
}

const REFLECTANCES: [PrintedReflectance; 2] = [
    PrintedReflectance {
        id: "cook-torrance",
        name: "Cook-Torrance",
        forms: cook_torrance,
        sweep: "forms of Cook and Torrance's model",
    },
    PrintedReflectance { id: "schlick", name: "Schlick", forms: schlick, sweep: "forms of Schlick's model" },
];

const HOW: &str = "Reflectance times cosine is tabulated on parabolic maps of {} x {} texels, with {} samples per pair of texels and means cut off \
    at {}. It is approximated by {} terms of the singular value decomposition, and by spherical harmonics from integrals over the hemisphere for \
    view and light. Errors are over the {} x {} pairs of texels whose directions lie above the horizon. The paper names the models and their \
    parameters, but none of their factors. Rows use the textbook form, which creates no energy; the tables also have the other printed denominators, \
    and forms that an earlier search had found nearer. Forms at centers have one sample per pair. Forms at equal angles are sampled at {} directions \
    with equal solid angles instead of on maps; singular values and harmonics use the same samples.";
const QUESTION: &str = "which denominators, Fresnel and shadowing terms the paper's two reflectances have, where on the hemisphere its errors are \
    taken, and whether the harmonics expand view, light or both.";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let (mut rows, mut tables, mut functions) = (Vec::new(), Vec::new(), Vec::new());
    for reflectance in &REFLECTANCES {
        let mut settings = Vec::new();
        let forms = (reflectance.forms)();
        for form in &forms {
            settings.push(Setting { at: form.0.to_owned(), values: FormErrors::new(form)?.values() });
        }
        for (name, lobe) in at_equal_angles(&forms) {
            settings.push(Setting { at: name, values: FormErrors::at_equal_angles(&lobe)?.values() });
        }
        let sweep = Sweep { name: reflectance.sweep, parameter: "form", settings };
        let stated = &sweep.settings[0].values;
        let mut found = reflectance.rows(stated)?;
        functions.extend(stated.last());
        sweep.explain(&mut found);
        let title = format!("{}: errors by form of the factors", reflectance.name);
        tables.push(sweep.table(&title, &found, (None, |value| value)));
        rows.extend(found);
    }
    rows.push(solved("functions-over-terms", functions[0])?.with_readings(functions[1..].iter().copied()));
    let swept = roughness::sweep()?;
    rows.push(swept.row);
    tables.extend(swept.tables);
    let sampling = cook_torrance()[0].2;
    let inside = swept.inside as f64;
    let samples = (sampling.supersamples.view * sampling.supersamples.light) as f64;
    let figures = [
        number(sampling.side as f64, 0),
        number(sampling.side as f64, 0),
        number(samples * samples, 0),
        number(sampling.limit, 0),
        number(TERMS as f64, 0),
        number(inside, 0),
        number(inside, 0),
        number(ProductErrors::directions().len() as f64, 0),
    ];
    Ok(EntryFindings::new([paragraph(HOW, figures)], rows, [QUESTION], tables))
}

impl PrintedReflectance {
    /// Rows for all values of [`FormErrors::values`] except the last.
    fn rows(&self, values: &[f64]) -> Result<Vec<PaperRow>, StudyError> {
        let bases = std::iter::once("terms".to_owned()).chain(ORDERS.map(|order| format!("order-{order}")));
        let errors = bases.flat_map(|basis| ["rms", "largest"].map(|kind| format!("{basis}-{kind}")));
        let orders = ["order-6-over-terms", "terms-over-order-7"].map(str::to_owned);
        let figures = errors.chain(orders).zip(values);
        figures.map(|(figure, &ours)| solved(&format!("{}-{figure}", self.id), ours)).collect()
    }
}
