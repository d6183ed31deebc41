//! Table 1: static and iterative compression of seven signals.

use super::signals::SIGNALS;
use super::{EntryFindings, Prose, ReproduceError, Shared, number, order};
use crate::prt::cpca::CpcaMethod;
use crate::report::{Cell, Table};

/// Squared errors, static and iterative, of the rows: with the digits behind the point.
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

const HOW: &str = "The paper's models and BRDFs are lost; ours are of {} to {} vertices, with as many points per cluster as the paper's. Its squared errors \
    are in units that depend on the BRDF: what can be compared is which of two is larger, and by how much.";
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
    let [least, most] =
        [counts.iter().copied().fold(f64::INFINITY, f64::min), counts.iter().copied().fold(0.0, f64::max)];
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, [number(least, 0), number(most, 0)])],
        rows,
        questions: vec![QUESTION],
        tables: vec![table],
        ..EntryFindings::default()
    })
}
