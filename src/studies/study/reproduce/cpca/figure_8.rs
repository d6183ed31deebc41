//! Figure 8: the speed-up of glossy Phong models by compression, and by a newer card.

use refsim::device::Profile;

use super::rates::{DrawnClusters, OWN_INPUTS, modelled_from_clusters, ratio_row, time_cells, uncompressed};
use super::signals::{GLOSSY_BUDDHA, HEAD, SIGNALS};
use super::{
    CARD, Dependence, EntryFindings, Method, PaperRow, Shared, StudyError, paper_row, paragraph, printed, printed_value,
};
use crate::card::frame_time::FrameTime;
use crate::cpca::on_card::model::TransferSize;
use crate::report::{Cell, Table};

/// Index of the signal, its name, its name in figure names, and the figure of its frames per second in Table 1.
const MODELS: [(usize, &str, &str, &str); 2] = [
    (HEAD, "head", "head", "cpca/rate-head-gloss-iso"),
    (GLOSSY_BUDDHA, "Buddha", "buddha", "cpca/rate-buddha-gloss-iso"),
];
/// Rows of an uncompressed matrix, as in section 7.
const ROWS: [usize; 2] = [25, 16];
/// "A Radeon 9800 runs 20% faster with CPCA".
const NEWER: &str = "r350";
const HOW: &str = "The Phong models have {} rows and {} clusters of {} vectors. Frame times on the {} are modelled from printed sizes and the overdraw of our own clusters with both optimisations of section 5.";
const NEWER_CARD: &str = "\"Runs {} % faster\" is in the paragraph on these models, so it is judged on them. The paper does not say which cards are \
    meant; the profiles are of the Pro cards. The host is the same: if it is slower than the card, a faster card gains nothing.";
const QUESTION: &str = "which models of the two Radeons were compared, and with what processor: from Pro to Pro, the core clock rises by less than the printed speed-up.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let mut table = Table::of(
        "Frame rates, compressed and uncompressed",
        "model overdraw Hz_printed Hz host_ms constants_ms draws_ms",
    );
    let (mut rows, mut gains, mut plain_gains) = (Vec::new(), Vec::new(), Vec::new());
    for (at, name, id, rate) in MODELS {
        let drawn = shared.get::<DrawnClusters>(at)?;
        let (model, size) = (SIGNALS[at].model, SIGNALS[at].size);
        let on = |card: &Profile| modelled_from_clusters(card, shared, (model, size), &drawn);
        let time = on(&Profile::named(CARD)?)?;
        let head = [name.into(), Cell::decimals(drawn.overdraw[3], 3), printed(rate)?.cell()];
        table.push(head.into_iter().chain(time_cells(&time)));
        rows.extend(without_compression(id, size)?);
        let faster = time.per_second() / uncompressed(of_rows(size, 25))?;
        rows.push(ratio_row(&format!("faster-{id}"), ((&time).into(), faster), OWN_INPUTS)?);
        // Without compression, too, the host's products and the card's drawing overlap.
        let host = 1.0 / uncompressed(of_rows(size, 25))?;
        let newer = on(&Profile::named(NEWER)?)?;
        let plain = |time: &FrameTime| 1.0 / host.max(time.draws.seconds());
        plain_gains.push(100.0 * (plain(&newer) / plain(&time) - 1.0));
        gains.push(100.0 * (newer.per_second() / time.per_second() - 1.0));
    }
    for (id, gains) in [("newer-card-uncompressed", plain_gains), ("newer-card", gains)] {
        // Both frames have the same work, so the gain is the ratio of clock rates, or 1 if the host is the bottleneck.
        let ours = (gains[0], Dependence::Predicted { from: OWN_INPUTS });
        let row = paper_row(&format!("cpca/{id}"), (NEWER, Method::Equation), ours)?;
        rows.push(row.with_readings(gains[1..].iter().copied()));
    }
    let size = SIGNALS[HEAD].size;
    Ok(EntryFindings::new(
        [
            paragraph(HOW, &[&size.rows, &size.clusters, &size.vectors, &CARD]),
            paragraph(NEWER_CARD, &[&printed_value("cpca/newer-card")?]),
        ],
        rows,
        [QUESTION],
        [table],
    ))
}

fn of_rows(size: TransferSize, rows: usize) -> TransferSize {
    TransferSize { rows, ..size }
}

/// Rows for rates without compression; one of these rates calibrated the host's rate.
fn without_compression(id: &str, size: TransferSize) -> Result<Vec<PaperRow>, StudyError> {
    let mut found = Vec::new();
    for rows in ROWS {
        let rate = (Method::Equation, uncompressed(of_rows(size, rows))?);
        let mut row = ratio_row(&format!("uncompressed-{id}-{rows}"), rate, OWN_INPUTS)?;
        if (id, rows) == ("head", 25) {
            row.dependence = Dependence::Calibrated { on: OWN_INPUTS };
        }
        found.push(row);
    }
    Ok(found)
}
