//! Sweeps over parameters that affect Tables 3 to 5 and that no paper prints.

use std::rc::Rc;

use rayon::prelude::*;
use refsim::timing::host::{HostModel, HostWeights};
use refsim::timing::queue::QueueFigures;

use super::commands as stated;
use super::engine_run::{Commands, Run, rays_per_s};
use super::teapot::TeapotRoom;
use super::workload::OCTREE;
use super::{Setting, StudyError, Sweep};
use crate::tracer::octree::OctreeParameters;

/// Factors for the guessed costs of commands, in halves: 1, 1.5, 2 and 3.
const HALVES: [u64; 4] = [2, 3, 4, 6];
/// Triangles per leaf of the host's octree.
const LEAVES: [usize; 8] = [4, 6, 8, 9, 10, 11, 12, 16];

/// Rays per second of runs; each distinct run is replayed only once.
pub(super) fn rates(runs: &[Rc<Run>], host: &HostModel, commands: Commands) -> Result<Vec<f64>, StudyError> {
    let mut distinct: Vec<&Rc<Run>> = Vec::new();
    for run in runs {
        if !distinct.iter().any(|known| Rc::ptr_eq(known, run)) {
            distinct.push(run);
        }
    }
    let plain: Vec<&Run> = distinct.iter().map(|run| &***run).collect();
    let found: Vec<f64> = plain.into_par_iter().map(|run| rays_per_s(run, host, commands)).collect::<Result<_, _>>()?;
    let rate =
        |run: &Rc<Run>| distinct.iter().zip(&found).find(|(known, _)| Rc::ptr_eq(known, run)).map(|(_, rate)| *rate);
    Ok(runs.iter().filter_map(rate).collect())
}

/// Sweep of all costs of commands by a common factor. The bus and the card are unchanged.
pub(super) fn commands(room: &TeapotRoom, runs: &[Rc<Run>]) -> Result<Sweep, StudyError> {
    let setting = |halves: u64| {
        let values = rates(runs, &room.host, Commands::Cost(scaled(halves)))?;
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
/// recalibrated for each setting, so that its time for the new counts is the printed one.
pub(super) fn host_leaf(room: &TeapotRoom, runs: &[Rc<Run>]) -> Result<Sweep, StudyError> {
    let setting = |most_triangles: usize| {
        let alone = room.work.alone_with(OctreeParameters { most_triangles, ..OCTREE });
        let values = rates(runs, &alone.calibrate(HostWeights::default())?, stated())?;
        Ok(Setting { at: most_triangles.to_string(), values })
    };
    let settings = LEAVES.into_iter().map(setting).collect::<Result<_, StudyError>>()?;
    Ok(Sweep { name: "leaves of the host's octree", parameter: "triangles", settings })
}
