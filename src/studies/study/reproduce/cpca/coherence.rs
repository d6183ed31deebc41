//! Figure 5 and the table of section 7: overdraw before and after the two optimisations of section 5.

use super::drawn::{BUDGET, COLUMNS};
use super::figure_3::EYE;
use super::mesh_cost::CARD;
use super::rates::rates;
use super::signals::{BIRD, BUDDHA};
use super::views::ModelView;
use super::{EntryFindings, Prose, REGISTERS, ReproduceError, Shared, number, order};
use crate::report::{Cell, Table};
use crate::sphere::HarmonicLight;

const PLACE: &str = "section 7";
/// Signal, its name, and the printed overdraw and frames per second.
const PRINTED: [(usize, &str, [f64; 4], [f64; 4]); 2] = [
    (BUDDHA, "Buddha", [1.93, 1.72, 1.61, 1.48], [26.8, 29.6, 29.7, 33.2]),
    (BIRD, "bird", [1.25, 1.23, 1.14, 1.138], [39.3, 39.3, 45.2, 45.3]),
];

const HOW: &str = "Overdraw is the mean number of clusters, or superclusters, of a triangle's vertices. Reclassification may add {} % of the error; superclusters \
    fill {} registers, {} clusters each. \"sc+rec\" is reclassification, then superclusters. Our models have as many points per cluster as the paper's, so that \
    clusters have as much of a border for their area. Pictures show the clusters as in Figure 5.";
const TIMES: &str = "Frames are timed on the {} from sizes, the printed overdraw, and the order of triangles in our models: products on the host, \
    constants, vertices, which a cache of finished ones spares; pixels take no time. Host and card work side by side.";
const ORDER: &str = "the order of the authors' triangles: a good one runs half as many vertices as ours does.";
const QUESTION: &str = "the models and their clusters: a smoother signal has smoother borders.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, ReproduceError> {
    let mut table = Table::of(
        "Triangles drawn per triangle of the mesh",
        "model original_printed original rec_printed rec sc_printed sc sc+rec_printed sc+rec added_error_% superclusters",
    );
    let (mut rows, mut originals, mut pictures) = (Vec::new(), Vec::new(), Vec::new());
    let light = HarmonicLight::red_and_blue(5);
    for (at, name, printed, _) in PRINTED {
        let computed = shared.cpca.signal(at, shared.models)?;
        let found = shared.cpca.drawn(at, shared.models)?;
        let pairs = printed.iter().zip(found.overdraw);
        let cells = pairs.flat_map(|(&printed, ours)| [Cell::decimals(printed, 3), Cell::decimals(ours, 3)]);
        let rest = [Cell::percent(100.0 * found.added_error), found.superclusters.into()];
        table.push([Cell::from(name)].into_iter().chain(cells).chain(rest));
        for (column, above) in [(1, 0), (2, 0), (3, 1), (3, 2)] {
            let what = format!("{name}: overdraw of {} over {}", COLUMNS[column], COLUMNS[above]);
            let ours = found.overdraw[column] / found.overdraw[above];
            rows.push(order(what, PLACE, [printed[column], printed[above]], ours));
        }
        originals.push(found.overdraw[0]);
        let view = ModelView::new(computed, &light, EYE)?;
        for (how, of_vertex) in COLUMNS.into_iter().zip(&found.groups) {
            let drawn = if how.starts_with("sc") { "superclusters" } else { "clusters" };
            let caption = format!("{name}, {how}: {drawn}, each in a color of its own");
            pictures.push(view.groups(of_vertex, (format!("cpca-figure-5-{name}-{}", how.replace('+', "-")), caption)));
        }
    }
    let what = "overdraw of the bumpy model over the smooth one's".to_owned();
    rows.push(order(what, PLACE, [PRINTED[0].2[0], PRINTED[1].2[0]], originals[0] / originals[1]));
    let size = super::signals::SIGNALS[BIRD].size;
    let figures = [100.0 * BUDGET, REGISTERS as f64, size.clusters_per_batch(REGISTERS) as f64];
    let (timed, frames) = rates(&PRINTED, &shared.cpca)?;
    rows.extend(timed);
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, figures.map(|figure| number(figure, 0))), Prose::new(TIMES, [CARD.to_owned()])],
        rows,
        questions: vec![QUESTION, ORDER],
        tables: vec![table, frames],
        pictures,
        ..EntryFindings::default()
    })
}
