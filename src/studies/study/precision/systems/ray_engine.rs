//! The Ray Engine: eye rays on the teapot, judged by exact arithmetic.

use glam::{DMat3, DVec3};
use refsim::device::Profile;
use refsim::isa::Version;
use refsim::machine::{Executor, ExecutorKind};

use super::programs::PixelPrograms;
use crate::geom::Mesh;
use crate::geom::exact::{Sides, Tracer};
use crate::geom::teapot::teapot;
use crate::picture::rgb8;
use crate::ray_engine::{Crossbar, RayBatch};
use crate::scene::Camera;
use crate::study::StudyError;
use crate::study::leaky_teapot::{JudgedRays, PixelVerdict};
use crate::study::precision::goal::Goal;
use crate::study::precision::subject::{Measured, PrecisionMeasure, PrecisionSubject, StudiedProgram};

/// Number of quads per side of a Bezier patch.
const TESSELLATION: u32 = 4;
/// Number of pixels per side of the view.
const SIDE: u32 = 64;

const MEASURES: [PrecisionMeasure; 5] = [
    PrecisionMeasure { name: "leaks", meaning: "rays that miss a surface which they hit exactly" },
    PrecisionMeasure { name: "wrong_triangles", meaning: "rays that hit another triangle than the first" },
    PrecisionMeasure { name: "false_hits", meaning: "rays that hit where there is no surface" },
    PrecisionMeasure {
        name: "wrong",
        meaning: "share of the rays, in [0, 1], that leak, hit by mistake or hit a wrong triangle",
    },
    PrecisionMeasure {
        name: "largest_t",
        meaning: "largest error of t where both hit, in lengths of the ray's direction",
    },
];

/// Eye rays on the teapot.
pub(super) struct RayEngineSubject {
    profile: Profile,
    executor: Executor,
    mesh: Mesh,
    /// View of the search, and the held-back view.
    views: [(RayBatch, JudgedRays); 2],
    programs: PixelPrograms,
}

impl RayEngineSubject {
    /// Finds the rays' exact hits.
    pub(super) fn new(mut profile: Profile) -> Result<Self, StudyError> {
        // Devices that support both versions choose between them by the format of their registers.
        if profile.supports(Version::Ps2_0) {
            profile.limits.versions.retain(|version| *version != Version::Ps1_4);
        }
        let mesh = teapot(TESSELLATION).expect("a tessellation above 0");
        let camera = Camera::teapot(SIDE, SIDE).expect("a picture of some pixels");
        let turned = camera.carried(DVec3::ZERO, &DMat3::from_cols(DVec3::Y, -DVec3::X, DVec3::Z));
        let tracer = Tracer::new(&mesh);
        let views = [camera, turned].map(|camera| {
            let view = RayBatch::new(SIDE, SIDE, camera.rays()).expect("a ray for each pixel");
            let judged = JudgedRays::new(&tracer, view.rays().to_vec(), Sides::Front);
            (view, judged)
        });
        let executor = ExecutorKind::Batch.into();
        let programs = drawn(&profile, &executor, &mesh, &views[0].0)?;
        Ok(Self { profile, executor, mesh, views, programs })
    }

    /// Traces a view on a device, and measures its errors.
    fn measured(
        &self,
        (view, judged): &(RayBatch, JudgedRays),
        profile: &Profile,
        is_pictured: bool,
    ) -> Result<Measured, StudyError> {
        let hits =
            Crossbar::new(profile.clone(), self.executor.clone()).intersect(&self.mesh, view, Sides::Front)?.hits;
        let (verdicts, tally) = judged.judge(&self.mesh, &hits);
        let wrong = tally.leaks + tally.false_hits + tally.wrong_triangle;
        let values = vec![
            ("leaks", tally.leaks as f64),
            ("wrong_triangles", tally.wrong_triangle as f64),
            ("false_hits", tally.false_hits as f64),
            ("wrong", wrong as f64 / tally.rays as f64),
            ("largest_t", tally.largest_t_error),
        ];
        let mut pixels = judged.pixels(&verdicts);
        let picture = is_pictured.then(|| rgb8(SIDE, SIDE, pixels.clone().map(PixelVerdict::color)));
        let worst = pixels.position(|verdict| verdict.is_error());
        let worst = worst.map(|at| {
            let (x, y) = (at as u32 % SIDE, at as u32 / SIDE);
            format!("ray at pixel {x}, {y}")
        });
        Ok(Measured { values, worst, picture })
    }
}

/// Programs that find the hits of a view.
fn drawn(profile: &Profile, executor: &Executor, mesh: &Mesh, view: &RayBatch) -> Result<PixelPrograms, StudyError> {
    let (programs, _) = PixelPrograms::of(profile, executor, |device, executor| {
        Ok(Crossbar::new(device.clone(), executor.clone()).intersect(mesh, view, Sides::Front)?)
    })?;
    Ok(programs)
}

impl PrecisionSubject for RayEngineSubject {
    fn title(&self) -> String {
        "The Ray Engine on the teapot".to_owned()
    }

    fn profile(&self) -> &Profile {
        &self.profile
    }

    fn programs(&self) -> Vec<StudiedProgram<'_>> {
        self.programs.list()
    }

    fn measures(&self) -> &[PrecisionMeasure] {
        &MEASURES
    }

    /// At most one ray in a thousand is wrong. A bound on leaks alone would not suffice: a format in which every ray
    /// hits something has no leaks.
    fn default_goal(&self) -> Goal {
        Goal::at_most("wrong", 0.001)
    }

    fn measure(&self, profile: &Profile, wanted: Option<&str>) -> Result<Measured, StudyError> {
        self.measured(&self.views[0], profile, wanted.is_none())
    }

    fn chooses_other_programs(&self, profile: &Profile) -> Result<bool, StudyError> {
        Ok(!drawn(profile, &self.executor, &self.mesh, &self.views[0].0)?.are_among(&self.programs))
    }

    fn held_back(&self, profile: &Profile) -> Result<Option<Measured>, StudyError> {
        self.measured(&self.views[1], profile, false).map(Some)
    }
}
