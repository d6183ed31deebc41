//! Section 3: errors of ten terms and of spherical harmonics for two reflectances, and Figure 3.

use super::forms::{Form, ORDERS, TERMS, at_equal_angles, cook_torrance, errors, errors_at_equal_angles, schlick};
use super::{EntryFindings, PaperRow, Setting, Shared, StudyError, Sweep, number, paragraph, roughness, solved};
use crate::all_frequency::factor::ProductErrors;

type Forms = fn() -> Vec<Form>;

/// The paper's reflectances: name in figure names, name, possible forms, and name of their sweep.
const REFLECTANCES: [(&str, &str, Forms, &str); 2] = [
    ("cook-torrance", "Cook-Torrance", cook_torrance, "forms of Cook and Torrance's model"),
    ("schlick", "Schlick", schlick, "forms of Schlick's model"),
];
const HOW: &str = "The product of reflectance and cosine is tabulated on parabolic maps of {} x {} texels, with {} samples per pair of texels; means \
    are cut off at {}. It is approximated by {} terms of the singular value decomposition, and by spherical harmonics. Errors are over the {} x {} \
    pairs of texels whose directions lie above the horizon. The paper gives the models and their parameters, but not the factors in them. Rows use \
    the textbook form, which creates no energy; the tables also have other published denominators, and forms that an earlier search found \
    nearer to the printed errors. Forms at centers have one sample per pair; forms at equal angles are sampled at {} directions with equal solid angles \
    instead of on maps.";
const QUESTION: &str = "which denominators, Fresnel and shadowing terms the paper's two reflectances have, where on the hemisphere its errors are \
    taken, and whether the harmonics expand view, light or both.";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let (mut rows, mut tables, mut functions) = (Vec::new(), Vec::new(), Vec::new());
    for (id, reflectance, forms, sweep) in REFLECTANCES {
        let mut settings = Vec::new();
        let forms = forms();
        for form in &forms {
            settings.push(Setting { at: form.0.to_owned(), values: errors(form)? });
        }
        for (name, lobe) in at_equal_angles(&forms) {
            settings.push(Setting { at: name, values: errors_at_equal_angles(&lobe)? });
        }
        let sweep = Sweep { name: sweep, parameter: "form", settings };
        let stated = &sweep.settings[0].values;
        let mut found = error_rows(id, stated)?;
        functions.extend(stated.last());
        sweep.explain(&mut found);
        let title = format!("{reflectance}: errors by form of the factors");
        tables.push(sweep.table(&title, &found, (None, |value| value)));
        rows.extend(found);
    }
    rows.push(solved("functions-over-terms", functions[0])?.with_readings(functions[1..].iter().copied()));
    let swept = roughness::sweep()?;
    rows.push(swept.row);
    tables.extend(swept.tables);
    let sampling = cook_torrance()[0].2;
    let (side, inside) = (sampling.side as f64, swept.inside as f64);
    let samples = (sampling.supersamples.view * sampling.supersamples.light) as f64;
    let directions = ProductErrors::directions().len() as f64;
    let figures = [side, side, samples * samples, sampling.limit, TERMS as f64, inside, inside, directions];
    let figures = figures.map(|figure| number(figure, 0));
    Ok(EntryFindings::new([paragraph(HOW, figures)], rows, [QUESTION], tables))
}

/// Rows for all values of [`errors`] except the last.
fn error_rows(id: &str, values: &[f64]) -> Result<Vec<PaperRow>, StudyError> {
    let bases = std::iter::once("terms".to_owned()).chain(ORDERS.map(|order| format!("order-{order}")));
    let errors = bases.flat_map(|basis| ["rms", "largest"].map(|kind| format!("{basis}-{kind}")));
    let orders = ["order-6-over-terms", "terms-over-order-7"].map(str::to_owned);
    errors.chain(orders).zip(values).map(|(figure, &ours)| solved(&format!("{id}-{figure}"), ours)).collect()
}
