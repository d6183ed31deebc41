//! What renderers ask: their bundles of rays, written down once and played to engines of all kinds.

use super::super::ReproduceError;
use super::super::pipeline::failed;
use super::engine_run::{HostOnly, OCTREE, TIMES};
use crate::geom::exact::Sides;
use crate::geom::{Hit, Mesh, Ray};
use crate::renderer::{RenderError, Settings, distributed, eye, whitted};
use crate::scene::{Camera, Scene, built};
use crate::tracer::octree::OctreeParameters;
use crate::tracer::{CastError, Caster};
use crate::tracer::{HostCounts, HostTracer};

/// Which renderer asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Asks {
    /// Eye rays alone.
    Eyes,
    /// Whitted's: what the paper calls classical.
    Classical,
    /// Distributed ray tracing with so many samples a pixel: Monte Carlo.
    MonteCarlo(u32),
}

/// A scene of Table 1 and how it is rendered.
#[derive(Clone, Copy, Debug)]
pub(super) struct Job {
    pub(super) scene: &'static str,
    pub(super) view: Option<&'static str>,
    pub(super) asks: Asks,
    /// Pixels on a side of the picture, which the paper does not say.
    pub(super) side: u32,
}

/// The teapot room as Tables 3 to 5 render it.
pub(super) const CLASSICAL_TEAPOT: Job = Job { scene: "teapot-room", view: None, asks: Asks::Classical, side: 256 };

/// The bundles of a picture.
#[derive(Clone, Debug)]
pub(super) struct Workload {
    pub(super) mesh: Mesh,
    /// In the order in which the renderer asked.
    pub(super) bundles: Vec<Vec<Ray>>,
    /// What a host does for them without card and ray tree.
    pub(super) alone: HostOnly,
}

impl Workload {
    /// What a host does for the same rays with another octree.
    pub(super) fn alone_with(&self, octree: OctreeParameters) -> HostOnly {
        let tracer = HostTracer::with_octree(&self.mesh, octree, Sides::Both);
        let mut cost = HostCounts::default();
        for bundle in &self.bundles {
            cost += tracer.nearest_all(bundle).1;
        }
        HostOnly::of(&cost)
    }
}

/// A host tracer that writes down what it is asked, and what that costs.
struct Recording {
    tracer: HostTracer,
    bundles: Vec<Vec<Ray>>,
    cost: HostCounts,
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
    /// What the renderer asks.
    pub(super) fn workload(&self) -> Result<Workload, ReproduceError> {
        let fail = failed(TIMES);
        let scene = built::build(self.scene).ok_or_else(|| fail(&format!("no scene `{}`", self.scene)))?;
        let view = match self.view {
            Some(name) => scene.view(name),
            None => scene.views.first(),
        };
        let view = view.ok_or_else(|| fail(&format!("scene `{}` lacks its view", self.scene)))?;
        let camera = view.camera(self.side, self.side).map_err(|e| fail(&e))?;
        let tracer = HostTracer::with_octree(scene.mesh(), OCTREE, Sides::Both);
        let mut recording = Recording { tracer, bundles: Vec::new(), cost: HostCounts::default() };
        self.render(&scene, &camera, &mut recording).map_err(|e| fail(&e))?;
        Ok(Workload { mesh: scene.mesh().clone(), bundles: recording.bundles, alone: HostOnly::of(&recording.cost) })
    }

    fn render(&self, scene: &Scene, camera: &Camera, caster: &mut dyn Caster) -> Result<(), RenderError> {
        let settings = Settings::default();
        let mut watch = |_| {};
        match self.asks {
            Asks::Eyes => eye::render(scene, camera, &settings, caster, &mut watch).map(drop),
            Asks::Classical => whitted::render(scene, camera, &settings, caster, &mut watch).map(drop),
            Asks::MonteCarlo(samples) => {
                let settings = Settings { samples, ..settings };
                distributed::render(scene, camera, &settings, caster, &mut watch).map(drop)
            }
        }
    }
}
