//! Figure 11: the number of vectors per cluster, on a Buddha and a bird.

use refsim::device::Profile;

use super::drawn::DrawnClusters;
use super::figure_3::EYE;
use super::mesh_cost::CARD;
use super::rates::{OWN_INPUTS, modelled_from_clusters, rate_row, ratio_row, uncompressed};
use super::shared::iterative;
use super::signals::{BIRD, BUDDHA, ComputedSignal};
use super::views::{ModelView, RED_AND_BLUE};
use super::{Contradiction, EntryFindings, Method, PaperRow, Prose, Shared, StudyError, number, printed, solved};
use crate::cpca::on_card::model::TransferSize;
use crate::report::{Cell, NamedPicture, PictureGrid, Table};
use crate::sphere::HarmonicLight;
use crate::transfer::clustering::{Clustering, CpcaMethod};

const VECTORS: [usize; 4] = [2, 4, 8, 12];
/// Signal, its name, the same in the names of its figures, and the figure of its frames per second with 8 vectors:
/// those are printed elsewhere too.
const MODELS: [(usize, &str, &str, &str); 2] =
    [(BUDDHA, "Buddha", "buddha", "cpca/rate-buddha-gloss-anis"), (BIRD, "bird", "bird", "cpca/rate-cpca")];

const HOW: &str = "Iterative compression of glossy anisotropic transfer to {} clusters, {} of them on a model of our size. The paper's bird loses error quickly, \
    its Buddha slowly. Pictures are exposed as the one without compression.";
const QUESTION: &str = "the models, the BRDF and the scale of the squared error.";

/// Reason why the error falls with more vectors.
const FALLS: &str =
    "more vectors are added to the clusters of fewer, and neither a vector nor a reassignment adds error";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let mut table = Table::of("Squared errors", "model vectors printed ours share_of_squares_% Hz_printed Hz");
    let (mut rows, mut timed, mut all, mut lights) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let columns = VECTORS.map(|vectors| format!("n' = {vectors}")).into_iter().chain(["uncompressed".to_owned()]);
    let mut grid = PictureGrid::new("Figure 11", columns);
    let light = HarmonicLight::red_and_blue(5);
    let card = Profile::named(CARD)?;
    let mut eight_vectors = Vec::new();
    for (at, name, id, of_eight) in MODELS {
        let (computed, eight) = iterative(shared, at)?;
        let energy = computed.energy();
        let view = ModelView::new(computed, &light, EYE)?;
        let (mut errors, mut pictures) = (Vec::new(), Vec::new());
        for vectors in VECTORS {
            let (error, picture, drawn) = with(computed, &view, (vectors, eight), name)?;
            let sizes = (computed.paper.model, TransferSize { vectors, ..computed.paper.size });
            let time = modelled_from_clusters(&card, shared, sizes, &drawn)?;
            let frames = if vectors == computed.paper.size.vectors {
                of_eight.to_owned()
            } else {
                let id = format!("rate-{id}-{vectors}");
                timed.push(rate_row(&id, &time, OWN_INPUTS)?);
                format!("cpca/{id}")
            };
            table.push([
                name.into(),
                vectors.into(),
                printed(&format!("cpca/error-{id}-{vectors}"))?.cell(),
                Cell::measured(error),
                Cell::measured(100.0 * error / energy),
                printed(&frames)?.cell(),
                Cell::measured(time.per_second()),
            ]);
            if vectors == computed.paper.size.vectors {
                eight_vectors.push(time.per_second() / uncompressed(computed.paper.size)?);
            }
            errors.push(error);
            pictures.push(picture);
        }
        pictures.push(view.picture(None, format!("cpca-figure-11-{name}"), format!("{name}, uncompressed"))?);
        grid = grid.row(name, pictures);
        lights.push(view.light(&format!("cpca-figure-11-{name}"), RED_AND_BLUE)?);
        for (pair, vectors) in errors.windows(2).zip(VECTORS) {
            let row = solved(&format!("falls-{id}-{vectors}"), pair[0] / pair[1])?;
            rows.push(row.confined([1.0, f64::INFINITY], FALLS));
        }
        let rate = (Method::Equation, uncompressed(computed.paper.size)?);
        timed.push(ratio_row(&format!("rate-{id}-uncompressed"), rate, OWN_INPUTS)?);
        all.push(errors);
    }
    for (at, vectors) in VECTORS.iter().enumerate() {
        rows.push(solved(&format!("bumpy-over-smooth-{vectors}"), all[0][at] / all[1][at])?);
    }
    rows.extend(timed);
    rows.push(by_compression(&eight_vectors)?);
    let bird = shared.get::<ComputedSignal>(BIRD)?;
    let printed = bird.paper.size.clusters;
    let figures = [printed, bird.clusters(printed)].map(|count| number(count as f64, 0));
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, figures)],
        rows,
        questions: vec![QUESTION],
        tables: vec![table],
        // Both models have the same light.
        pictures: vec![grid.row("", lights.pop())],
        ..EntryFindings::default()
    })
}

/// Row on "more than a factor of 10", of both models, which the paper's own rates of the Buddha contradict.
fn by_compression(ours: &[f64]) -> Result<PaperRow, StudyError> {
    let row = ratio_row("faster-by-compression", (Method::Pipeline, ours[0]), OWN_INPUTS)?
        .with_readings(ours[1..].iter().copied());
    let [with, without] =
        ["cpca/rate-buddha-gloss-anis", "cpca/rate-buddha-uncompressed"].map(|id| printed(id).map(|rate| rate.value));
    let factor = with? / without?;
    let least = number(factor, 1);
    let how = format!("{least} times for the Buddha: its rates with 8 vectors and without compression in figure 11");
    Ok(row.contradicted(Contradiction::if_holds(factor < printed("cpca/faster-by-compression")?.value, how)))
}

/// Computes the error with a number of vectors, a picture, and the drawing cost; 8 vectors use the clustering of Table
/// 1.
fn with(
    computed: &ComputedSignal,
    view: &ModelView<'_>,
    (vectors, eight): (usize, &Clustering),
    name: &str,
) -> Result<(f64, NamedPicture, DrawnClusters), StudyError> {
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
