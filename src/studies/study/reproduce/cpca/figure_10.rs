//! Figure 10: principal components alone, vector quantisation alone, and both.

use refsim::device::Profile;

use super::rates::{DrawnClusters, OWN_INPUTS, modelled_from_clusters, rate_row};
use super::signals::{BIRD, iterative};
use super::{CARD, EntryFindings, Shared, StudyError, paragraph, printed, solved};
use crate::card::frame_time::FrameTime;
use crate::clustering::{Clustering, CpcaMethod};
use crate::cpca::on_card::model::TransferSize;
use crate::report::{Cell, Table};

/// Name, printed numbers of clusters and vectors, and the figures of squared error and frames per second, in the order
/// of the figure. CPCA's error is one of those of Figure 11.
const ENCODINGS: [(&str, usize, usize, [&str; 2]); 3] = [
    ("PCA", 1, 20, ["cpca/error-pca", "cpca/rate-pca"]),
    ("VQ", 1792, 0, ["cpca/error-vq", "cpca/rate-vq"]),
    ("CPCA", 256, 8, ["cpca/error-bird-8", "cpca/rate-cpca"]),
];

const HOW: &str = "The figure matches frame rates, not storage: by section 4.1's metric its three encodings store {} \
    M, {} M and {} M numbers. In the rows of section 8, vector quantization and principal components each have as much \
    storage as CPCA. All encodings use {} points of {} numbers.";
const QUESTION: &str = "the model, its BRDF and the scale of the squared error.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let (computed, both) = iterative(shared, BIRD)?;
    let (card, still) = (Profile::named(CARD)?, CpcaMethod::Static);
    let components = computed.compressed_to(1, ENCODINGS[0].2, still)?;
    let quantised = computed.compressed(ENCODINGS[1].1, 0, still)?;
    let mut table = Table::of(
        "Encodings",
        "encoding clusters_printed clusters vectors stored_numbers squared_error_printed squared_error Hz_printed Hz",
    );
    let (mut errors, mut times) = ([0.0; 3], [FrameTime::default(); 3]);
    for (at, clustering) in [&components, &quantised, &*both].into_iter().enumerate() {
        let (name, clusters, vectors, [error, rate]) = ENCODINGS[at];
        let size = TransferSize { clusters, vectors, ..computed.paper.size };
        let drawn = DrawnClusters::new(&computed, clustering)?;
        times[at] = modelled_from_clusters(&card, shared, (computed.paper.model, size), &drawn)?;
        errors[at] = computed.error(clustering);
        let of_print = [clusters.into(), Cell::decimals(printed(error)?.value, 1)];
        let timed = [printed(rate)?.cell(), Cell::measured(times[at].per_second())];
        table.push(line(name, clustering, of_print, errors[at]).into_iter().chain(timed));
    }
    let [of_pca, of_vq, of_both] = errors;
    let mut rows = vec![
        solved("pca-over-cpca", of_pca / of_both)?,
        solved("vq-over-cpca", of_vq / of_both)?,
        solved("pca-over-vq", of_pca / of_vq)?,
    ];
    // The same storage as both together.
    let (n, points, budget) = (computed.signal.dimension(), computed.signal.points(), both.stored_numbers());
    let clusters = (budget / n).clamp(1, points);
    let vectors = (budget.saturating_sub(n) / (points + n)).clamp(1, n);
    for (name, id, clusters, vectors) in
        [("VQ", "equal-storage-vq", clusters, 0), ("PCA", "equal-storage-pca", 1, vectors)]
    {
        let clustering = computed.compressed_to(clusters, vectors, still)?;
        let error = computed.error(&clustering);
        let empty = || [Cell::Empty, Cell::Empty];
        let line = line(&format!("{name}, with CPCA's storage"), &clustering, empty(), error);
        table.push(line.into_iter().chain(empty()));
        rows.push(solved(id, error / of_both)?);
    }
    // The rate of both together is the one in Table 1.
    rows.extend([rate_row("rate-pca", &times[0], OWN_INPUTS)?, rate_row("rate-vq", &times[1], OWN_INPUTS)?]);
    let [pca, vq, cpca] = ENCODINGS.map(|(_, clusters, vectors, _)| {
        let size = TransferSize { clusters, vectors, ..computed.paper.size };
        (size.stored_numbers() as f64 / 1e6, 2)
    });
    Ok(EntryFindings::new([paragraph(HOW, &[&pca, &vq, &cpca, &points, &n])], rows, [QUESTION], [table]))
}

fn line(name: &str, clustering: &Clustering, [clusters, printed]: [Cell; 2], error: f64) -> [Cell; 7] {
    let vectors = clustering.subspaces().iter().map(|subspace| subspace.len()).max().unwrap_or(0);
    [
        name.into(),
        clusters,
        clustering.subspaces().len().into(),
        vectors.into(),
        clustering.stored_numbers().into(),
        printed,
        Cell::measured(error),
    ]
}
