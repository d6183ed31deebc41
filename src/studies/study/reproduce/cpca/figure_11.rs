//! Figure 11: the number of vectors per cluster, on a bumpy and a smooth model.

use refsim::device::Profile;

use super::drawn::DrawnClusters;
use super::figure_3::EYE;
use super::mesh_cost::CARD;
use super::rates::{OWN_INPUTS, modelled_from_clusters, rate_row, uncompressed};
use super::signals::{BIRD, BUDDHA, ComputedSignal};
use super::views::{ModelView, RED_AND_BLUE};
use super::{EntryFindings, PaperFigure, PaperRow, Prose, ReproduceError, Shared, number, order};
use crate::cpca::on_card::model::TransferSize;
use crate::report::{Cell, NamedPicture, Table};
use crate::sphere::HarmonicLight;
use crate::transfer::clustering::{Clustering, CpcaMethod};

const PLACE: &str = "figure 11";
const VECTORS: [usize; 4] = [2, 4, 8, 12];
/// Printed squared errors by [`VECTORS`]: the signal, its name, errors.
const PRINTED: [(usize, &str, [f64; 4]); 2] = [
    (BUDDHA, "Buddha", [40_353.5, 21_077.5, 8_524.1, 4_413.01]),
    (BIRD, "bird", [9_510.75, 2_353.09, 294.421, 66.7495]),
];

/// Frames per second by [`VECTORS`], and without compression, in the order of [`PRINTED`].
const RATES: [([f64; 4], f64); 2] = [([40.4, 36.4, 24.2, 18.7], 3.3), ([58.9, 57.1, 45.5, 31.9], 3.7)];

const HOW: &str = "Iterative compression of glossy anisotropic transfer to {} clusters, {} of them on a model of our size. The paper's bird loses error quickly, \
    its Buddha slowly. Pictures are exposed as the one without compression.";
const QUESTION: &str = "the models, the BRDF and the scale of the squared error.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, ReproduceError> {
    let mut table = Table::of("Squared errors", "model vectors printed ours share_of_squares_% Hz_printed Hz");
    let (mut rows, mut timed, mut pictures, mut all) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let light = HarmonicLight::red_and_blue(5);
    let card = Profile::named(CARD)?;
    for ((at, name, printed), (frames, without)) in PRINTED.into_iter().zip(RATES) {
        let (computed, eight) = shared.cpca.iterative(at, shared.models)?;
        let energy = computed.energy();
        let view = ModelView::new(computed, &light, EYE)?;
        let (mut errors, mut rates) = (Vec::new(), Vec::new());
        for ((vectors, printed), frames) in VECTORS.into_iter().zip(printed).zip(frames) {
            let (error, picture, drawn) = with(computed, &view, (vectors, eight), name)?;
            let sizes = (computed.paper.model, TransferSize { vectors, ..computed.paper.size });
            let rate = modelled_from_clusters(&card, &shared.cpca, sizes, &drawn)?.per_second();
            table.push([
                name.into(),
                vectors.into(),
                Cell::decimals(printed, 1),
                Cell::measured(error),
                Cell::measured(100.0 * error / energy),
                Cell::decimals(frames, 1),
                Cell::measured(rate),
            ]);
            errors.push(error);
            rates.push(rate);
            pictures.push(picture);
        }
        pictures.push(view.picture(None, format!("cpca-figure-11-{name}"), format!("{name}, uncompressed"))?);
        pictures.push(view.light(&format!("cpca-figure-11-{name}"), RED_AND_BLUE)?);
        rows.extend(falling(name, "squared error", printed, &errors));
        timed.extend(falling(name, "frames per second", frames, &rates));
        timed.push(rate_row(
            format!("{name}: frames per second without compression"),
            PaperFigure::printed(without, 1, "Hz", PLACE),
            uncompressed(computed.paper.size)?,
            OWN_INPUTS,
        ));
        all.push(errors);
    }
    for (at, vectors) in VECTORS.iter().enumerate() {
        let what = format!("squared error of the bumpy model over the smooth one's, n' = {vectors}");
        rows.push(order(what, PLACE, [PRINTED[0].2[at], PRINTED[1].2[at]], all[0][at] / all[1][at]));
    }
    rows.extend(timed);
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

/// Computes the error with a number of vectors, a picture, and the drawing cost; 8 vectors use the clustering of Table
/// 1.
fn with(
    computed: &ComputedSignal,
    view: &ModelView<'_>,
    (vectors, eight): (usize, &Clustering),
    name: &str,
) -> Result<(f64, NamedPicture, DrawnClusters), ReproduceError> {
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
    Ok((computed.error(clustering), picture, DrawnClusters::new(computed, clustering)?))
}

/// Rows on the decrease of a value from each number of vectors to the next.
fn falling(name: &str, what: &str, printed: [f64; 4], ours: &[f64]) -> Vec<PaperRow> {
    let row = |at: usize| {
        let what = format!("{name}: {what} with n' = {} over n' = {}", VECTORS[at], VECTORS[at + 1]);
        order(what, PLACE, [printed[at], printed[at + 1]], ours[at] / ours[at + 1])
    };
    (0..3).map(row).collect()
}
