//! Figure 11: the number of vectors per cluster, on a bumpy and a smooth model.

use super::figure_3::EYE;
use super::signals::{BIRD, BUDDHA, ComputedSignal};
use super::views::ModelView;
use super::{EntryFindings, PaperRow, Prose, ReproduceError, Shared, number, order};
use crate::prt::cpca::{Clustering, CpcaMethod};
use crate::report::{Cell, NamedPicture, Table};
use crate::sphere::HarmonicLight;

const PLACE: &str = "figure 11";
const VECTORS: [usize; 4] = [2, 4, 8, 12];
/// Printed squared errors by [`VECTORS`]: the signal, its name, errors.
const PRINTED: [(usize, &str, [f64; 4]); 2] = [
    (BUDDHA, "Buddha", [40_353.5, 21_077.5, 8_524.1, 4_413.01]),
    (BIRD, "bird", [9_510.75, 2_353.09, 294.421, 66.7495]),
];

const HOW: &str = "Iterative compression of glossy anisotropic transfer to {} clusters, {} of them on a model of our size. The paper's bird loses error quickly, \
    its Buddha slowly. Pictures are exposed as the one without compression.";
const QUESTION: &str = "the models, the BRDF and the scale of the squared error.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, ReproduceError> {
    let mut table = Table::of("Squared errors", "model vectors printed ours share_of_squares_%");
    let (mut rows, mut pictures, mut all) = (Vec::new(), Vec::new(), Vec::new());
    let light = HarmonicLight::red_and_blue(5);
    for (at, name, printed) in PRINTED {
        let (computed, eight) = shared.cpca.iterative(at, shared.models)?;
        let energy = computed.energy();
        let view = ModelView::new(computed, &light, EYE)?;
        let mut errors = Vec::new();
        for (vectors, printed) in VECTORS.into_iter().zip(printed) {
            let (error, picture) = with(computed, &view, (vectors, eight), name)?;
            table.push([
                name.into(),
                vectors.into(),
                Cell::decimals(printed, 1),
                Cell::measured(error),
                Cell::measured(100.0 * error / energy),
            ]);
            errors.push(error);
            pictures.push(picture);
        }
        pictures.push(view.picture(None, format!("cpca-figure-11-{name}"), format!("{name}, uncompressed"))?);
        rows.extend(falling(name, printed, &errors));
        all.push(errors);
    }
    for (at, vectors) in VECTORS.iter().enumerate() {
        let what = format!("squared error of the bumpy model over the smooth one's, n' = {vectors}");
        rows.push(order(what, PLACE, [PRINTED[0].2[at], PRINTED[1].2[at]], all[0][at] / all[1][at]));
    }
    let bird = shared.cpca.signal(BIRD, shared.models)?;
    let printed = bird.paper.size.clusters;
    let figures = [printed, bird.clusters(printed)].map(|count| number(count as f64, 0));
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, figures)],
        rows,
        questions: vec![QUESTION],
        tables: vec![table],
        pictures,
        ..EntryFindings::default()
    })
}

/// The error with a number of vectors, and a picture; with 8 by the clustering that Table 1 has.
fn with(
    computed: &ComputedSignal,
    view: &ModelView<'_>,
    (vectors, eight): (usize, &Clustering),
    name: &str,
) -> Result<(f64, NamedPicture), ReproduceError> {
    let size = computed.paper.size;
    let made;
    let clustering = if vectors == size.vectors {
        eight
    } else {
        made = computed.compressed(size.clusters, vectors, CpcaMethod::Iterative)?;
        &made
    };
    let picture =
        view.picture(Some(clustering), format!("cpca-figure-11-{name}-{vectors}"), format!("{name}, n' = {vectors}"))?;
    Ok((computed.error(clustering), picture))
}

/// How much the error falls from each number of vectors to the next.
fn falling(name: &str, printed: [f64; 4], errors: &[f64]) -> Vec<PaperRow> {
    let row = |at: usize| {
        let what = format!("{name}: squared error with n' = {} over n' = {}", VECTORS[at], VECTORS[at + 1]);
        order(what, PLACE, [printed[at], printed[at + 1]], errors[at] / errors[at + 1])
    };
    (0..3).map(row).collect()
}
