//! Section 3: errors of ten terms and of spherical harmonics for two reflectances, and Figure 3.

use super::forms::{Form, FormErrors, ORDERS, TERMS, cook_torrance, schlick};
use super::{
    Bound, EntryFindings, HOST, Method, Origin, PaperFigure, PaperRow, Prose, ReproduceError, Setting, Shared,
    Standing, Sweep, number, roughness,
};

const PLACE: &str = "section 3";

/// Reflectance with its printed errors: RMS and maximum of the terms, then of each order.
struct Printed {
    name: &'static str,
    forms: fn() -> Vec<Form>,
    sweep: &'static str,
    /// Errors with their digits after the point.
    errors: [(f64, u8); 10],
}

const PRINTED: [Printed; 2] = [
    Printed {
        name: "Cook-Torrance",
        forms: cook_torrance,
        sweep: "forms of Cook and Torrance's model",
        errors: [
            (0.0677, 4),
            (0.554, 3),
            (0.156, 3),
            (1.21, 2),
            (0.102, 3),
            (0.967, 3),
            (0.0708, 4),
            (0.727, 3),
            (0.0538, 4),
            (0.532, 3),
        ],
    },
    Printed {
        name: "Schlick",
        forms: schlick,
        sweep: "forms of Schlick's model",
        errors: [
            (0.0389, 4),
            (0.298, 3),
            (0.121, 3),
            (0.634, 3),
            (0.0766, 4),
            (0.438, 3),
            (0.0511, 4),
            (0.333, 3),
            (0.038, 3),
            (0.267, 3),
        ],
    },
];

const HOW: &str = "Reflectance times cosine on parabolic maps of {} x {} texels, {} samples per pair of texels, means cut off at {}; {} terms of the \
    singular value decomposition, and spherical harmonics by integrals over the hemisphere for view and light. Errors are over the {} x {} pairs \
    of texels whose directions lie above the horizon. The paper names the models and their parameters, and none of their factors: the rows have \
    the form of the textbooks, in which no energy is made; the tables beside them have the other printed denominators, and forms that a search beforehand had found nearer. \
    Forms at centers have one sample per pair.";
const QUESTION: &str = "which denominators, Fresnel and shadowing terms the paper's two reflectances have, where on the hemisphere its errors are \
    taken, and whether the harmonics expand view, light or both.";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, ReproduceError> {
    let (mut rows, mut tables) = (Vec::new(), Vec::new());
    for printed in &PRINTED {
        let mut settings = Vec::new();
        for form in (printed.forms)() {
            settings.push(Setting { at: form.0.to_owned(), values: FormErrors::new(&form)?.values() });
        }
        let sweep = Sweep { name: printed.sweep, parameter: "form", settings };
        let mut found = printed.rows(&sweep.settings[0].values);
        sweep.explain(&mut found);
        let title = format!("{}: errors by the form of its factors", printed.name);
        tables.push(sweep.table(&title, &found, (None, |value| value)));
        rows.extend(found);
    }
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
        number(sampling.clamp.limit(), 0),
        number(TERMS as f64, 0),
        number(inside, 0),
        number(inside, 0),
    ];
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, figures)],
        rows,
        questions: vec![QUESTION],
        tables,
        pictures: swept.pictures,
        ..EntryFindings::default()
    })
}

impl Printed {
    /// Rows for the values of [`FormErrors::values`].
    fn rows(&self, values: &[f64]) -> Vec<PaperRow> {
        let row = |what: String, target: PaperFigure, ours: f64, bound: Bound| {
            PaperRow::new(what, (HOST, Method::Solver), target, (ours, Standing::Counted), bound)
        };
        let name = self.name;
        let basis = |at: usize| match at.checked_sub(1) {
            None => format!("{TERMS} terms"),
            Some(at) => format!("harmonics of order {}", ORDERS[at]),
        };
        let mut rows = Vec::new();
        for (at, &(printed, decimals)) in self.errors.iter().enumerate() {
            let kind = ["RMS", "largest"][at % 2];
            let target = PaperFigure::printed(printed, decimals, "1/sr", PLACE);
            rows.push(row(format!("{name}, {}: {kind} error", basis(at / 2)), target, values[at], Bound::PREDICTION));
        }
        let rms = |at: usize| self.errors[2 * at].0;
        let mut order = |what: &str, above: f64, below: f64, ours: f64| {
            let implied = Origin::Implied(format!("{above} / {below}"));
            let target = PaperFigure { origin: implied, ..PaperFigure::printed(above / below, 2, "times", PLACE) };
            rows.push(row(format!("{name}: {what}"), target, ours, Bound::Order));
        };
        order("RMS error of order 6 over that of 10 terms", rms(3), rms(0), values[10]);
        order("RMS error of 10 terms over that of order 7", rms(0), rms(4), values[11]);
        let target = PaperFigure::printed(4.0, 1, "times", PLACE);
        rows.push(row(format!("{name}: functions as near as 10 terms, over 10"), target, values[12], Bound::AtLeast));
        rows
    }
}
