//! Figure 10: principal components alone, vector quantisation alone, and both.

use refsim::device::Profile;

use super::drawn::DrawnClusters;
use super::figure_3::EYE;
use super::mesh_cost::CARD;
use super::rates::{OWN_INPUTS, modelled_from_clusters, rate_row};
use super::signals::BIRD;
use super::views::{ModelView, RED_AND_BLUE};
use super::{
    Bound, EntryFindings, HOST, Method, Origin, PaperFigure, PaperRow, Prose, ReproduceError, Shared, Standing, number,
    order,
};
use crate::cpca::on_card::model::TransferSize;
use crate::report::{Cell, Table};
use crate::sphere::HarmonicLight;
use crate::transfer::clustering::{Clustering, CpcaMethod};

const PLACE: &str = "figure 10";
/// Name, printed clusters, vectors and squared error, in the order of the figure.
const ENCODINGS: [(&str, usize, usize, f64); 3] =
    [("PCA", 1, 20, 101_304.0), ("VQ", 1792, 0, 14_799.0), ("CPCA", 256, 8, 294.4)];
/// Printed frames per second.
const RATES: [f64; 3] = [45.7, 41.8, 45.5];

const HOW: &str = "The figure matches frame rates, not storage: by section 4.1's metric its three encodings hold {} M, {} M and {} M numbers. \
    The rows of section 8 give vector quantization and principal components as much storage as both together. All on {} points of {} numbers.";
const QUESTION: &str = "the model, its BRDF and the scale of the squared error.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, ReproduceError> {
    let (computed, both) = shared.cpca.iterative(BIRD, shared.models)?;
    let still = CpcaMethod::Static;
    let components = computed.compressed_to(1, ENCODINGS[0].2, still)?;
    let quantised = computed.compressed(ENCODINGS[1].1, 0, still)?;
    let clusterings = [&components, &quantised, both];
    let errors = clusterings.map(|clustering| computed.error(clustering));
    let card = Profile::named(CARD)?;
    let mut rates = [0.0; 3];
    for ((rate, clustering), (_, clusters, vectors, _)) in rates.iter_mut().zip(clusterings).zip(ENCODINGS) {
        let size = TransferSize { clusters, vectors, ..computed.paper.size };
        let drawn = DrawnClusters::new(computed, clustering)?;
        *rate = modelled_from_clusters(&card, &shared.cpca, (computed.paper.model, size), &drawn)?.per_second();
    }
    let mut table = encodings(&clusterings, errors, rates);
    let pair = |above: usize, below: usize| {
        let what = format!("squared error of {} over {}'s", ENCODINGS[above].0, ENCODINGS[below].0);
        order(what, PLACE, [ENCODINGS[above].3, ENCODINGS[below].3], errors[above] / errors[below])
    };
    let mut rows = vec![pair(0, 2), pair(1, 2), pair(0, 1)];
    // As much storage as both together.
    let (n, points, budget) = (computed.signal.dimension(), computed.signal.points(), both.stored_numbers());
    let clusters = (budget / n).clamp(1, points);
    let vectors = (budget.saturating_sub(n) / (points + n)).clamp(1, n);
    for (name, clusters, vectors) in [("VQ", clusters, 0), ("PCA", 1, vectors)] {
        let clustering = computed.compressed_to(clusters, vectors, still)?;
        let error = computed.error(&clustering);
        let line = line(&format!("{name}, storage of CPCA"), &clustering, (None, None), error);
        table.push(line.into_iter().chain([Cell::Empty, Cell::Empty]));
        rows.push(equal_storage(name, error / errors[2]));
    }
    rows.extend([0, 1].map(|at| matched(at, rates)));
    let light = HarmonicLight::red_and_blue(5);
    let view = ModelView::new(computed, &light, EYE)?;
    let mut pictures = Vec::new();
    for ((name, ..), clustering) in ENCODINGS.iter().zip(clusterings) {
        pictures.push(view.picture(Some(clustering), format!("cpca-figure-10-{name}"), (*name).to_owned())?);
    }
    pictures.push(view.picture(None, "cpca-figure-10-uncompressed".to_owned(), "uncompressed".to_owned())?);
    pictures.push(view.light("cpca-figure-10", RED_AND_BLUE)?);
    let stored = ENCODINGS.map(|(_, clusters, vectors, _)| {
        let size = TransferSize { clusters, vectors, ..computed.paper.size };
        number(size.stored_numbers() as f64 / 1e6, 2)
    });
    let sizes = [points, n].map(|count| number(count as f64, 0));
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, stored.into_iter().chain(sizes))],
        rows,
        questions: vec![QUESTION],
        tables: vec![table],
        pictures,
        ..EntryFindings::default()
    })
}

/// Row on "such that rendering performance matched that from CPCA".
fn matched(at: usize, rates: [f64; 3]) -> PaperRow {
    let percent = |rates: [f64; 3]| 100.0 * rates[at] / rates[2];
    let origin = Origin::Implied(format!("{} / {}", RATES[at], RATES[2]));
    let target = PaperFigure { origin, ..PaperFigure::printed(percent(RATES), 0, "%", PLACE) };
    let what = format!("frames per second of {}, of CPCA's", ENCODINGS[at].0);
    rate_row(what, target, percent(rates), OWN_INPUTS)
}

fn encodings(clusterings: &[&Clustering; 3], errors: [f64; 3], rates: [f64; 3]) -> Table {
    let mut table = Table::of(
        "Encodings",
        "encoding clusters_printed clusters vectors stored_numbers squared_error_printed squared_error Hz_printed Hz",
    );
    for (at, ((name, clusters, _, printed), clustering)) in ENCODINGS.iter().zip(clusterings).enumerate() {
        let timed = [Cell::decimals(RATES[at], 1), Cell::measured(rates[at])];
        let line = line(name, clustering, (Some(*clusters), Some(*printed)), errors[at]);
        table.push(line.into_iter().chain(timed));
    }
    table
}

fn line(
    name: &str,
    clustering: &Clustering,
    (clusters, printed): (Option<usize>, Option<f64>),
    error: f64,
) -> [Cell; 7] {
    let vectors = clustering.subspaces().iter().map(|subspace| subspace.len()).max().unwrap_or(0);
    [
        name.into(),
        clusters.into(),
        clustering.subspaces().len().into(),
        vectors.into(),
        clustering.stored_numbers().into(),
        printed.map_or(Cell::Empty, |printed| Cell::decimals(printed, 1)),
        Cell::measured(error),
    ]
}

/// Row on "it reduces error better than VQ or PCA for the same storage".
fn equal_storage(name: &str, ours: f64) -> PaperRow {
    let origin = Origin::Inferred("section 8 says that the error is less for the same storage".to_owned());
    let target = PaperFigure { origin, ..PaperFigure::printed(1.0, 2, "times", "section 8") };
    let what = format!("squared error of {name} over CPCA's at equal storage");
    PaperRow::new(what, (HOST, Method::Solver), target, (ours, Standing::Counted), Bound::AtLeast)
}
