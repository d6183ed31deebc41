//! Scheduling of rays between tree, host and card.

use refsim::event::{Event, HostWork};
use refsim::timing::host::HostOperation;

use super::flight::{Cache, Waiting};
use super::{RayEngine, Ticket};
use crate::geom::Ray;
use crate::ray_engine::EngineError;
use crate::ray_engine::card::CardHit;
use crate::tracer::octree::{Beam, CellId, Flow, Visit};

impl RayEngine<'_> {
    /// Inserts a ray into the tree; buckets leave the tree when it is full.
    pub(super) fn take_in(&mut self, ticket: Ticket, ray: Ray) -> Result<(), EngineError> {
        let before = self.tree.counts().nodes_passed;
        let flight = self.flights.start(ticket, ray, self.tracer.host_ray(&ray));
        self.tree.insert(flight, &ray);
        self.note(HostOperation::RayTreeNode, self.tree.counts().nodes_passed - before);
        self.note(HostOperation::BucketInsert, 1);
        while self.tree.len() >= self.parameters.waiting.max(1) {
            self.release_bucket()?;
        }
        Ok(())
    }

    /// Removes a bucket from the tree and starts its rays' traversal of the octree.
    pub(super) fn release_bucket(&mut self) -> Result<(), EngineError> {
        let bucket = self.tree.take();
        if self.parameters.beams && self.misses_all(&bucket) {
            self.counts.beam_rays += bucket.len() as u64;
            bucket.into_iter().for_each(|flight| self.answer(flight));
            return Ok(());
        }
        self.ready.extend(bucket.into_iter().map(|flight| (flight, f64::NEG_INFINITY)));
        self.drive()
    }

    /// Returns `true` if no ray of a bucket can meet a cell with triangles.
    fn misses_all(&mut self, bucket: &[u32]) -> bool {
        let rays: Vec<Ray> = bucket.iter().map(|flight| self.flights.at(*flight).ray).collect();
        let octree = self.tracer.octree();
        let Some(beam) = Beam::of(&rays).filter(|_| octree.sees(&rays)) else { return false };
        let reached = octree.reached(&beam, Some(&self.cells), false);
        self.counts.beam_cells += reached.tested;
        self.note(HostOperation::OctreeCell, reached.tested);
        reached.cells.is_empty()
    }

    /// Runs until only passes in flight are left: rays first, then full caches, in the order in which they were filled.
    fn drive(&mut self) -> Result<(), EngineError> {
        loop {
            while let Some((flight, from)) = self.ready.pop_front() {
                self.advance(flight, from);
            }
            let Some(cell) = self.full.pop_front() else { return Ok(()) };
            let cache = self.caches.entry(cell.index()).or_default();
            cache.turns = cache.turns.saturating_sub(1);
            // Rays beyond a full pass wait for the next pass.
            let rest = cache.rays.split_off(cache.rays.len().min(self.parameters.rays));
            let rays = std::mem::replace(&mut cache.rays, rest);
            if self.parameters.card { self.on_card(cell, rays)? } else { self.on_host(cell, &rays) }
        }
    }

    pub(super) fn settle(&mut self) -> Result<(), EngineError> {
        while self.take_pass() {
            self.drive()?;
        }
        Ok(())
    }

    /// Continues a ray behind a cell, until it is answered or enters the next GPU cell's cache.
    fn advance(&mut self, flight: u32, from: f64) {
        let here = *self.flights.at(flight);
        let (mut best, mut stop, mut tests) = (here.best, None, 0);
        let (tracer, cells) = (&self.tracer, &self.cells);
        let traversal = tracer.octree().traverse_from(&here.ray, Some(cells), from, |cell: &Visit<'_>| {
            if best.settles(cell.t[0], here.host.power) {
                return Flow::Stop;
            }
            if cell.gpu {
                stop = Some((cell.cell, cell.t[1]));
                return Flow::Stop;
            }
            tracer.test(cell.triangles, &here.host, &mut best);
            tests += cell.triangles.len() as u64;
            if best.settles(cell.t[1], here.host.power) { Flow::Stop } else { Flow::Continue }
        });
        self.counts.traversal += traversal;
        self.counts.host_tests += tests;
        self.note(HostOperation::OctreeCell, traversal.cells);
        self.note(HostOperation::RayTriangleTest, tests);
        self.flights.at(flight).best = best;
        match stop {
            None => self.answer(flight),
            Some((cell, leave)) => self.wait(cell, Waiting { flight, leave }),
        }
    }

    /// Adds a ray to a cell's cache; queues the cell each time the cache has filled a further pass.
    fn wait(&mut self, cell: CellId, ray: Waiting) {
        self.note(HostOperation::BucketInsert, 1);
        let cache = self.caches.entry(cell.index()).or_default();
        cache.rays.push(ray);
        if cache.rays.len() >= (cache.turns + 1) * self.parameters.rays {
            cache.turns += 1;
            self.full.push_back(cell);
        }
    }

    /// Forces all caches to the host, lowest cell number first, until all are empty: rays that continue may enter other
    /// caches.
    pub(super) fn force_caches(&mut self) -> Result<(), EngineError> {
        while let Some((cell, Cache { rays, .. })) = self.caches.pop_first() {
            self.counts.forced_rays += rays.len() as u64;
            self.on_host(CellId::at(cell), &rays);
            self.drive()?;
            self.settle()?;
        }
        Ok(())
    }

    /// Tests the rays of a cache against the triangles of its cell on the card: section 3.3, with fp32 results in the
    /// host's units. The rays are then in flight. If too many passes are in flight, the oldest are taken.
    fn on_card(&mut self, cell: CellId, waiting: Vec<Waiting>) -> Result<(), EngineError> {
        let Some(triangles) = self.cells.triangles(cell).map(<[u32]>::to_vec) else { return Ok(()) };
        if waiting.is_empty() {
            return Ok(());
        }
        let (rays_given, triangles_given) = (waiting.len() as u64, triangles.len() as u64);
        let rays = waiting.iter().map(|w| self.flights.at(w.flight).ray).collect();
        // Section 5.2: the front end converts the cache into texture data.
        self.note(HostOperation::RayPacked, rays_given);
        self.note(HostOperation::TriangleSent, triangles_given);
        self.note(HostOperation::VertexSent, 4 * triangles_given);
        let drawn = self.passes.issue(self.mesh, &triangles, rays, waiting)?;
        self.log.extend(self.passes.take_log());
        self.counts.passes += 1;
        self.counts.pass_rays += rays_given;
        self.counts.pass_tests += rays_given * triangles_given;
        self.counts.pass_triangles += triangles_given;
        self.counts.culled += triangles_given - drawn;
        while self.passes.too_many() && self.take_pass() {}
        Ok(())
    }

    /// Takes the results of the oldest pass in flight; returns `false` if there is none.
    fn take_pass(&mut self) -> bool {
        let Some(pass) = self.passes.take() else { return false };
        self.log.extend(self.passes.take_log());
        self.note(HostOperation::ResultRead, pass.waiting.len() as u64);
        for (ray, hit) in pass.waiting.iter().zip(pass.hits) {
            let flight = self.flights.at(ray.flight);
            flight.on_card = true;
            let Some(CardHit { triangle, t }) = hit else { continue };
            // Scales t back to the ray's range by a power of two.
            flight.best.offer((t / flight.host.power) as f32, triangle);
        }
        self.resume(&pass.waiting);
        true
    }

    /// Tests the rays of a cache against the triangles of its cell on the host.
    fn on_host(&mut self, cell: CellId, waiting: &[Waiting]) {
        let triangles = self.cells.triangles(cell).unwrap_or_default();
        let tests = (triangles.len() * waiting.len()) as u64;
        for ray in waiting {
            let flight = self.flights.at(ray.flight);
            self.tracer.test(triangles, &flight.host, &mut flight.best);
        }
        self.counts.host_tests += tests;
        self.note(HostOperation::RayTriangleTest, tests);
        self.resume(waiting);
    }

    /// Continues rays behind a cell; a ray is answered if no later cell can contain a nearer hit.
    fn resume(&mut self, rays: &[Waiting]) {
        for &Waiting { flight, leave } in rays {
            let here = self.flights.at(flight);
            if here.best.settles(leave, here.host.power) {
                self.answer(flight);
            } else {
                self.ready.push_back((flight, leave));
            }
        }
    }

    fn answer(&mut self, flight: u32) {
        let ended = self.flights.end(flight);
        self.counts.rays += 1;
        self.counts.rays_on_card += u64::from(ended.on_card);
        self.answered.push((ended.ticket, ended.best.hit(ended.host.power)));
    }

    /// Logs host work: between two commands of the card, all work of one kind is one entry.
    pub(super) fn note(&mut self, operation: HostOperation, count: u64) {
        if !self.parameters.record || count == 0 {
            return;
        }
        for event in self.log.iter_mut().rev() {
            match event {
                Event::Host(work) if work.kind == operation => {
                    work.operations += count;
                    return;
                }
                Event::Host(_) => {}
                _ => break,
            }
        }
        self.log.push(Event::Host(HostWork { kind: operation, operations: count }));
    }
}
