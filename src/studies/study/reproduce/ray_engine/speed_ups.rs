//! The rows of Tables 3 to 5 together: they share one host, one card and one driver, so an explanation of one row must
//! hold for the others.

use std::sync::Arc;

use rayon::prelude::*;
use refsim::timing::host::{HostModel, HostWeights};
use refsim::timing::queue::QueueFigures;

use super::workload::{OCTREE, RATE, Run, TIMES, TeapotRoom, plus_card, rays_per_s, speed_up};
use super::{Dependence, Method, PaperRow, Setting, Shared, SharedResult, StudyError, Sweep, paper_row};
use crate::ray_engine::engine::{EngineParameters, Readback};
use crate::report::{Cell, Table};
use crate::tracer::octree::OctreeParameters;

/// Factors for the guessed costs of commands, each multiplied by 2: the factors are 1, 1.5, 2 and 3.
const HALVES: [u64; 4] = [2, 3, 4, 6];
/// Triangles per leaf of the host's octree.
const LEAVES: [usize; 8] = [4, 6, 8, 9, 10, 11, 12, 16];

/// Line of Tables 3 to 5 with its run. All three tables print the line with 5 to 15 triangles and 64 rays; it is one
/// figure, with its row in Table 3.
pub(super) struct SpeedUpRun {
    pub(super) name: &'static str,
    /// Name of the table that prints the line.
    place: &'static str,
    pub(super) row: PaperRow,
    pub(super) run: Arc<Run>,
}

impl SpeedUpRun {
    /// Printed speed-up over the host alone, in percent.
    pub(super) fn printed(&self) -> f64 {
        speed_up(self.row.target.value)
    }

    /// Our speed-up over the host alone, in percent.
    pub(super) fn ours(&self) -> f64 {
        speed_up(self.row.ours)
    }
}

/// All rows, and their values under other assumptions.
pub(crate) struct SpeedUps {
    lines: Vec<SpeedUpRun>,
    pub(super) commands: Sweep,
    pub(super) host_leaf: Sweep,
}

impl SpeedUps {
    pub(super) fn lines_of(&self, place: &'static str) -> Vec<&SpeedUpRun> {
        self.lines.iter().filter(|line| line.place == place).collect()
    }

    /// Rows of the figures that this table is the first to print.
    pub(super) fn rows(&self, place: &'static str) -> Vec<PaperRow> {
        let lines = self.lines_of(place).into_iter();
        lines.filter(|line| line.row.target.place == place).map(|line| line.row.clone()).collect()
    }

    /// Table of all rows under each setting of a sweep, as speed-ups.
    pub(super) fn table(&self, sweep: &Sweep, title: &str) -> Table {
        let rows: Vec<PaperRow> = self.lines.iter().map(|line| line.row.clone()).collect();
        sweep.table(title, &rows, (Some("%"), speed_up))
    }

    /// Speed-ups of a table's lines under each setting of a sweep of all rows.
    pub(super) fn under(&self, sweep: &Sweep, place: &'static str) -> Vec<(String, Vec<f64>)> {
        let of = |values: &[f64]| {
            let pairs = self.lines.iter().zip(values);
            pairs.filter(|(line, _)| line.place == place).map(|(_, value)| speed_up(*value)).collect()
        };
        sweep.settings.iter().map(|setting| (setting.at.clone(), of(&setting.values))).collect()
    }
}

/// Lines of the tables: table, name, printed figure, and the engine.
fn lines() -> Vec<(&'static str, &'static str, &'static str, EngineParameters)> {
    const PLUS_CARD: &str = "ray-engine/plus-card";
    let readback = |readback| EngineParameters { readback, ..plus_card() };
    let triangles = |triangles| EngineParameters { triangles, ..plus_card() };
    let rays = |rays| EngineParameters { rays, ..plus_card() };
    let asynchronous = readback(Readback::Asynchronous { passes: 4 });
    vec![
        ("Table 3", "plus card", PLUS_CARD, plus_card()),
        ("Table 3", "asynchronous read-back", "ray-engine/asynchronous", asynchronous),
        ("Table 3", "infinitely fast card", "ray-engine/infinitely-fast", readback(Readback::InfinitelyFast)),
        ("Table 4", "4 to 16 triangles", "ray-engine/triangles-4-16", triangles(4..=16)),
        ("Table 4", "5 to 12 triangles", "ray-engine/triangles-5-12", triangles(5..=12)),
        ("Table 4", "5 to 15 triangles", PLUS_CARD, triangles(5..=15)),
        ("Table 5", "64 rays", PLUS_CARD, rays(64)),
        ("Table 5", "128 rays", "ray-engine/rays-128", rays(128)),
        ("Table 5", "256 rays", "ray-engine/rays-256", rays(256)),
        ("Table 5", "512 rays", "ray-engine/rays-512", rays(512)),
    ]
}

