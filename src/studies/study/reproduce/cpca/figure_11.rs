//! Figure 11: the number of vectors per cluster, on a Buddha and a bird.

use refsim::device::Profile;

use super::rates::{DrawnClusters, OWN_INPUTS, modelled_from_clusters, rate_row, ratio_row, uncompressed};
use super::signals::{BIRD, BUDDHA, ComputedSignal, iterative};
use super::{
    CARD, Contradiction, EntryFindings, Method, PaperRow, Shared, StudyError, number, paragraph, printed, solved,
};
use crate::clustering::{Clustering, CpcaMethod};
use crate::cpca::on_card::model::TransferSize;
use crate::report::{Cell, Table};

const VECTORS: [usize; 4] = [2, 4, 8, 12];
/// Index of the signal, its name, its name in figure names, and the figure of its frames per second with 8 vectors,
/// which is printed elsewhere too.
const MODELS: [(usize, &str, &str, &str); 2] =
    [(BUDDHA, "Buddha", "buddha", "cpca/rate-buddha-gloss-anis"), (BIRD, "bird", "bird", "cpca/rate-cpca")];

const HOW: &str = "Glossy anisotropic transfer is compressed iteratively to {} clusters, scaled to {} on a model of \
    our size. In the paper, the bird's error falls quickly, the Buddha's slowly.";
const QUESTION: &str = "the models, the BRDF and the scale of the squared error.";

/// Reason why the error falls with more vectors.
const FALLS: &str = "vectors are added to existing clusters, and neither a vector nor a reassignment adds error";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let mut table = Table::of("Squared errors", "model vectors printed ours share_of_squares_% Hz_printed Hz");
    let (mut rows, mut timed, mut all) = (Vec::new(), Vec::new(), Vec::new());
    let card = Profile::named(CARD)?;
    let mut eight_vectors = Vec::new();
    for (at, name, id, of_eight) in MODELS {
        let (computed, eight) = iterative(shared, at)?;
        let energy = computed.energy();
        let mut errors = Vec::new();
        for vectors in VECTORS {
            let (error, drawn) = with(&computed, vectors, &eight)?;
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
        }
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
    let how = paragraph(HOW, &[&printed, &bird.clusters(printed)]);
    Ok(EntryFindings::new([how], rows, [QUESTION], [table]))
}

/// Row for "more than a factor of 10", for both models; the paper's own rates of the Buddha contradict it.
fn by_compression(ours: &[f64]) -> Result<PaperRow, StudyError> {
    let row = ratio_row("faster-by-compression", (Method::Pipeline, ours[0]), OWN_INPUTS)?
        .with_readings(ours[1..].iter().copied());
    let [with, without] =
        ["cpca/rate-buddha-gloss-anis", "cpca/rate-buddha-uncompressed"].map(|id| printed(id).map(|rate| rate.value));
    let factor = with? / without?;
    let least = number(factor, 1);
    let how =
        format!("{least} times for the Buddha: from its rates with 8 vectors and without compression in figure 11");
    Ok(row.contradicted(Contradiction::if_holds(factor < printed("cpca/faster-by-compression")?.value, how)))
}

/// Computes the error with a number of vectors, and the drawing cost; for 8 vectors, uses the clustering of Table 1.
fn with(computed: &ComputedSignal, vectors: usize, eight: &Clustering) -> Result<(f64, DrawnClusters), StudyError> {
    let size = computed.paper.size;
    let made;
    let clustering = if vectors == size.vectors {
        eight
    } else {
        made = computed.compressed(size.clusters, vectors, CpcaMethod::Iterative)?;
        &made
    };
    Ok((computed.error(clustering), DrawnClusters::new(computed, clustering)?))
}
