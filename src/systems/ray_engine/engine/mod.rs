//! The Ray Engine: rays go in, in any order and number; first hits come out (sections 5 and 6.2).
//!
//! Rays wait in a 5-D ray tree until there are enough of them, and leave it in coherent buckets. The host takes each
//! ray through the octree and tests triangles on the way; at a *GPU cell* the ray stops and waits in the cell's cache.
//! A cache of `R_min` rays goes to the card with all triangles of its cell, and its rays then go on behind the cell.
//! What is left in caches at the end is forced to the host.
//!
//! **The result does not depend on where a ray is tested.** A ray meets all triangles of each GPU cell on its way, on
//! the card or on the host, which computes what a card with fp32 pipelines computes; at equal t the lowest triangle
//! wins. So order, sizes of caches, `R_min` and threads change counts and time, never a hit. (On cards of other formats
//! card and host can disagree, so that the caches matter, as they did on the cards of the time. And where fp32 reports
//! a hit on a triangle outside the cells along the ray, which the ray does not truly hit, the result depends on whether
//! the octree and its cells cause that test: one answer in thousands of scenes made to be hard;
//! docs/papers/ray_engine.md counts them.)

mod counts;
mod flight;
mod order;
mod parameters;
mod passes;
mod schedule;

use std::collections::{BTreeMap, VecDeque};

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::Executor;
use refsim::timing::host::HostOperation;

use super::barycentrics::plane_point;
use super::pass::PassRequirements;
use super::ray_tree::RayTree;
use super::{Crossbar, EngineError};
use crate::geom::{Hit, Mesh, Ray};
use crate::tracer::HostTracer;
use crate::tracer::octree::{CellId, GpuCells};
use crate::tracer::{CastError, Caster};
use flight::{Answered, Cache, RaysInFlight};
use order::order;
use passes::Passes;

pub use counts::EngineCounts;
pub use flight::Ticket;
pub use parameters::{EngineParameters, Readback};

/// Hit with its barycentric coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocatedHit {
    /// Triangle and t.
    pub hit: Hit,
    /// Weights of the corners a, b and c: non-negative, with a sum of 1 up to rounding. Not clamped: those of a needle
    /// can be far off.
    pub weights: [f32; 3],
}

/// Ray Engine over one mesh.
#[derive(Debug)]
pub struct RayEngine<'a> {
    mesh: &'a Mesh,
    tracer: HostTracer,
    cells: GpuCells,
    passes: Passes,
    parameters: EngineParameters,
    tree: RayTree,
    flights: RaysInFlight,
    /// Caches of the GPU cells that have rays.
    caches: BTreeMap<usize, Cache>,
    /// Rays that can continue, each with the parameter to continue from.
    ready: VecDeque<(u32, f64)>,
    /// Cells whose caches hold a full pass, once per pass.
    full: VecDeque<CellId>,
    answered: Vec<Answered>,
    counts: EngineCounts,
    log: Vec<Event>,
}

impl<'a> RayEngine<'a> {
    /// Creates an engine over a mesh: builds the octree and marks the GPU cells.
    ///
    /// # Errors
    /// [`EngineError`] if the card runs no intersection program.
    pub fn new(
        mesh: &'a Mesh,
        profile: Profile,
        executor: impl Into<Executor>,
        parameters: EngineParameters,
    ) -> Result<Self, EngineError> {
        let tracer = HostTracer::with_octree(mesh, parameters.octree, parameters.sides);
        let cells = GpuCells::mark(tracer.octree(), parameters.triangles.clone());
        let EngineParameters { outputs, small_ids, cull, .. } = parameters;
        let requirements = PassRequirements { outputs, small_ids, cull, triangles: *parameters.triangles.end() };
        let card = Crossbar::new(profile, executor).pass_card(mesh, parameters.sides, requirements)?;
        let passes = Passes::new(card, parameters.readback, parameters.record);
        Ok(Self {
            mesh,
            tracer,
            cells,
            passes,
            tree: RayTree::new(parameters.tree),
            parameters: EngineParameters { rays: parameters.rays.max(1), ..parameters },
            flights: RaysInFlight::default(),
            caches: BTreeMap::new(),
            ready: VecDeque::new(),
            full: VecDeque::new(),
            answered: Vec::new(),
            counts: EngineCounts::default(),
            log: Vec::new(),
        })
    }

    /// Submits rays, and may answer some of those that wait. Tickets count from the one returned.
    ///
    /// # Errors
    /// [`EngineError`] if the card refuses the work.
    pub fn submit(&mut self, rays: &[Ray]) -> Result<Ticket, EngineError> {
        let first = self.flights.given();
        self.flights.give(rays.len());
        for i in order(rays.len(), self.parameters.shuffle.map(|seed| (seed, first))) {
            self.take_in(Ticket(first + i as u64), rays[i])?;
        }
        Ok(Ticket(first))
    }