impl SharedResult for SpeedUps {
    type Key = ();

    fn compute((): &(), shared: &Shared) -> Result<Self, StudyError> {
        let (room, stated) = (shared.get::<TeapotRoom>(())?, lines());
        let engines: Vec<EngineParameters> = stated.iter().map(|(.., engine)| engine.clone()).collect();
        let runs = room.runs(&engines)?;
        let ours = rates(&runs, &room.host, QueueFigures::default())?;
        let mut lines = Vec::new();
        for (((place, name, id, _), run), ours) in stated.into_iter().zip(&runs).zip(ours) {
            let row = paper_row(id, (TIMES, Method::Engine), (ours, RATE))?;
            lines.push(SpeedUpRun { name, place, row, run: Arc::clone(run) });
        }
        let (commands, host_leaf) = (commands(&room, &runs)?, host_leaf(&room, &runs)?);
        for sweep in [&commands, &host_leaf] {
            sweep.explain(lines.iter_mut().map(|line| &mut line.row));
        }
        Ok(Self { lines, commands, host_leaf })
    }
}

fn rates(runs: &[Arc<Run>], host: &HostModel, commands: QueueFigures) -> Result<Vec<f64>, StudyError> {
    runs.par_iter().map(|run| rays_per_s(run, host, commands)).collect()
}

/// Sweep of all costs of commands by a common factor. The bus and the card are unchanged.
fn commands(room: &TeapotRoom, runs: &[Arc<Run>]) -> Result<Sweep, StudyError> {
    let setting = |halves: u64| {
        let values = rates(runs, &room.host, scaled(halves))?;
        Ok(Setting { at: (halves as f64 / 2.0).to_string(), values })
    };
    let settings = HALVES.into_iter().map(setting).collect::<Result<_, StudyError>>()?;
    Ok(Sweep { name: "command costs", parameter: "factor", settings })
}

fn scaled(halves: u64) -> QueueFigures {
    let mut figures = QueueFigures::default();
    for row in QueueFigures::default().rows().into_iter().filter(|row| row.unit == "ps") {
        if let Some(figure) = figures.figure_mut(&row.key) {
            *figure = *figure * halves / 2;
        }
    }
    figures
}

/// Sweep of the host-alone octree by the triangles of its leaves; the engine keeps its own octree. The host is
/// recalibrated for each setting, so that its time for the new counts is the printed time.
fn host_leaf(room: &TeapotRoom, runs: &[Arc<Run>]) -> Result<Sweep, StudyError> {
    let setting = |most_triangles: usize| {
        let alone = room.work.alone_with(OctreeParameters { most_triangles, ..OCTREE });
        let values = rates(runs, &alone.calibrate(HostWeights::default())?, QueueFigures::default())?;
        Ok(Setting { at: most_triangles.to_string(), values })
    };
    let settings = LEAVES.into_iter().map(setting).collect::<Result<_, StudyError>>()?;
    Ok(Sweep { name: "leaves of the host's octree", parameter: "triangles", settings })
}

/// First row of Tables 3 to 5, which calibrates the host's speed.
pub(super) fn host_alone(room: &TeapotRoom) -> Result<PaperRow, StudyError> {
    let dependence = Dependence::Calibrated { on: "this figure" };
    paper_row("ray-engine/host-alone", (TIMES, Method::Engine), (room.work.alone.rays_per_s(&room.host), dependence))
}

/// Table of the speed-ups of some lines over the host alone, with the counters of their engines.
pub(super) fn table(lines: &[&SpeedUpRun], place: &str) -> Table {
    let mut table = Table::of(
        format!("Speed-ups over the host alone, {place}"),
        "run printed_rays_per_s ours_rays_per_s printed_% ours_% points_off passes_per_1000_rays rays_per_pass \
         triangles_per_pass cells_per_ray host_tests_per_ray card_visits_per_ray forced_per_ray",
    );
    for line in lines {
        let (counts, rays) = (&line.run.counts, line.run.counts.rays as f64);
        let of = |part: u64, whole: f64| Cell::ratio(part as f64 / whole.max(1.0));
        table.push([
            line.name.into(),
            Cell::decimals(line.row.target.value, 0),
            Cell::measured(line.row.ours),
            Cell::percent(line.printed()),
            Cell::percent(line.ours()),
            Cell::percent(line.ours() - line.printed()),
            Cell::ratio(1000.0 * counts.passes as f64 / rays),
            of(counts.pass_rays, counts.passes as f64),
            of(counts.pass_tests, counts.pass_rays as f64),
            of(counts.traversal.cells, rays),
            of(counts.host_tests, rays),
            of(counts.pass_rays, rays),
            of(counts.forced_rays, rays),
        ]);
    }
    table
}
