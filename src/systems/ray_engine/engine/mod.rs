//! The Ray Engine: finds first hits of rays in any order and number (sections 5 and 6.2).
//!
//! Rays wait in a 5-D ray tree until there are enough of them, and leave it in coherent buckets. The host traverses the
//! octree with each ray and tests triangles; at a *GPU cell* the ray stops and waits in the cell's cache. A cache of
//! `R_min` rays is sent to the card with all triangles of its cell, and its rays then continue behind the cell. Rays
//! left in caches at the end are forced to the host.
//!
//! **The result does not depend on where a ray is tested.** A ray is tested against all triangles of each GPU cell on
//! its way, on the card or on the host, whose results equal the results of a card with fp32 pipelines; at equal t the
//! triangle with the lowest index is taken. So order, sizes of caches, `R_min` and threads change counts and time,
//! never a hit. There are two exceptions. On cards with other formats, card and host can disagree, so the caches
//! matter, as on the cards of the time. And fp32 may report a hit on a triangle outside the cells along the ray, which
//! the ray does not truly hit; then the result depends on whether the octree and its cells cause that test. This
//! affects one answer in thousands of artificially hard scenes (docs/papers/ray_engine.md counts them).

mod counts;
mod flight;
mod parameters;
mod passes;
mod schedule;

use std::collections::{BTreeMap, VecDeque};

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::Executor;

use super::ray_tree::RayTree;
use super::{Crossbar, EngineError};
use crate::geom::random::CounterRng;
use crate::geom::{Hit, Mesh, Ray};
use crate::tracer::HostTracer;
use crate::tracer::octree::{CellId, GpuCells};
use crate::tracer::{CastError, Caster};
use flight::{Cache, RaysInFlight};
use passes::Passes;

pub use counts::EngineCounts;
pub use flight::Ticket;
pub use parameters::{EngineParameters, Readback};

/// Ray Engine over one mesh.
#[derive(Debug)]
pub struct RayEngine<'a> {
    mesh: &'a Mesh,
    tracer: HostTracer,
    cells: GpuCells,
    passes: Passes,
    parameters: EngineParameters,
    tree: RayTree,
    /// Number of rays submitted: the next ticket.
    given: u64,
    flights: RaysInFlight,
    /// Caches of the GPU cells that have rays.
    caches: BTreeMap<usize, Cache>,
    /// Rays that can continue, each with the parameter at which it continues.
    ready: VecDeque<(u32, f64)>,
    /// Cells whose caches have full passes, once per pass.
    full: VecDeque<CellId>,
    answered: Vec<(Ticket, Option<Hit>)>,
    counts: EngineCounts,
    log: Vec<Event>,
}

impl<'a> RayEngine<'a> {
    /// Creates an engine over a mesh: builds the octree and marks the GPU cells.
    pub fn new(
        mesh: &'a Mesh,
        profile: Profile,
        executor: impl Into<Executor>,
        parameters: EngineParameters,
    ) -> Result<Self, EngineError> {
        let tracer = HostTracer::with_octree(mesh, parameters.octree, parameters.sides);
        let cells = GpuCells::mark(tracer.octree(), parameters.triangles.clone());
        let card = Crossbar::new(profile, executor).pass_card(mesh, parameters.sides, parameters.cull)?;
        let passes = Passes::new(card, parameters.readback, parameters.record);
        Ok(Self {
            mesh,
            tracer,
            cells,
            passes,
            tree: RayTree::new(parameters.tree),
            parameters: EngineParameters { rays: parameters.rays.max(1), ..parameters },
            given: 0,
            flights: RaysInFlight::default(),
            caches: BTreeMap::new(),
            ready: VecDeque::new(),
            full: VecDeque::new(),
            answered: Vec::new(),
            counts: EngineCounts::default(),
            log: Vec::new(),
        })
    }

    /// Submits rays, and may answer some waiting rays. The rays get consecutive tickets from the returned one.
    pub fn submit(&mut self, rays: &[Ray]) -> Result<Ticket, EngineError> {
        let first = self.given;
        self.given += rays.len() as u64;
        for i in order(rays.len(), self.parameters.shuffle.map(|seed| (seed, first))) {
            self.take_in(Ticket(first + i as u64), rays[i])?;
        }
        Ok(Ticket(first))
    }

    /// Answers all waiting rays. Fails with [`EngineError`] if the card rejects the work.
    pub fn finish(&mut self) -> Result<(), EngineError> {
        while !self.tree.is_empty() {
            self.release_bucket()?;
        }
        self.settle()?;
        self.force_caches()
    }

    /// Takes the answers since the last call, in no particular order.
    pub fn take_answers(&mut self) -> Vec<(Ticket, Option<Hit>)> {
        std::mem::take(&mut self.answered)
    }

    /// Traces a bundle and returns its first hits in the order of the rays, as a renderer on the host calls it.
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
    /// [`EngineError`] if the card rejects the work.
    pub fn trace(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, EngineError> {
        let first = self.submit(rays)?;
        self.finish()?;
        let mut hits = vec![None; rays.len()];
        // Answers of earlier rays stay queued.
        self.answered.retain(|(ticket, hit)| {
            let place = ticket.0.checked_sub(first.0).and_then(|i| hits.get_mut(i as usize));
            let is_earlier = place.is_none();
            place.into_iter().for_each(|place| *place = *hit);
            is_earlier
        });
        Ok(hits)
    }

    /// Counters so far.
    pub fn counts(&self) -> EngineCounts {
        EngineCounts { tree: self.tree.counts(), ..self.counts }
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

/// Returns a permutation of `count` rays: the identity, or shuffled (section 5.3: "in random order, which helps keep
/// the tree balanced") by a seed and the index of the first ray.
fn order(count: usize, shuffled: Option<(u64, u64)>) -> Vec<usize> {
    let mut places: Vec<usize> = (0..count).collect();
    if let Some((seed, first)) = shuffled {
        let random = CounterRng::new(seed);
        for last in (1..count).rev() {
            let bits = random.bits(first, last as u64, 0);
            // The high half of the product is almost uniform for any possible number of rays.
            places.swap(last, ((u128::from(bits) * (last as u128 + 1)) >> 64) as usize);
        }
    }
    places
}
