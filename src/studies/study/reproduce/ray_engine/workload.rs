//! Workloads: a renderer's ray bundles, recorded once and replayed to engines.

use refsim::timing::host::{CPU_ONLY_RAYS_PER_SECOND, HostCounts, HostModel, HostOperation, HostWeights};

use super::{RunResult, StudyError};
use crate::geom::exact::Sides;
use crate::geom::{Hit, Mesh, Ray};
use crate::io::scenes;
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
