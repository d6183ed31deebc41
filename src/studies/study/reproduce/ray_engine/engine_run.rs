//! Run of the Ray Engine over a renderer's bundles: its work, and its time on the host and card of the paper.

use refsim::device::Profile;
use refsim::event::{DrawRecord, Event, MipmapRecord};
use refsim::machine::ExecutorKind;
use refsim::timing::host::HostModel;
use refsim::timing::queue::QueueFigures;
use refsim::timing::replay::{Costs, Options, replay};
use refsim::timing::{DrawCost, Level, Model, Picoseconds};

use super::workload::{OCTREE, TIMES, Workload};
use super::{RunResult, no_time};
use crate::geom::exact::Sides;
use crate::ray_engine::engine::{EngineCounts, EngineParameters, RayEngine};
use crate::study::StudyError;

/// Computing card: fp32, like the simulator of section 5.4.
const COMPUTES: &str = "ideal-fp32";

/// Run of an engine over a workload.
pub(super) struct Run {
    pub(super) counts: EngineCounts,
    log: Vec<Event>,
}

impl Run {
    /// Submits the bundles to an engine, one after the other, and finishes once at the end: secondary rays enter the
    /// cache while other rays still wait in it, as with a renderer that continues with any available results.
    pub(super) fn new(work: &Workload, parameters: EngineParameters) -> Result<Self, StudyError> {
        let parameters = EngineParameters { octree: OCTREE, record: true, sides: Sides::Both, ..parameters };
        let mut engine = RayEngine::new(&work.mesh, Profile::named(COMPUTES)?, ExecutorKind::Batch, parameters)?;
        for bundle in &work.bundles {
            engine.submit(bundle)?;
        }
        engine.finish()?;
        Ok(Self { counts: engine.counts(), log: engine.take_log() })
    }

    /// Mean fill of the buckets of the ray tree that hold rays, after each bundle of a workload, for an engine without
    /// a card; 1 is a full bucket.
    pub(super) fn fill_of(work: &Workload, parameters: EngineParameters) -> Result<Vec<f64>, StudyError> {
        let parameters = EngineParameters { octree: OCTREE, card: false, sides: Sides::Both, ..parameters };
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

/// Cost model of a run's commands, in addition to equation 11.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Commands {
    /// No cost in addition to equation 11.
    Free,
    /// Guessed costs on the host, and the bus's latencies.
    Cost(QueueFigures),
}

/// Card model that draws at the measured fill rate, and transfers at the printed rates of the bus.
struct GeForce4 {
    rates: Model,
    free: bool,
}

impl Costs for GeForce4 {
    fn draw(&self, record: &DrawRecord) -> DrawCost {
        self.rates.draw(record)
    }

    fn mipmaps(&self, record: &MipmapRecord) -> DrawCost {
        self.rates.mipmaps(record)
    }

    fn upload(&self, bytes: u64) -> Picoseconds {
        // Equation 11 has no term for uploads.
        if self.free { Picoseconds::ZERO } else { self.rates.upload(bytes) }
    }

    fn read_back(&self, bytes: u64) -> Picoseconds {
        self.rates.read_back(bytes)
    }

    fn clear(&self, bytes: u64) -> Picoseconds {
        self.rates.clear(bytes)
    }

    fn state(&self, changes: u32, constants: u32) -> Picoseconds {
        self.rates.state_change(changes, constants)
    }
}

/// Rays per second of a run.
pub(super) fn rays_per_s(run: &Run, host: &HostModel, commands: Commands) -> Result<f64, StudyError> {
    let free = commands == Commands::Free;
    let card = GeForce4 { rates: Model::new(Level::Rates, &Profile::named(TIMES)?).map_err(no_time)?, free };
    let queue = match commands {
        Commands::Free => QueueFigures::default().without_overhead(),
        Commands::Cost(figures) => figures,
    };
    let options = Options { queue, host: Some(host), ..Options::default() };
    let found = replay(&run.log, &card, &options).on(TIMES)?;
    Ok(run.counts.rays as f64 / found.timeline.makespan().seconds())
}
