//! Run of the Ray Engine over a renderer's ray bundles: its work, and its time on the host and card of the paper.

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::ExecutorKind;
use refsim::timing::host::HostModel;
use refsim::timing::queue::QueueFigures;
use refsim::timing::replay::{Options, replay};
use refsim::timing::{Level, Model};

use super::workload::{TIMES, Workload};
use super::{RunResult, no_time};
use crate::ray_engine::engine::{EngineCounts, EngineParameters, RayEngine};
use crate::study::StudyError;

/// Computing card: fp32, like the simulator of section 5.4.
const COMPUTES: &str = "ideal-fp32";

pub(super) struct Run {
    pub(super) counts: EngineCounts,
    log: Vec<Event>,
}

impl Run {
    /// Submits the bundles to an engine, one after the other, and finishes once at the end: secondary rays enter the
    /// cache while other rays still wait in it, as with a renderer that continues with any available results.
    pub(super) fn new(work: &Workload, parameters: EngineParameters) -> Result<Self, StudyError> {
        let mut engine = RayEngine::new(&work.mesh, Profile::named(COMPUTES)?, ExecutorKind::Batch, parameters)?;
        for bundle in &work.bundles {
            engine.submit(bundle)?;
        }
        engine.finish()?;
        Ok(Self { counts: engine.counts(), log: engine.take_log() })
    }

    /// Mean fill of the ray tree's nonempty buckets after each bundle of a workload, for an engine without a card; a
    /// full bucket counts as 1.
    pub(super) fn fill_of(work: &Workload, parameters: EngineParameters) -> Result<Vec<f64>, StudyError> {
        let parameters = EngineParameters { card: false, record: false, ..parameters };
        let mut engine = RayEngine::new(&work.mesh, Profile::named(COMPUTES)?, ExecutorKind::Batch, parameters)?;
        let mut means = Vec::new();
        for bundle in &work.bundles {
            engine.submit(bundle)?;
            let filled = engine.occupancy();
            if !filled.is_empty() {
                means.push(filled.iter().sum::<f64>() / filled.len() as f64);
            }
        }
        Ok(means)
    }
}

/// Rays per second of a run: the card draws at the measured fill rate, and transfers at the printed rates of the bus;
/// `commands` has the costs of commands on the host.
pub(super) fn rays_per_s(run: &Run, host: &HostModel, commands: QueueFigures) -> Result<f64, StudyError> {
    let card = Model::new(Level::Rates, &Profile::named(TIMES)?).map_err(no_time)?;
    let options = Options { queue: commands, host: Some(host), ..Options::default() };
    let found = replay(&run.log, &card, &options).on(TIMES)?;
    Ok(run.counts.rays as f64 / found.timeline.makespan().seconds())
}
