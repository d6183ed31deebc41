//! Ray caster that counts rays by kind and reports progress.

use std::ops::AddAssign;

use crate::geom::{Hit, Ray};
use crate::tracer::{CastError, Caster};

/// Purpose of a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RayKind {
    /// From the eye through a pixel.
    Eye,
    /// Towards a light, to test for occlusion.
    Shadow,
    /// Into the mirror direction, or a glossy lobe around it.
    Reflection,
    /// Through a dielectric boundary.
    Refraction,
    /// From a diffuse surface into a random direction, for indirect light.
    Gather,
    /// From a light.
    Photon,
}

/// Number of rays cast, per kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// Number of rays of each [`RayKind`].
    by_kind: [u64; 6],
    /// Bundles in which the rays were cast.
    pub bundles: u64,
}

impl RayCounts {
    /// Total number of rays.
    pub fn rays(&self) -> u64 {
        self.by_kind.iter().sum()
    }

    /// Number of rays of a kind.
    pub fn of(&self, kind: RayKind) -> u64 {
        self.by_kind[kind as usize]
    }

    /// Count of each kind with its name, in the order of [`RayKind`].
    pub fn kinds(&self) -> [(&'static str, u64); 6] {
        let names = ["eye", "shadow", "reflection", "refraction", "gather", "photon"];
        std::array::from_fn(|kind| (names[kind], self.by_kind[kind]))
    }
}

impl AddAssign for RayCounts {
    fn add_assign(&mut self, other: Self) {
        self.by_kind.iter_mut().zip(other.by_kind).for_each(|(sum, rays)| *sum += rays);
        self.bundles += other.bundles;
    }
}

/// Progress of a rendering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RenderProgress {
    /// Current stage: `photons` or `samples`.
    pub what: &'static str,
    /// Samples or photons done.
    pub done: u64,
    /// Samples or photons in total.
    pub total: u64,
    /// Rays cast since the beginning, of any kind.
    pub rays: u64,
}

/// Called with the progress after every bundle.
pub type WatchProgress<'a> = dyn FnMut(RenderProgress) + 'a;

pub(super) struct CountingCaster<'a> {
    caster: &'a mut dyn Caster,
    watch: &'a mut WatchProgress<'a>,
    pub(super) counts: RayCounts,
    progress: RenderProgress,
}

impl<'a> CountingCaster<'a> {
    pub(super) fn new(caster: &'a mut dyn Caster, watch: &'a mut WatchProgress<'a>) -> Self {
        let progress = RenderProgress { what: "samples", done: 0, total: 0, rays: 0 };
        Self { caster, watch, counts: RayCounts::default(), progress }
    }

    /// Begins a stage.
    pub(super) fn begin(&mut self, what: &'static str, total: u64) {
        self.progress = RenderProgress { what, done: 0, total, rays: self.counts.rays() };
    }

    pub(super) fn advance(&mut self, done: u64) {
        self.progress.done += done;
        (self.watch)(self.progress);
    }

    /// Casts a bundle and returns its first hits; `kind` gives the purpose of the ray with an index.
    pub(super) fn cast(
        &mut self,
        rays: &[Ray],
        kind: impl Fn(usize) -> RayKind,
    ) -> Result<Vec<Option<Hit>>, CastError> {
        if rays.is_empty() {
            return Ok(Vec::new());
        }
        for index in 0..rays.len() {
            self.counts.by_kind[kind(index) as usize] += 1;
        }
        self.counts.bundles += 1;
        let hits = self.caster.cast(rays)?;
        self.progress.rays = self.counts.rays();
        (self.watch)(self.progress);
        Ok(hits)
    }
}
