//! The frame rates of the table of section 7, from its overdraw.

use refsim::device::Profile;
use refsim::event::vertex_cache_misses;

use super::signals::{PaperSignal, SIGNALS};
use super::{Bound, HOST, Method, PaperFigure, PaperRow, REGISTERS, ReproduceError, Standing, failed};
use crate::prt::on_card::estimate::FrameCounts;
use crate::prt::on_card::time::{FrameTime, frame_time, host_of_section_7};
use crate::report::{Cell, Table};

/// "a Radeon 9700".
pub(super) const CARD: &str = "r300";
/// "A Radeon 9800 runs 20% faster".
const NEWER: &str = "r350";
const PLACE: &str = "section 7";
/// What the host's rate comes from.
const INPUTS: &str = "2.9 Hz of the uncompressed head, which chose the host's rate; the printed overdraw";

/// A mesh as the card sees it.
struct MeshCost {
    triangles: u64,
    run_per_triangle: f64,
}

impl MeshCost {
    /// Our model of the printed size, its triangles in the order in which they are made.
    fn new(paper: &PaperSignal, profile: &Profile) -> Self {
        let mesh = paper.model.mesh(1);
        let entries = profile.rates.vertex_cache_entries.unwrap_or(0);
        let run = vertex_cache_misses(mesh.triangles().as_flattened(), mesh.positions().len(), entries);
        Self { triangles: mesh.len() as u64, run_per_triangle: run as f64 / mesh.len().max(1) as f64 }
    }
}

/// Printed rates beside ours, and where the time goes. Per signal its place, its name, overdraw and rates of drawing
/// clusters alone, reclassified, in superclusters, and both.
pub(super) fn rates(
    printed: &[(usize, &str, [f64; 4], [f64; 4])],
    columns: [&str; 4],
) -> Result<(Vec<PaperRow>, Table), ReproduceError> {
    let (profile, newer) = (Profile::named(CARD)?, Profile::named(NEWER)?);
    let host = host_of_section_7().map_err(|e| failed(HOST)(&e))?;
    let mut table = Table::of(
        "Frames per second, modelled from the printed overdraw",
        "model how overdraw_printed printed ours host_ms constants_ms draws_ms vertices_run run_per_triangle",
    );
    let mut rows = Vec::new();
    for &(at, name, overdraw, frames) in printed {
        let paper = &SIGNALS[at];
        let mesh = MeshCost::new(paper, &profile);
        for (column, how) in columns.into_iter().enumerate() {
            let alone = column < 2;
            let fit = if alone { 1 } else { paper.size.clusters_per_batch(REGISTERS) };
            let counts = FrameCounts {
                size: paper.size,
                triangles: mesh.triangles,
                drawn: (mesh.triangles as f64 * overdraw[column]).round() as u64,
                groups: paper.size.clusters.div_ceil(fit) as u64,
                run_per_triangle: mesh.run_per_triangle,
            };
            let time = frame_time(&profile, &counts.log(), &host).map_err(|e| failed(CARD)(&e))?;
            table.push(line(name, how, (overdraw[column], frames[column]), &time, mesh.run_per_triangle));
            let target = PaperFigure::printed(frames[column], 1, "Hz", PLACE);
            let found = (time.per_second(), Standing::Predicted { from: INPUTS });
            let what = format!("{name}: frames per second, {how}");
            rows.push(PaperRow::new(what, (CARD, Method::Pipeline), target, found, Bound::PREDICTION));
            // What the newer card gains is judged with both optimisations, which draw the frames of the last column.
            if column + 1 == columns.len() {
                let faster = frame_time(&newer, &counts.log(), &host).map_err(|e| failed(NEWER)(&e))?;
                let gain = 100.0 * (faster.per_second() / time.per_second() - 1.0);
                let target = PaperFigure::printed(20.0, 0, "%", PLACE);
                let what = format!("{name}: faster on the newer card");
                let found = (gain, Standing::Predicted { from: INPUTS });
                rows.push(PaperRow::new(what, (NEWER, Method::Pipeline), target, found, Bound::PREDICTION));
            }
        }
    }
    Ok((rows, table))
}

fn line(name: &str, how: &str, (overdraw, printed): (f64, f64), time: &FrameTime, run: f64) -> [Cell; 10] {
    [
        name.into(),
        how.into(),
        Cell::decimals(overdraw, 3),
        Cell::decimals(printed, 1),
        Cell::measured(time.per_second()),
        Cell::measured(1e3 * time.host.seconds()),
        Cell::measured(1e3 * time.state.seconds()),
        Cell::measured(1e3 * time.draws.seconds()),
        time.vertices_run.into(),
        Cell::ratio(run),
    ]
}
