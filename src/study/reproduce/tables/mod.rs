//! Tables 1 to 5 of the Ray Engine: rays a second of whole renderings.
//!
//! The paper's host is known by one figure, the 135,812 rays a second of Table 3's first row; from it the scale of the host model is
//! calibrated, on our counts for our teapot room. Everything else is predicted: what the engine does is run and counted, the card takes
//! what equation 11 and its commands take. Scenes, pictures and octree are ours, since none of the paper's is printed.

mod engine_run;
mod host_work;
mod sensitivity;
mod table_1;
mod table_3;
mod table_4;
mod table_5;
mod workload;

use rayon::prelude::*;
use refsim::timing::host::{CPU_ONLY_RAYS_PER_SECOND, HostModel, HostWeights};
use refsim::timing::queue::QueueFigures;

use super::report::rounded;
use super::{Modelled, Printed, ReproduceError, Row};
use crate::ray_engine::engine::{EngineParameters, Readback};
use crate::report::{Cell, Table};
use crate::scene::built;
use engine_run::{Commands, Run, TIMES, rays_per_s};
use workload::{CLASSICAL_TEAPOT, Workload};

pub(super) use table_1::findings as table_1;
pub(super) use table_3::findings as table_3;
pub(super) use table_4::findings as table_4;
pub(super) use table_5::findings as table_5;

/// The figure that the host's scale is calibrated on.
const CALIBRATED_ON: &str = "135,812 rays/s of the host alone";

/// The teapot room, rendered classically, and a host that does it alone as fast as the paper's.
struct TeapotRoom {
    work: Workload,
    host: HostModel,
}

impl TeapotRoom {
    fn new() -> Result<Self, ReproduceError> {
        let work = CLASSICAL_TEAPOT.workload()?;
        let host = work.alone.calibrate(HostWeights::default())?;
        Ok(Self { work, host })
    }
}

/// How the figures of Tables 3 to 5 come about.
const HOW: &str = "The teapot room is rendered after Whitted at 256 x 256 pixels, and what the renderer asks is played to the engine: every ray \
    goes through ray tree, octree and caches, every pass is drawn by the emulated card in fp32. The work of the host is counted, operation by \
    operation, and costs the guessed weights of the host model, scaled so that the host alone casts the 135,812 rays/s of Table 3's first row: \
    the one figure that is calibrated. Draws take the GeForce4's fill rate, read-backs its bus, commands the guesses of every timeline.";

/// Why rows are off.
const NOTE: &str = "Scene, size of picture and octree are ours: none is printed. The printed times leave about 40 us for a pass of 64 rays, if \
    the authors' rays met the card as often as ours (3 times each): three times what our guesses for driver, bus and packing come to; and with \
    a card that costs nothing they leave the host 4.3 us a ray, where ours needs 5.1, half of it in the octree and a quarter for tests. To \
    know more one would need the authors' picture, octree and counts.";

/// A speed-up over the host alone, in per cent.
fn speed_up(rays_per_s: f64) -> f64 {
    100.0 * (rays_per_s / CPU_ONLY_RAYS_PER_SECOND as f64 - 1.0)
}

/// How the tables' runs are timed: what commands cost is guessed, and the guesses are those of every timeline.
fn commands() -> Commands {
    Commands::Cost(QueueFigures::default())
}

/// A row of Tables 3 to 5: printed rays a second, and our run's.
struct Line {
    what: String,
    printed: f64,
    run: Run,
}

/// The lines of a table: what each is called, its printed rays a second, and how its engine runs.
fn lines(room: &TeapotRoom, wanted: Vec<(String, f64, EngineParameters)>) -> Result<Vec<Line>, ReproduceError> {
    // One engine is one thread; the lines don't know of each other.
    let line = |(what, printed, parameters)| Ok(Line { what, printed, run: Run::of(&room.work, parameters)? });
    wanted.into_par_iter().map(line).collect()
}

/// The lines of a table, with the first row that all of them are compared with.
fn rows(room: &TeapotRoom, lines: &[Line], place: &'static str) -> Result<(Vec<Row>, Table), ReproduceError> {
    let mut table = Table::new(format!("Speed-ups over the host alone, {place}"), &SPEED_UPS);
    let mut rows = vec![Row {
        what: "host alone".to_owned(),
        device: TIMES,
        printed: Printed { value: CPU_ONLY_RAYS_PER_SECOND as f64, decimals: 0, unit: "rays/s", place },
        rates: None,
        pipeline: Modelled::calibrated(room.work.alone.rays_per_s(&room.host), CALIBRATED_ON),
        note: String::new(),
    }];
    for line in lines {
        let ours = rays_per_s(&line.run, &room.host, commands())?;
        let free = rays_per_s(&line.run, &room.host, Commands::Free)?;
        table.push(speed_up_cells(line, ours, free));
        rows.push(Row {
            what: line.what.clone(),
            device: TIMES,
            printed: Printed { value: line.printed, decimals: 0, unit: "rays/s", place },
            rates: None,
            pipeline: Modelled::predicted(ours),
            note: NOTE.to_owned(),
        });
    }
    Ok((rows, table))
}

const SPEED_UPS: [&str; 12] = [
    "run",
    "printed_%",
    "ours_%",
    "points_off",
    "ours_if_commands_were_free_%",
    "rays_on_card_%",
    "passes_per_1000_rays",
    "rays_per_pass",
    "triangles_per_pass",
    "cells_per_ray",
    "host_tests_per_ray",
    "forced_per_ray",
];

fn speed_up_cells(line: &Line, ours: f64, free: f64) -> [Cell; 12] {
    let counts = &line.run.counts;
    let rays = counts.rays as f64;
    let of = |part: u64, whole: f64, steps: f64| -> Cell { figure(part as f64 / whole.max(1.0), steps) };
    [
        line.what.as_str().into(),
        figure(speed_up(line.printed), 10.0),
        figure(speed_up(ours), 10.0),
        figure(speed_up(ours) - speed_up(line.printed), 10.0),
        figure(speed_up(free), 10.0),
        figure(100.0 * counts.share_on_card(), 10.0),
        figure(1000.0 * counts.passes as f64 / rays, 10.0),
        of(counts.pass_rays, counts.passes as f64, 10.0),
        of(counts.pass_tests, counts.pass_rays as f64, 10.0),
        of(counts.traversal.cells, rays, 10.0),
        of(counts.host_tests, rays, 10.0),
        of(counts.forced_rays, rays, 100.0),
    ]
}

fn figure(value: f64, steps: f64) -> Cell {
    rounded(value, steps).into()
}

/// How the engine of the tables runs unless a table says otherwise: 5 to 15 triangles, 64 rays (section 6.3); triangles outside the bucket
/// culled by the vertex program, buckets tested against cells, rays put into the tree in random order (section 5.3).
fn parameters() -> EngineParameters {
    EngineParameters {
        triangles: 5..=15,
        rays: 64,
        readback: Readback::Synchronous,
        cull: true,
        beams: true,
        shuffle: Some(built::SEED),
        ..EngineParameters::default()
    }
}
