//! Table 1: static and iterative compression of seven signals.

use refsim::device::Profile;

use super::mesh_cost::CARD;
use super::rates::{OWN_INPUTS, modelled_from_clusters};
use super::signals::SIGNALS;
use super::{
    Bound, EntryFindings, Method, Origin, PaperFigure, PaperRow, Prose, ReproduceError, Shared, Standing, number, order,
};
use crate::report::{Cell, Table};
use crate::transfer::clustering::CpcaMethod;

/// Squared errors, static and iterative, of the rows: with the digits after the point.
#[expect(clippy::approx_constant, reason = "3.14 is a squared error, as printed")]
const PRINTED: [([f64; 2], u8); 7] = [
    ([563.0, 451.0], 0),
    ([10_996.0, 8524.0], 0),
    ([1992.0, 1439.0], 0),
    ([898.0, 294.0], 0),
    ([3.14, 0.668], 3),
    ([78.8, 43.7], 1),
    ([0.492, 0.432], 3),
];

/// Frames per second of the rows.
const RATES: [f64; 7] = [42.8, 24.2, 27.0, 45.0, 227.0, 58.5, 294.0];

const HOW: &str = "The paper's models and BRDFs are lost; ours are of {} to {} vertices, with as many points per cluster as the paper's. Its squared errors \
    are in units that depend on the BRDF: what can be compared is which of two is larger, and by how much.";
const TIMES: &str = "Frames are timed on the {} from printed sizes, the order of triangles in our models, and the overdraw of our own clusters with both \
    optimisations of section 5. Models of reduced size have few superclusters and so less of a border than the paper's: they flatter. What is judged is \
    which of two neighbors in the order of printed rates is the faster.";
const QUESTION: &str = "the models, the BRDFs and the scale of the squared error.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, ReproduceError> {
    let mut table = Table::of(
        "Squared errors",
        "signal vertices_printed vertices clusters vectors static_printed static iterative_printed iterative \
         ratio_printed ratio share_of_squares_%",
    );
    let (mut rows, mut counts) = (Vec::new(), Vec::new());
    for (at, (printed, decimals)) in PRINTED.into_iter().enumerate() {
        let (computed, iterative) = shared.cpca.iterative(at, shared.models)?;
        let size = SIGNALS[at].size;
        let still = computed.compressed(size.clusters, size.vectors, CpcaMethod::Static)?;
        let [still, iterative] = [&still, iterative].map(|clustering| computed.error(clustering));
        let energy = computed.energy();
        table.push([
            computed.paper.name.into(),
            size.vertices.into(),
            computed.signal.points().into(),
            computed.clusters(size.clusters).into(),
            size.vectors.into(),
            Cell::decimals(printed[0], decimals),
            Cell::measured(still),
            Cell::decimals(printed[1], decimals),
            Cell::measured(iterative),
            Cell::ratio(printed[0] / printed[1]),
            Cell::ratio(still / iterative),
            Cell::measured(100.0 * iterative / energy),
        ]);
        counts.push(computed.signal.points() as f64);
        let what = format!("static over iterative error, {}", computed.paper.name);
        rows.push(order(what, "table 1", printed, still / iterative));
    }
    let (ordered, times) = rates(shared)?;
    rows.extend(ordered);
    let [least, most] =
        [counts.iter().copied().fold(f64::INFINITY, f64::min), counts.iter().copied().fold(0.0, f64::max)];
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, [number(least, 0), number(most, 0)]), Prose::new(TIMES, [CARD.to_owned()])],
        rows,
        questions: vec![QUESTION],
        tables: vec![table, times],
        ..EntryFindings::default()
    })
}

/// Rows on frame rates, and on which of two neighbours in the order of the printed ones is higher.
fn rates(shared: &Shared) -> Result<(Vec<PaperRow>, Table), ReproduceError> {
    let mut table = Table::of(
        "Frames per second, modelled from our overdraw",
        "signal overdraw_original overdraw printed ours host_ms constants_ms draws_ms vertices_run",
    );
    let (mut found, card) = (Vec::new(), Profile::named(CARD)?);
    for (at, printed) in RATES.into_iter().enumerate() {
        let (paper, drawn) = (&SIGNALS[at], shared.cpca.drawn(at, shared.models)?);
        let time = modelled_from_clusters(&card, &shared.cpca, (paper.model, paper.size), drawn)?;
        table.push([
            paper.name.into(),
            Cell::decimals(drawn.overdraw[0], 3),
            Cell::decimals(drawn.overdraw[3], 3),
            Cell::decimals(printed, 1),
            Cell::measured(time.per_second()),
            Cell::measured(1e3 * time.host.seconds()),
            Cell::measured(1e3 * time.state.seconds()),
            Cell::measured(1e3 * time.draws.seconds()),
            time.vertices_run.into(),
        ]);
        found.push((paper.name, printed, time.per_second()));
    }
    found.sort_by(|one, other| other.1.total_cmp(&one.1));
    let rows = found.windows(2).map(|pair| {
        let [(faster, above, ours), (slower, below, other)] = [pair[0], pair[1]];
        let origin = Origin::Implied(format!("{above} / {below}"));
        let target = PaperFigure { origin, ..PaperFigure::printed(above / below, 2, "times", "table 1") };
        let what = format!("frames per second of {faster} over {slower}");
        let ours = (ours / other, Standing::Predicted { from: OWN_INPUTS });
        PaperRow::new(what, (CARD, Method::Pipeline), target, ours, Bound::Order)
    });
    Ok((rows.collect(), table))
}
