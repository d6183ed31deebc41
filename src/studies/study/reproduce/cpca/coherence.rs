//! The table of section 7: overdraw before and after the two optimisations of section 5.

use super::drawn::{BUDGET, COLUMN_IDS, DrawnClusters};
use super::rates::{INPUTS, rates, ratio_row};
use super::signals::{BIRD, BUDDHA};
use super::{
    CARD, Contradiction, EntryFindings, Method, PaperRow, REGISTERS, Shared, StudyError, number, paragraph, printed,
    printed_value, solved,
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
    let figures = [100.0 * BUDGET, REGISTERS as f64, size.clusters_per_batch(REGISTERS) as f64];
    let (timed, frames) = rates(&MODELS, shared)?;
    let faster = by_coherence(&timed)?;
    rows.extend(timed);
    rows.extend(faster);
    Ok(EntryFindings::new(
        [paragraph(HOW, figures.map(|figure| number(figure, 0))), paragraph(TIMES, [CARD.to_owned()])],
        rows,
        [QUESTION, ORDER],
        [table, frames],
    ))
}

/// Rows for "a 15-20% increase in rendering speed": the rates with both optimisations relative to the rates with
/// neither. The paper's own rates of the Buddha rise by more.
fn by_coherence(timed: &[PaperRow]) -> Result<[PaperRow; 2], StudyError> {
    let ids = MODELS.map(|(_, _, id)| ["both", "original"].map(|how| format!("cpca/rate-{id}-{how}")));
    let gain = |rates: [f64; 2]| 100.0 * (rates[0] / rates[1] - 1.0);
    let ours = |id: &String| timed.iter().find(|row| row.target.id == *id).map_or(f64::NAN, |row| row.ours);
    let ours = ids.each_ref().map(|ids| gain(ids.each_ref().map(ours)));
    let [[buddha, plain], [bird, of_bird]] = &ids;
    let of_print =
        [gain([printed_value(buddha)?, printed_value(plain)?]), gain([printed_value(bird)?, printed_value(of_bird)?])];
    let row = |id: &str, (ours, of_print): (f64, f64)| {
        let row = ratio_row(id, (Method::Pipeline, ours), INPUTS)?;
        let how = "the rates of the table below the sentence, both optimisations over none";
        let contradiction = Contradiction::between(&row.target, of_print, how);
        Ok::<_, StudyError>(row.contradicted(contradiction))
    };
    Ok([
        row("coherence-least", (ours[0].min(ours[1]), of_print[0].min(of_print[1])))?,
        row("coherence-largest", (ours[0].max(ours[1]), of_print[0].max(of_print[1])))?,
    ])
}
