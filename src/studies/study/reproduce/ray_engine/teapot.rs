//! The teapot room of Tables 1 and 3 to 5: rendered once; each engine run is made once for all entries.

use std::cell::RefCell;
use std::sync::Arc;

use rayon::prelude::*;
use refsim::timing::host::{CPU_ONLY_RAYS_PER_SECOND, HostModel, HostWeights};

use super::engine_run::Run;
use super::workload::{CLASSICAL_TEAPOT, OCTREE, Workload};
use super::{Dependence, Shared, SharedResult, StudyError, number, paragraph};
use crate::geom::exact::Sides;
use crate::ray_engine::engine::{EngineParameters, Readback};

pub(super) const RATE: Dependence = Dependence::Predicted {
    from: "135,812 rays/s of the host alone (the host's scale), 286 M/s at ten triangles (the card's fill rate), 250 MB/s (read-back)",
};

/// Rays per second of the host alone, as printed.
const HOST_ALONE: f64 = CPU_ONLY_RAYS_PER_SECOND as f64;
/// Seed of the rays' random order.
const SEED: u64 = 2002;

pub(super) const QUESTION: &str = "the authors' scene, picture and octree, the cost of their driver's commands, and \
    how often their rays met the card.";
const HOW: &str = "The teapot room is rendered by Whitted ray tracing at {} x {} pixels, and the engine traces the renderer's rays: every ray \
    goes through the ray tree, the octree and the caches, and the emulated card draws every pass in fp32. The host's operations are counted and \
    multiplied by the guessed weights of the host model. The scale of these weights is the only calibrated constant: with it, the host alone \
    casts the {} rays/s of Table 3's first row. Draws run at the GeForce4's fill rate, and read-backs at its bus rate; each command costs the \
    guessed time that every timeline uses.";

pub(super) fn how() -> String {
    let side = || CLASSICAL_TEAPOT.side.to_string();
    paragraph(HOW, [side(), side(), number(HOST_ALONE, 0)])
}

/// Speed-up over the host alone, in percent.
pub(super) fn speed_up(rays_per_s: f64) -> f64 {
    100.0 * (rays_per_s / HOST_ALONE - 1.0)
}

/// "Plus GPU": 5 to 15 triangles, 64 rays (section 6.3). The vertex program culls triangles outside the bucket, buckets
/// are tested against cells, and rays are inserted into the tree in random order (section 5.3).
pub(super) fn plus_card() -> EngineParameters {
    EngineParameters {
        octree: OCTREE,
        triangles: 5..=15,
        rays: 64,
        readback: Readback::Synchronous,
        sides: Sides::Both,
        cull: true,
        beams: true,
        shuffle: Some(SEED),
        record: true,
        ..EngineParameters::default()
    }
}

/// The teapot room, rendered classically, and a host calibrated to render it alone at the paper's speed.
pub(crate) struct TeapotRoom {
    pub(super) work: Workload,
    pub(super) host: HostModel,
    runs: RefCell<Vec<(EngineParameters, Arc<Run>)>>,
}

impl SharedResult for TeapotRoom {
    type Key = ();

    fn compute((): &(), _: &Shared) -> Result<Self, StudyError> {
        let work = CLASSICAL_TEAPOT.workload()?;
        Ok(Self { host: work.alone.calibrate(HostWeights::default())?, work, runs: RefCell::default() })
    }
}

impl TeapotRoom {
    /// Returns the runs of some engines, in the given order.
    pub(super) fn runs(&self, wanted: &[EngineParameters]) -> Result<Vec<Arc<Run>>, StudyError> {
        let mut missing: Vec<EngineParameters> = Vec::new();
        for parameters in wanted {
            if !missing.contains(parameters) && self.known(parameters).is_none() {
                missing.push(parameters.clone());
            }
        }
        // One thread per engine; the runs are independent.
        let work = &self.work;
        let run = |parameters: EngineParameters| Ok((parameters.clone(), Arc::new(Run::new(work, parameters)?)));
        let made: Vec<_> = missing.into_par_iter().map(run).collect::<Result<_, StudyError>>()?;
        self.runs.borrow_mut().extend(made);
        Ok(wanted.iter().filter_map(|parameters| self.known(parameters)).collect())
    }

    fn known(&self, parameters: &EngineParameters) -> Option<Arc<Run>> {
        self.runs.borrow().iter().find(|(made, _)| made == parameters).map(|(_, run)| Arc::clone(run))
    }
}
