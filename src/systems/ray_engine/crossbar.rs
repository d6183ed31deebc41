//! The crossbar on an emulated card: every ray of a batch is tested against every triangle of a mesh.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;
use refsim::device::Profile;
use refsim::event::TexelObserver;
use refsim::machine::{Executor, Machine, MachineError};
use refsim::texture::Region;

use super::answer::{Answer, EngineError, MAX_TRIANGLES};
use super::bits_left::BitsLeft;
use super::bundle::{Bundle, regions};
use super::card::{RayTextures, Streams, rounded};
use super::pass::PassCard;
use super::units::Units;
use super::{EdgeRule, Kernel, RayBatch};
use crate::geom::exact::Sides;
use crate::geom::{Hit, Mesh, Ray};

/// Side of a bucket of eye rays, in pixels.
const BUCKET: u32 = 32;
/// Side of a bucket of a list of rays, in pixels: the square in which lists are laid out.
const LIST_BUCKET: u32 = 16;
/// Maximum number of rays of a list in one batch.
const LIST_BATCH: usize = 65_536;

/// Options of a recorded intersection.
#[derive(Clone, Copy, Default)]
#[expect(missing_debug_implementations, reason = "functions cannot be printed")]
pub struct Recording<'a> {
    /// Creates an observer of texel reads per bucket. The card then draws with the scalar executor, which is slow.
    pub new_observer: Option<&'a (dyn Fn() -> Box<dyn TexelObserver> + Sync)>,
    /// Called after each bucket, in several threads, with the number of finished buckets and their total; a larger number
    /// may come before a smaller one.
    pub done: Option<&'a (dyn Fn(usize, usize) + Sync)>,
}

/// A card that intersects rays with triangles.
#[derive(Clone, Debug)]
pub struct Crossbar {
    profile: Arc<Profile>,
    executor: Executor,
    all_pairs: bool,
    edges: EdgeRule,
    byte_rays: bool,
    /// Cache of assembled and checked programs, by use.
    kernels: Arc<Mutex<Vec<ChosenKernel>>>,
}

/// Use of a program: `true` if all rays share one origin, and the sides that can be hit.
type KernelUse = (bool, Sides);

/// Cached program with its use.
type ChosenKernel = (KernelUse, Arc<Kernel>);

impl Crossbar {
    /// Creates a crossbar on a card with this profile.
    pub fn new(profile: impl Into<Arc<Profile>>, executor: impl Into<Executor>) -> Self {
        Self {
            profile: profile.into(),
            executor: executor.into(),
            all_pairs: false,
            edges: EdgeRule::Paper,
            byte_rays: false,
            kernels: Arc::default(),
        }
    }

    /// Disables or enables buckets. With `all_pairs`, every ray is tested against every triangle; otherwise rays of one
    /// origin are split into buckets, each tested only against the triangles near it (section 5.3). Buckets are the
    /// default.
    #[must_use]
    pub fn all_pairs(mut self, all_pairs: bool) -> Self {
        self.all_pairs = all_pairs;
        self
    }

    /// Sets how shared edges are evaluated; [`EdgeRule::Paper`] is the default, and the only rule for passes of the
    /// engine ([`Crossbar::intersect_pass`]).
    #[must_use]
    pub fn edges(mut self, edges: EdgeRule) -> Self {
        self.edges = edges;
        self.kernels = Arc::default();
        self
    }

    /// Stores rays as bytes, as in section 4.1, with the paper's edges ([`super::RayTexels::Bytes`]). Passes of the
    /// engine support only 16 bits.
    #[must_use]
    pub fn byte_rays(mut self) -> Self {
        self.byte_rays = true;
        self.kernels = Arc::default();
        self
    }

    /// Returns the rays as textures of bytes represent them. Fails as [`Crossbar::intersect`] does.
    pub fn rays_in_bytes(&self, mesh: &Mesh, rays: &RayBatch) -> Result<RayBatch, EngineError> {
        let kernel = Kernel::with_byte_rays(&self.profile, Sides::Front)?;
        let units = Units::choose(kernel.numbers(&self.profile.rules), mesh, rays);
        let held: Vec<Ray> = rays.rays().iter().map(|ray| units.in_bytes(ray)).collect::<Result<_, _>>()?;
        Ok(RayBatch::new(rays.width(), rays.height(), held)?)
    }

    /// Intersects all rays with all triangles: section 3.3 of the paper.
    pub fn intersect(&self, mesh: &Mesh, rays: &RayBatch, sides: Sides) -> Result<Answer, EngineError> {
        self.intersect_in_buckets(mesh, rays, sides, BUCKET, None)
    }