    /// Answers all waiting rays.
    ///
    /// # Errors
    /// [`EngineError`] if the card refuses the work.
    pub fn finish(&mut self) -> Result<(), EngineError> {
        while !self.tree.is_empty() {
            self.release_bucket()?;
        }
        self.settle()?;
        self.force_caches()
    }

    /// Takes the answers since the last call, in no particular order.
    pub fn take_answers(&mut self) -> Vec<(Ticket, Option<Hit>)> {
        std::mem::take(&mut self.answered).into_iter().map(|answer| (answer.ticket, answer.hit)).collect()
    }

    /// Traces a bundle and returns its first hits in the order of the rays: the call of a host renderer.
    ///
    /// ```
    /// # mod crossbar { pub use {crossbar_base::*, crossbar_ground::*, crossbar_systems::*}; }
    /// use crossbar::geom::{Ray, teapot::teapot};
    /// use crossbar::ray_engine::engine::{EngineParameters, RayEngine};
    /// use refsim::{device::Profile, machine::ExecutorKind};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mesh = teapot(2)?;
    /// let radeon = Profile::named("r300")?;
    /// let mut engine = RayEngine::new(&mesh, radeon, ExecutorKind::Batch, EngineParameters::default())?;
    /// let rays = [Ray::new([0.1, 0.2, 9.0], [0.0, 0.0, -1.0])?];
    /// assert!(engine.trace(&rays)?[0].is_some());
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`EngineError`] if the card refuses the work.
    pub fn trace(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, EngineError> {
        Ok(self.answers_of(rays)?.into_iter().map(|answer| answer.and_then(|answer| answer.hit)).collect())
    }

    /// Like [`Self::trace`], with the barycentric coordinates of each hit: from the card where it computed them and
    /// found the hit ([`Outputs::IdAndBarycentrics`](super::Outputs::IdAndBarycentrics)), otherwise by one more test
    /// per hit on the host. The bits are the same on fp32.
    ///
    /// # Errors
    /// [`EngineError`] if the card refuses the work.
    pub fn trace_located(&mut self, rays: &[Ray]) -> Result<Vec<Option<LocatedHit>>, EngineError> {
        let answers = self.answers_of(rays)?;
        let (mesh, scale, sides, mut tests) = (self.mesh, self.tracer.scale(), self.parameters.sides, 0);
        let mut locate = |(ray, answer): (&Ray, Option<Answered>)| {
            let Answered { hit, uvw, .. } = answer?;
            let hit = hit?;
            let [u, v, w] = match uvw {
                Some(uvw) => uvw,
                None => {
                    tests += 1;
                    plane_point(mesh, scale, hit.triangle, ray, sides)?.uvw
                }
            };
            Some(LocatedHit { hit, weights: [w, u, v] })
        };
        let hits = rays.iter().zip(answers).map(&mut locate).collect();
        self.counts.host_tests += tests;
        self.note(HostOperation::RayTriangleTest, tests);
        Ok(hits)
    }

    /// Submits, finishes, and returns the answers in the order of the rays; answers to earlier rays stay queued.
    fn answers_of(&mut self, rays: &[Ray]) -> Result<Vec<Option<Answered>>, EngineError> {
        let first = self.submit(rays)?;
        self.finish()?;
        let mut answers = vec![None; rays.len()];
        let mut others = Vec::new();
        for answer in std::mem::take(&mut self.answered) {
            match answer.ticket.0.checked_sub(first.0).and_then(|i| answers.get_mut(i as usize)) {
                Some(slot) => *slot = Some(answer),
                None => others.push(answer),
            }
        }
        self.answered = others;
        Ok(answers)
    }

    /// Counters so far.
    pub fn counts(&self) -> EngineCounts {
        EngineCounts { tree: self.tree.counts(), ..self.counts }
    }

    /// Host tracer.
    pub fn tracer(&self) -> &HostTracer {
        &self.tracer
    }

    /// GPU cells.
    pub fn cells(&self) -> &GpuCells {
        &self.cells
    }

    /// Bucket occupancy of the ray tree, in [0, 1].
    pub fn occupancy(&self) -> Vec<f64> {
        self.tree.occupancy()
    }

    /// Bytes held by waiting rays, in the tree, in flight and in caches.
    pub fn bytes(&self) -> usize {
        let caches: usize = self.caches.values().map(Cache::bytes).sum();
        self.tree.bytes() + self.flights.bytes() + caches
    }

    /// Logs work of the application on the host, such as rays generated and hits shaded by a renderer, if the engine
    /// records.
    pub fn note_host(&mut self, operation: HostOperation, count: u64) {
        self.note(operation, count);
    }

    /// Takes the log of card commands and host work since the last call; empty if the engine does not record.
    pub fn take_log(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.log)
    }
}

impl Caster for RayEngine<'_> {
    fn cast(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, CastError> {
        self.trace(rays).map_err(|error| CastError(Box::new(error)))
    }
}
