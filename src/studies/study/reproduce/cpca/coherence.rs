//! The table of section 7: overdraw before and after the two optimisations of section 5.

use super::rates::{BUDGET, COLUMN_IDS, DrawnClusters, INPUTS, rates, ratio_row};
use super::signals::{BIRD, BUDDHA};
use super::{
    CARD, Contradiction, EntryFindings, Method, PaperRow, REGISTERS, Shared, StudyError, ends, paragraph, printed,
    solved,
};
use crate::report::{Cell, Table};

/// Index of the signal, its name, and its name in figure names.
const MODELS: [(usize, &str, &str); 2] = [(BUDDHA, "Buddha", "buddha"), (BIRD, "bird", "bird")];

const HOW: &str = "Overdraw is the mean number of clusters, or superclusters, among a triangle's vertices. Reclassification may add {} % to the \
    error; superclusters fill {} registers, {} clusters each. \"sc+rec\" is reclassification, then superclusters. Our models have as many points per \
    cluster as the paper's, so that clusters have the same border relative to their area.";
const TIMES: &str = "Frame times on the {} are modelled from sizes, the printed overdraw, and the order of triangles in our models: products on the \
    host, constants, and vertices that miss the cache of finished vertices; pixels take no time. Host and card work in parallel.";
const ORDER: &str = "the order of the authors' triangles: a good order runs half as many vertices as ours.";
const QUESTION: &str = "the models and their clusters: a smoother signal has smoother borders.";

/// Reason why no optimisation increases overdraw.
const NEVER_MORE: &str = "a vertex moves only if fewer triangles are drawn, and merged clusters add no border";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let mut table = Table::of(
        "Triangles drawn per triangle of the mesh",
        "model original_printed original rec_printed rec sc_printed sc sc+rec_printed sc+rec added_error_% superclusters",
    );
    let (mut rows, mut originals) = (Vec::new(), Vec::new());
    for (at, name, id) in MODELS {
        let found = shared.get::<DrawnClusters>(at)?;
        let mut cells = Vec::new();
        for (how, ours) in COLUMN_IDS.into_iter().zip(found.overdraw) {
            cells.extend([printed(&format!("cpca/overdraw-{id}-{how}"))?.cell(), Cell::decimals(ours, 3)]);
        }
        let rest = [Cell::percent(100.0 * found.added_error), found.superclusters.into()];
        table.push([Cell::from(name)].into_iter().chain(cells).chain(rest));
        for (column, above) in [(1, 0), (2, 0), (3, 1), (3, 2)] {
            let figure = format!("overdraw-{id}-{}-over-{}", COLUMN_IDS[column], COLUMN_IDS[above]);
            let row = solved(&figure, found.overdraw[column] / found.overdraw[above])?;
            // Superclusters of different clusters may have a longer border.
            rows.push(if (column, above) == (3, 2) { row } else { row.confined([0.0, 1.0], NEVER_MORE) });
        }
        originals.push(found.overdraw[0]);
    }
    rows.push(solved("overdraw-bumpy-over-smooth", originals[0] / originals[1])?);
    let size = super::signals::SIGNALS[BIRD].size;
    let how = paragraph(HOW, &[&(100.0 * BUDGET), &REGISTERS, &size.clusters_per_batch(REGISTERS)]);
    let (timed, frames) = rates(&MODELS, shared)?;
    let faster = by_coherence(&timed)?;
    rows.extend(timed);
    rows.extend(faster);
    Ok(EntryFindings::new([how, paragraph(TIMES, &[&CARD])], rows, [QUESTION, ORDER], [table, frames]))
}

/// Rows for "a 15-20% increase in rendering speed": the rates with both optimisations relative to the rates with
/// neither. The paper's own rates of the Buddha rise by more.
fn by_coherence(timed: &[PaperRow]) -> Result<[PaperRow; 2], StudyError> {
    // The rows have both rates of each model.
    let gains = |of: fn(&PaperRow) -> f64| {
        let rate = |id: &str, how: &str| {
            let id = format!("cpca/rate-{id}-{how}");
            timed.iter().find(|row| row.target.id == id).map_or(f64::NAN, of)
        };
        ends(MODELS.iter().map(|(_, _, id)| 100.0 * (rate(id, "both") / rate(id, "original") - 1.0)))
    };
    let [ours, of_print] = [gains(|row| row.ours), gains(|row| row.target.value)];
    let row = |id: &str, ours: f64, of_print: f64| {
        let row = ratio_row(id, (Method::Pipeline, ours), INPUTS)?;
        let how = "the rates of the table below the sentence, both optimisations over none";
        let contradiction = Contradiction::between(&row.target, of_print, how);
        Ok::<_, StudyError>(row.contradicted(contradiction))
    };
    Ok([row("coherence-least", ours[0], of_print[0])?, row("coherence-largest", ours[1], of_print[1])?])
}
