//! Section 3: errors of ten terms and of spherical harmonics for two reflectances, and Figure 3.

use super::forms::{
    Form, ORDERS, TERMS, at_equal_angles, bare, centers, cook_torrance, errors, errors_at_equal_angles, schlick,
};
use super::{EntryFindings, HOST, PaperRow, RunResult, Setting, Shared, StudyError, Sweep, paragraph, solved};
use crate::all_frequency::factor::{DiscSamples, FactorSampling, Lobe, ProductErrors};
use crate::report::Table;
use crate::study::prt::{BrdfFactors, FactorSubject, SweptRoughness, roughness_table};

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
    let swept = figure_3()?;
    rows.push(swept.row);
    tables.extend(swept.tables);
    let sampling = cook_torrance()[0].2;
    let (side, limit, inside) = (sampling.side, sampling.limit, swept.inside);
    let samples = (sampling.supersamples.view * sampling.supersamples.light).pow(2);
    let directions = ProductErrors::directions().len();
    let how = paragraph(HOW, &[&side, &side, &samples, &limit, &TERMS, &inside, &inside, &directions]);
    Ok(EntryFindings::new([how], rows, [QUESTION], tables))
}

/// Rows for all values of [`errors`] except the last.
fn error_rows(id: &str, values: &[f64]) -> Result<Vec<PaperRow>, StudyError> {
    let bases = std::iter::once("terms".to_owned()).chain(ORDERS.map(|order| format!("order-{order}")));
    let errors = bases.flat_map(|basis| ["rms", "largest"].map(|kind| format!("{basis}-{kind}")));
    let orders = ["order-6-over-terms", "terms-over-order-7"].map(str::to_owned);
    errors.chain(orders).zip(values).map(|(figure, &ours)| solved(&format!("{id}-{figure}"), ours)).collect()
}

const ROUGHNESSES: [f64; 5] = [0.2, 0.25, 0.3, 0.4, 0.5];
/// Mean FLIP error of spheres above which their difference counts as visible; we chose it before we computed any error.
const SEEN: f64 = 0.05;

struct Figure3 {
    row: PaperRow,
    tables: Vec<Table>,
    /// Number of texels of a map above the horizon.
    inside: usize,
}

fn figure_3() -> Result<Figure3, StudyError> {
    let lobe = Lobe::cook_torrance(0.4, 0.5);
    let textbook = swept("normalised", lobe)?;
    let bare = swept("distribution alone", bare(lobe))?;
    let row = solved("roughness", threshold(&textbook.1))?;
    let table = centers().table(&lobe, &mut |_, _| ()).on(HOST)?;
    let [inside, _] = DiscSamples::new(&table).counts();
    Ok(Figure3 { row, tables: vec![textbook.0, bare.0], inside })
}

fn swept(form: &str, lobe: Lobe) -> Result<(Table, Vec<SweptRoughness>), StudyError> {
    let study = BrdfFactors {
        name: form.to_owned(),
        subject: FactorSubject::Lobe(lobe),
        sampling: FactorSampling::default(),
        terms: Some(TERMS),
    };
    let rows = study.sweep(&ROUGHNESSES).on(HOST)?;
    let table = roughness_table(&rows, &format!("Errors of {TERMS} terms by roughness, {form}"));
    Ok((table, rows))
}

/// Largest roughness at which the difference is visible, interpolated linearly between two roughnesses of the sweep; 0
/// if it is visible at no roughness.
fn threshold(rows: &[SweptRoughness]) -> f64 {
    let Some(last) = rows.iter().rposition(|row| row.flip > SEEN) else { return 0.0 };
    let Some(next) = rows.get(last + 1) else { return rows[last].roughness };
    let row = &rows[last];
    row.roughness + (next.roughness - row.roughness) * (row.flip - SEEN) / (row.flip - next.flip)
}
