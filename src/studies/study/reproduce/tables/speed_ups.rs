//! The rows of Tables 3 to 5 together: they share one host, one card and one driver, so that an explanation of one of
//! them must hold for the others.

use std::rc::Rc;

use super::super::{Bound, Method, PaperFigure, PaperRow, ReproduceError, Standing, Sweep};
use super::engine_run::{Commands, Run};
use super::teapot::{TeapotRoom, Variant};
use super::workload::TIMES;
use super::{HOST_ALONE, RATE, commands, speed_up, sweeps};
use crate::ray_engine::engine::Readback;
use crate::report::{Cell, Table};

/// Passes in flight in the asynchronous run.
const IN_FLIGHT: usize = 4;
/// Bound relative to the printed gain over the host alone.
const GAIN: Bound = Bound::Gain { share: Bound::SHARE, over: HOST_ALONE };

/// Row of Tables 3 to 5 with its run. The run of 5 to 15 triangles and 64 rays is printed in all three.
pub(super) struct SpeedUpRun {
    pub(super) row: PaperRow,
    pub(super) run: Rc<Run>,
}

impl SpeedUpRun {
    /// Printed speed-up over the host alone, in per cent.
    pub(super) fn printed(&self) -> f64 {
        speed_up(self.row.target.value)
    }

    /// Our speed-up over the host alone, in per cent.
    pub(super) fn ours(&self) -> f64 {
        speed_up(self.row.ours)
    }
}

/// All rows, and their values under other guesses.
pub(crate) struct SpeedUps {
    pub(super) lines: Vec<SpeedUpRun>,
    pub(super) commands: Sweep,
    pub(super) host_leaf: Sweep,
}

impl SpeedUps {
    /// Lines of a table.
    pub(super) fn of(&self, place: &'static str) -> Vec<&SpeedUpRun> {
        self.lines.iter().filter(|line| line.row.target.place == place).collect()
    }

    /// Rows of a table, including that of the host alone.
    pub(super) fn rows(&self, room: &TeapotRoom, place: &'static str) -> Vec<PaperRow> {
        std::iter::once(host_alone(room, place))
            .chain(self.of(place).into_iter().map(|line| line.row.clone()))
            .collect()
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
            pairs.filter(|(line, _)| line.row.target.place == place).map(|(_, value)| speed_up(*value)).collect()
        };
        sweep.settings.iter().map(|setting| (setting.at.clone(), of(&setting.values))).collect()
    }
}

/// Printed rows: name, table, rays per second, and the engine's variant.
fn printed() -> Vec<(String, &'static str, f64, Variant)> {
    let plus = Variant::PLUS_CARD;
    let readback = |readback| Variant { readback, ..plus.clone() };
    let triangles = |triangles| Variant { triangles, ..plus.clone() };
    let rays = |rays| Variant { rays, ..plus.clone() };
    let mut lines = Vec::new();
    for (what, value, variant) in [
        ("plus card", 165_098.0, plus.clone()),
        ("asynchronous read-back", 183_273.0, readback(Readback::Asynchronous { passes: IN_FLIGHT })),
        ("infinitely fast card", 234_102.0, readback(Readback::InfinitelyFast)),
    ] {
        lines.push((what.to_owned(), "Table 3", value, variant));
    }
    for (range, value) in [(4..=16, 147_630.0), (5..=12, 157_839.0), (5..=15, 165_098.0)] {
        let what = format!("{} to {} triangles", range.start(), range.end());
        lines.push((what, "Table 4", value, triangles(range)));
    }
    for (count, value) in [(64, 165_098.0), (128, 177_647.0), (256, 180_558.0), (512, 175_904.0)] {
        lines.push((format!("{count} rays"), "Table 5", value, rays(count)));
    }
    lines
}

/// Computes runs, times and sweeps.
pub(crate) fn work_out(room: &TeapotRoom) -> Result<SpeedUps, ReproduceError> {
    let printed = printed();
    let variants: Vec<Variant> = printed.iter().map(|(.., variant)| variant.clone()).collect();
    let runs = room.runs(&variants)?;
    let ours = sweeps::rates(&runs, &room.host, commands())?;
    let mut lines = Vec::new();
    for (((what, place, value, _), run), ours) in printed.into_iter().zip(&runs).zip(ours) {
        let target = PaperFigure::printed(value, 0, "rays/s", place);
        let row = PaperRow::new(what, (TIMES, Method::Engine), target, (ours, RATE), GAIN);
        lines.push(SpeedUpRun { row, run: Rc::clone(run) });
    }
    let (commands, host_leaf) = (sweeps::commands(room, &runs)?, sweeps::host_leaf(room, &runs)?);
    for sweep in [&commands, &host_leaf] {
        sweep.explain(lines.iter_mut().map(|line| &mut line.row));
    }
    Ok(SpeedUps { lines, commands, host_leaf })
}

/// First row of Tables 3 to 5, which calibrates the host's scale.
fn host_alone(room: &TeapotRoom, place: &'static str) -> PaperRow {
    let standing = Standing::Calibrated { on: "this figure" };
    let ours = room.work.alone.rays_per_s(&room.host);
    let target = PaperFigure::printed(HOST_ALONE, 0, "rays/s", place);
    PaperRow::new("host alone", (TIMES, Method::Engine), target, (ours, standing), Bound::Print)
}

const COLUMNS: &str = "run printed_rays_per_s ours_rays_per_s printed_% ours_% points_off ours_if_commands_were_free_% \
     passes_per_1000_rays rays_per_pass triangles_per_pass cells_per_ray host_tests_per_ray card_visits_per_ray \
     forced_per_ray";

/// Table of the speed-ups of some lines over the host alone, with the counters of their engines.
pub(super) fn table(room: &TeapotRoom, lines: &[&SpeedUpRun], place: &str) -> Result<Table, ReproduceError> {
    let mut table = Table::of(format!("Speed-ups over the host alone, {place}"), COLUMNS);
    for line in lines {
        let free = speed_up(room.rays_per_s(&line.run, Commands::Free)?);
        let (counts, rays) = (&line.run.counts, line.run.counts.rays as f64);
        let of = |part: u64, whole: f64| Cell::ratio(part as f64 / whole.max(1.0));
        table.push([
            line.row.what.as_str().into(),
            Cell::decimals(line.row.target.value, 0),
            Cell::measured(line.row.ours),
            Cell::percent(line.printed()),
            Cell::percent(line.ours()),
            Cell::percent(line.ours() - line.printed()),
            Cell::percent(free),
            Cell::ratio(1000.0 * counts.passes as f64 / rays),
            of(counts.pass_rays, counts.passes as f64),
            of(counts.pass_tests, counts.pass_rays as f64),
            of(counts.traversal.cells, rays),
            of(counts.host_tests, rays),
            of(counts.pass_rays, rays),
            of(counts.forced_rays, rays),
        ]);
    }
    Ok(table)
}