    /// Runs [`Crossbar::intersect`] and records the card's log, bucket by bucket, as on a card with one set of textures
    /// and targets. The hits equal the hits of [`Crossbar::intersect`]; the log is the same for every executor and
    /// number of threads. Fails as [`Crossbar::intersect`] does.
    pub fn intersect_recorded(
        &self,
        mesh: &Mesh,
        rays: &RayBatch,
        sides: Sides,
        recording: Recording<'_>,
    ) -> Result<Answer, EngineError> {
        self.intersect_in_buckets(mesh, rays, sides, BUCKET, Some(recording))
    }

    /// Runs one pass of rays of any origin against some triangles, given in ascending order, with or without culling in
    /// the vertex program. Hits are bit-identical either way; culled quads produce no fragments. Fails as
    /// [`Crossbar::intersect`] does.
    pub fn intersect_pass(
        &self,
        mesh: &Mesh,
        triangles: &[u32],
        rays: &RayBatch,
        sides: Sides,
        cull: bool,
    ) -> Result<Answer, EngineError> {
        let mut card = self.pass_card(mesh, sides, cull)?;
        let ((hits, _), events) = card.test(0, mesh, triangles, rays, true)?;
        Ok(Answer { hits: rounded(hits), events, kernel: card.kernel.name, log: Vec::new() })
    }

    pub(super) fn pass_card(&self, mesh: &Mesh, sides: Sides, cull: bool) -> Result<PassCard, EngineError> {
        let kernel = Kernel::for_passes(&self.profile, sides, cull)?;
        check_count(mesh)?;
        Ok(PassCard::new(self.machine()?, kernel, mesh, sides))
    }

    /// Creates a card that keeps these rays in its textures and these triangles in its vertex memory, for repeated
    /// draws of every ray against every triangle, regardless of [`Crossbar::all_pairs`]. Fails as
    /// [`Crossbar::intersect`] does.
    pub fn make_resident(&self, mesh: &Mesh, rays: &RayBatch, sides: Sides) -> Result<ResidentCrossbar, EngineError> {
        let kernel = self.kernel((rays.common_origin().is_some(), sides))?;
        check_count(mesh)?;
        let mut resident = ResidentCrossbar { work: None, rays: rays.clone(), kernel };
        if !rays.rays().is_empty() && !mesh.is_empty() {
            let kernel = &resident.kernel;
            let units = Units::choose(kernel.numbers(&self.profile.rules), mesh, rays);
            let mut machine = self.machine()?;
            let sheet = RayTextures::new(&mut machine, kernel, rays, &units)?;
            let ids: Vec<u32> = (0..mesh.len() as u32).collect();
            resident.work = Some((machine, sheet, units, Streams::new(mesh, kernel, &units, &ids)));
        }
        Ok(resident)
    }

    fn machine(&self) -> Result<Machine, MachineError> {
        self.executor.machine(Arc::clone(&self.profile))
    }

