//! Table 1: static and iterative compression of seven signals.

use refsim::device::Profile;

use super::rates::{DrawnClusters, OWN_INPUTS, modelled_from_clusters, rate_row, time_cells};
use super::signals::{SIGNALS, iterative};
use super::{CARD, EntryFindings, PaperRow, Shared, StudyError, ends, paragraph, printed, solved};
use crate::clustering::CpcaMethod;
use crate::report::{Cell, Table};
use crate::study::reproduce::PaperFigure;

/// Names of the rows' signals in figure names.
const IDS: [&str; 7] = [
    "buddha-gloss-iso",
    "buddha-gloss-anis",
    "buddha-subsurf",
    "bird-gloss-anis",
    "bird-diffuse",
    "head-gloss-iso",
    "polys-diffuse",
];

/// Returns the printed squared errors of a signal, static and iterative. For two signals, Figure 11 has more digits of
/// the iterative errors.
fn errors(id: &str) -> Result<[&'static PaperFigure; 2], StudyError> {
    let iterative = match id {
        "buddha-gloss-anis" => "cpca/error-buddha-8".to_owned(),
        "bird-gloss-anis" => "cpca/error-bird-8".to_owned(),
        _ => format!("cpca/iterative-{id}"),
    };
    Ok([printed(&format!("cpca/static-{id}"))?, printed(&iterative)?])
}

const HOW: &str = "The paper's models and BRDFs are lost; ours have {} to {} vertices, with as many points per cluster \
    as the paper's. Its squared errors are in units that depend on the BRDF, so only ratios of errors can be compared.";
const TIMES: &str = "Frame times on the {} are modelled from printed sizes, the order of triangles in our models, and \
    the overdraw of our own clusters with both optimisations of section 5. Models of reduced size have few \
    superclusters, and thus less border than the paper's: their rates are flattering.";
const QUESTION: &str = "the models, the BRDFs and the scale of the squared error.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let mut table = Table::of(
        "Squared errors",
        "signal vertices_printed vertices clusters vectors static_printed static iterative_printed iterative \
         ratio_printed ratio share_of_squares_%",
    );
    let (mut rows, mut counts) = (Vec::new(), Vec::new());
    for (at, id) in IDS.into_iter().enumerate() {
        let [of_static, of_iterative] = errors(id)?;
        let (computed, iterative) = iterative(shared, at)?;
        let size = SIGNALS[at].size;
        let still = computed.compressed(size.clusters, size.vectors, CpcaMethod::Static)?;
        let [still, iterative] = [&still, &*iterative].map(|clustering| computed.error(clustering));
        let energy = computed.energy();
        table.push([
            computed.paper.name.into(),
            size.vertices.into(),
            computed.signal.points().into(),
            computed.clusters(size.clusters).into(),
            size.vectors.into(),
            of_static.cell(),
            Cell::measured(still),
            of_iterative.cell(),
            Cell::measured(iterative),
            Cell::ratio(of_static.value / of_iterative.value),
            Cell::ratio(still / iterative),
            Cell::measured(100.0 * iterative / energy),
        ]);
        counts.push(computed.signal.points() as f64);
        rows.push(solved(&format!("gain-{id}"), still / iterative)?);
    }
    let (timed, times) = rates(shared)?;
    rows.extend(timed);
    let [least, most] = ends(counts.into_iter());
    Ok(EntryFindings::new(
        [paragraph(HOW, &[&least, &most]), paragraph(TIMES, &[&CARD])],
        rows,
        [QUESTION],
        [table, times],
    ))
}

fn rates(shared: &Shared) -> Result<(Vec<PaperRow>, Table), StudyError> {
    let mut table = Table::of(
        "Frames per second, modelled from our overdraw",
        "signal overdraw_original overdraw printed ours host_ms constants_ms draws_ms vertices_run",
    );
    let (mut rows, card) = (Vec::new(), Profile::named(CARD)?);
    for (at, id) in IDS.into_iter().enumerate() {
        let (paper, drawn) = (&SIGNALS[at], shared.get::<DrawnClusters>(at)?);
        let time = modelled_from_clusters(&card, shared, (paper.model, paper.size), &drawn)?;
        let row = rate_row(&format!("rate-{id}"), &time, OWN_INPUTS)?;
        let [original, .., both] = drawn.overdraw.map(|overdraw| Cell::decimals(overdraw, 3));
        let head = [paper.name.into(), original, both, row.target.cell()];
        table.push(head.into_iter().chain(time_cells(&time)).chain([time.vertices_run.into()]));
        rows.push(row);
    }
    Ok((rows, table))
}
