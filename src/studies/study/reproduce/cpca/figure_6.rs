//! Figure 6: diffuse transfer of order 10 on a ground below a blocker.

use super::figure_3::over_readings;
use super::signals::{ComputedSignal, POLYGONS};
use super::{EntryFindings, Shared, StudyError, paragraph};
use crate::clustering::CpcaMethod;
use crate::report::{Cell, Table};

/// "m_c = 64"; Table 1's row for the figure has 32.
const CLUSTERS: [usize; 2] = [64, 32];
const VECTORS: [usize; 3] = [1, 2, 4];
const ORDER: usize = 10;

const HOW: &str = "The scene is a ground and a blocker with {} vertices in all, under light of order {}. The caption has {} clusters, Table 1's row \
    for the figure {}: both are computed, scaled to a model of our size, and the row has all of them.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let computed = shared.get::<ComputedSignal>(POLYGONS)?;
    let mut table =
        Table::of("Squared errors", "clusters_printed clusters vectors static iterative static_over_iterative");
    let mut ratios = Vec::new();
    for printed in CLUSTERS {
        for vectors in VECTORS {
            let error = |method| Ok::<_, StudyError>(computed.error(&computed.compressed(printed, vectors, method)?));
            let errors = [error(CpcaMethod::Static)?, error(CpcaMethod::Iterative)?];
            let ratio = errors[0] / errors[1];
            let counts = [printed, computed.clusters(printed), vectors].map(Cell::from);
            table.push(counts.into_iter().chain(errors.map(Cell::measured)).chain([Cell::ratio(ratio)]));
            ratios.push(ratio);
        }
    }
    let how = paragraph(HOW, &[&computed.signal.points(), &ORDER, &CLUSTERS[0], &CLUSTERS[1]]);
    Ok(EntryFindings::new([how], [over_readings("figure-6", &ratios)?], [], [table]))
}
