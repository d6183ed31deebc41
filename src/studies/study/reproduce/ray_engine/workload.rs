//! Workloads: a renderer's ray bundles, recorded once and replayed to engines; runs of engines, and their time on the
//! host and card of the paper; the teapot room of Tables 1 and 3 to 5.

use std::cell::RefCell;
use std::sync::Arc;

use rayon::prelude::*;
use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::ExecutorKind;
use refsim::timing::host::{CPU_ONLY_RAYS_PER_SECOND, HostCounts, HostModel, HostOperation, HostWeights};
use refsim::timing::queue::QueueFigures;
use refsim::timing::replay::{Options, replay};
use refsim::timing::{Level, Model};

use super::{Dependence, RunResult, Shared, SharedResult, StudyError, no_time, paragraph};
use crate::geom::exact::Sides;
use crate::geom::{Hit, Mesh, Ray};
use crate::io::scenes;
use crate::ray_engine::engine::{EngineCounts, EngineParameters, RayEngine, Readback};
use crate::renderer::photon::Photons;
use crate::renderer::{Settings, eye, photon, whitted};
use crate::tracer::octree::OctreeParameters;
use crate::tracer::{self, CastError, Caster, HostTracer};

/// Card of the modelled time: "execution rates measured on the GeForce 4".
pub(super) const TIMES: &str = "nv25";
/// Octree of all runs, for host and engine alike. The paper does not describe its octree; we chose ours before we
/// computed any table.
pub(super) const OCTREE: OctreeParameters = OctreeParameters { most_triangles: 8, most_depth: 10 };

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JobRenderer {
    /// Eye rays alone.
    Eyes,
    /// Whitted's ray tracing: "classical" in the paper.
    Classical,
    /// Distributed rays and photon maps with this many samples per pixel: "Monte Carlo" in the paper (section 5.4).
    MonteCarlo(u32),
}

/// Scene of Table 1 with its rendering parameters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Job {
    pub(super) scene: &'static str,
    pub(super) view: Option<&'static str>,
    pub(super) renderer: JobRenderer,
    /// Side of the picture in pixels, which the paper does not state.
    pub(super) side: u32,
}

/// The teapot room, as rendered for Tables 3 to 5.
pub(super) const CLASSICAL_TEAPOT: Job =
    Job { scene: "teapot-room", view: None, renderer: JobRenderer::Classical, side: 256 };

#[derive(Clone, Debug)]
pub(super) struct Workload {
    pub(super) mesh: Mesh,
    /// Ray bundles in the order in which they were cast.
    pub(super) bundles: Vec<Vec<Ray>>,
    /// Work of a host that casts them without a card or a ray tree.
    pub(super) alone: HostOnly,
}

impl Workload {
    /// Returns the work of a host that casts the same rays with another octree.
    pub(super) fn alone_with(&self, octree: OctreeParameters) -> HostOnly {
        let tracer = HostTracer::with_octree(&self.mesh, octree, Sides::Both);
        let mut cost = tracer::HostCounts::default();
        for bundle in &self.bundles {
            cost += tracer.nearest_all(bundle).1;
        }
        HostOnly::new(&cost)
    }
}

/// Host tracer that records its rays and counts its work.
struct Recording {
    tracer: HostTracer,
    bundles: Vec<Vec<Ray>>,
    cost: tracer::HostCounts,
}

impl Caster for Recording {
    fn cast(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, CastError> {
        self.bundles.push(rays.to_vec());
        let (hits, cost) = self.tracer.nearest_all(rays);
        self.cost += cost;
        Ok(hits)
    }
}

impl Job {
    pub(super) fn workload(&self) -> Result<Workload, StudyError> {
        let scene = scenes::named(self.scene).ok_or_else(|| format!("no scene `{}`", self.scene)).on(TIMES)?;
        let view = self.view.map_or_else(|| scene.views.first(), |name| scene.view(name));
        let view = view.ok_or_else(|| format!("scene `{}` lacks its view", self.scene)).on(TIMES)?;
        let camera = view.camera(self.side, self.side).on(TIMES)?;
        let tracer = HostTracer::with_octree(scene.mesh(), OCTREE, Sides::Both);
        let mut caster = Recording { tracer, bundles: Vec::new(), cost: tracer::HostCounts::default() };
        let settings = Settings { samples: 1, ..Settings::default() };
        let mut watch = |_| {};
        let drawn = match self.renderer {
            JobRenderer::Eyes => eye::render(&scene, &camera, &settings, &mut caster, &mut watch),
            JobRenderer::Classical => whitted::render(&scene, &camera, &settings, &mut caster, &mut watch),
            JobRenderer::MonteCarlo(samples) => {
                let settings = Settings { samples, ..settings };
                photon::render(&scene, &camera, &settings, &Photons::for_scene(&scene), &mut caster, &mut watch)
            }
        };
        drawn.on(TIMES)?;
        Ok(Workload { mesh: scene.mesh().clone(), bundles: caster.bundles, alone: HostOnly::new(&caster.cost) })
    }
}

/// Work of a host that casts a workload without a card or a ray tree: the first row of Table 3.
#[derive(Clone, Copy, Debug)]
pub(super) struct HostOnly {
    pub(super) counts: HostCounts,
    pub(super) rays: u64,
}

impl HostOnly {
    pub(super) fn new(cost: &tracer::HostCounts) -> Self {
        let counts = HostCounts::default()
            .with(HostOperation::OctreeCell, cost.traversal.cells)
            .with(HostOperation::RayTriangleTest, cost.tests);
        Self { counts, rays: cost.rays }
    }

    /// Calibrates the host so that this work takes the time of Table 3's first row: the only calibrated constant.
    pub(super) fn calibrate(&self, weights: HostWeights) -> Result<HostModel, StudyError> {
        HostModel::calibrate_with(weights, &self.counts, self.rays, CPU_ONLY_RAYS_PER_SECOND).on(TIMES)
    }

    pub(super) fn rays_per_s(&self, host: &HostModel) -> f64 {
        self.rays as f64 / host.time_of_all(&self.counts).seconds()
    }
}

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
    paragraph(HOW, &[&CLASSICAL_TEAPOT.side, &CLASSICAL_TEAPOT.side, &HOST_ALONE])
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
