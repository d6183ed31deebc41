//! Sweeps over parameters that affect Tables 3 to 5 and that no paper prints.

use std::sync::Arc;

use rayon::prelude::*;
use refsim::timing::host::{HostModel, HostWeights};
use refsim::timing::queue::QueueFigures;

use super::engine_run::{Run, rays_per_s};
use super::teapot::TeapotRoom;
use super::workload::OCTREE;
use super::{Setting, StudyError, Sweep};
use crate::tracer::octree::OctreeParameters;

/// Factors for the guessed costs of commands, in halves: 1, 1.5, 2 and 3.
const HALVES: [u64; 4] = [2, 3, 4, 6];
/// Triangles per leaf of the host's octree.
const LEAVES: [usize; 8] = [4, 6, 8, 9, 10, 11, 12, 16];

pub(super) fn rates(runs: &[Arc<Run>], host: &HostModel, commands: QueueFigures) -> Result<Vec<f64>, StudyError> {
    runs.par_iter().map(|run| rays_per_s(run, host, commands)).collect()
}

/// Sweep of all costs of commands by a common factor. The bus and the card are unchanged.
pub(super) fn commands(room: &TeapotRoom, runs: &[Arc<Run>]) -> Result<Sweep, StudyError> {
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
/// recalibrated for each setting, so that its time for the new counts is the printed one.
pub(super) fn host_leaf(room: &TeapotRoom, runs: &[Arc<Run>]) -> Result<Sweep, StudyError> {
    let setting = |most_triangles: usize| {
        let alone = room.work.alone_with(OctreeParameters { most_triangles, ..OCTREE });
        let values = rates(runs, &alone.calibrate(HostWeights::default())?, QueueFigures::default())?;
        Ok(Setting { at: most_triangles.to_string(), values })
    };
    let settings = LEAVES.into_iter().map(setting).collect::<Result<_, StudyError>>()?;
    Ok(Sweep { name: "leaves of the host's octree", parameter: "triangles", settings })
}