    /// Returns the program for a use, from the cache if possible.
    fn kernel(&self, wanted: KernelUse) -> Result<Arc<Kernel>, EngineError> {
        let mut known = self.kernels.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, kernel)) = known.iter().find(|(held, _)| *held == wanted) {
            return Ok(Arc::clone(kernel));
        }
        let kernel = Arc::new(match self.edges {
            _ if self.byte_rays => Kernel::with_byte_rays(&self.profile, wanted.1)?,
            EdgeRule::Paper => Kernel::choose(&self.profile, wanted.0, wanted.1)?,
            EdgeRule::SharedEdges => Kernel::with_shared_edges(&self.profile, wanted.0, wanted.1)?,
        });
        known.push((wanted, Arc::clone(&kernel)));
        Ok(kernel)
    }

    fn intersect_in_buckets(
        &self,
        mesh: &Mesh,
        rays: &RayBatch,
        sides: Sides,
        side: u32,
        recording: Option<Recording<'_>>,
    ) -> Result<Answer, EngineError> {
        let kernel = self.kernel((rays.common_origin().is_some(), sides))?;
        check_count(mesh)?;
        let mut answer = Answer::without_hits(rays.rays().len(), kernel.name);
        if rays.rays().is_empty() || mesh.is_empty() {
            return Ok(answer);
        }
        let units = Units::choose(kernel.numbers(&self.profile.rules), mesh, rays);
        let buckets = self.buckets(mesh, rays, side);
        let (finished, total) = (AtomicUsize::new(0), buckets.len());
        let Recording { new_observer, done } = recording.unwrap_or_default();
        let draw = |(region, triangles): (Region, Vec<u32>)| -> Result<_, EngineError> {
            let bucket = rays.part(region);
            let mut machine = self.machine()?;
            machine.record(recording.is_some());
            machine.observe_textures(new_observer.map(|make| make()));
            let sheet = RayTextures::new(&mut machine, &kernel, &bucket, &units)?;
            // New targets are already clear; targets that are reused from bucket to bucket must be cleared.
            sheet.clear(&mut machine)?;
            let events =
                sheet.draw(&mut machine, &kernel, &units, &[], &Streams::new(mesh, &kernel, &units, &triangles))?;
            let (hits, _) = sheet.read_back(&machine, &bucket, &units, true)?;
            if let Some(done) = done {
                done(finished.fetch_add(1, Ordering::Relaxed) + 1, total);
            }
            Ok((region, rounded(hits), events, machine.take_log()))
        };
        let drawn: Vec<_> = match total {
            1 => buckets.into_iter().map(draw).collect::<Result<_, _>>()?,
            _ => buckets.into_par_iter().map(draw).collect::<Result<_, _>>()?,
        };
        for (region, hits, events, log) in drawn {
            answer.events += events;
            answer.log.extend(log);
            for (row, hits) in (region.y..).zip(hits.chunks(region.width as usize)) {
                let start = row as usize * rays.width() as usize + region.x as usize;
                answer.hits[start..start + hits.len()].copy_from_slice(hits);
            }
        }
        Ok(answer)
    }

    /// Runs [`Crossbar::intersect`] on rays in any order and number, in batches of at most 65,536. Fails as
    /// [`Crossbar::intersect`] does.
    pub fn intersect_list(&self, mesh: &Mesh, rays: &[Ray], sides: Sides) -> Result<Vec<Option<Hit>>, EngineError> {
        let mut hits = Vec::with_capacity(rays.len());
        for chunk in rays.chunks(LIST_BATCH) {
            let batch = RayBatch::from_list(chunk);
            let answer = self.intersect_in_buckets(mesh, &batch, sides, LIST_BUCKET, None)?;
            hits.extend((0..chunk.len()).map(|i| answer.hits[batch.pixel_of(i)]));
        }
        Ok(hits)
    }

    /// Counts the triangles whose normal the card's format cannot represent, with these rays as one batch, whose extent
    /// determines the units. Fails as [`Crossbar::intersect`] does.
    pub fn bits_left(&self, mesh: &Mesh, rays: &[Ray], sides: Sides) -> Result<BitsLeft, EngineError> {
        let batch = RayBatch::from_list(rays);
        let kernel = self.kernel((batch.common_origin().is_some(), sides))?;
        if rays.is_empty() || mesh.is_empty() {
            return Ok(BitsLeft::default());
        }
        let units = Units::choose(kernel.numbers(&self.profile.rules), mesh, &batch);
        Ok(BitsLeft::of(mesh, kernel.edges, &units))
    }

    /// Splits a batch into buckets, each with its own textures and targets (section 5.3), and lists the triangles to
    /// test against each in ascending order.
    fn buckets(&self, mesh: &Mesh, rays: &RayBatch, side: u32) -> Vec<(Region, Vec<u32>)> {
        let everything = || (0..mesh.len() as u32).collect();
        let Some(origin) = rays.common_origin().filter(|_| !self.all_pairs) else {
            let whole = Region { x: 0, y: 0, width: rays.width(), height: rays.height() };
            return vec![(whole, everything())];
        };
        let bucket = |region: Region| {
            let near = Bundle::of(rays, region, origin).map_or_else(everything, |bundle| bundle.near(mesh));
            (region, near)
        };
        regions(rays, side).into_par_iter().map(bucket).collect()
    }
}

/// A card with rays in its textures and triangles in its vertex memory. [`Crossbar::make_resident`] creates it.
#[derive(Debug)]
pub struct ResidentCrossbar {
    /// `None` if there are no rays or no triangles.
    work: Option<(Machine, RayTextures, Units, Streams)>,
    rays: RayBatch,
    kernel: Arc<Kernel>,
}

impl ResidentCrossbar {
    /// Clears the targets, draws every triangle over every ray, and reads back: the result of
    /// [`Crossbar::intersect`] with all pairs. Fails with [`EngineError::Machine`] if the card rejects the work.
    pub fn intersect(&mut self) -> Result<Answer, EngineError> {
        let answer = Answer::without_hits(self.rays.rays().len(), self.kernel.name);
        let Some((machine, sheet, units, streams)) = &mut self.work else { return Ok(answer) };
        sheet.clear(machine)?;
        let events = sheet.draw(machine, &self.kernel, units, &[], streams)?;
        let (hits, _) = sheet.read_back(machine, &self.rays, units, true)?;
        Ok(Answer { hits: rounded(hits), events, log: machine.take_log(), ..answer })
    }
}

fn check_count(mesh: &Mesh) -> Result<(), EngineError> {
    if mesh.len() > MAX_TRIANGLES {
        return Err(EngineError::TooManyTriangles { found: mesh.len() });
    }
    Ok(())
}
