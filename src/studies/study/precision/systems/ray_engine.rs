//! The Ray Engine: eye rays on the teapot, judged by exact arithmetic.

use glam::{DMat3, DVec3};
use refsim::device::Profile;
use refsim::isa::Version;
use refsim::machine::{Executor, ExecutorKind};

use super::subject::{INPUTS, PICTURE, PixelPrograms, SystemSubject};
use crate::geom::exact::{Sides, Tracer};
use crate::geom::teapot::teapot;
use crate::picture::rgb8;
use crate::ray_engine::{Crossbar, RayBatch};
use crate::scene::Camera;
use crate::study::StudyError;
use crate::study::leaky_teapot::{JudgedRays, PixelVerdict};
use crate::study::precision::goal::Goal;
use crate::study::precision::subject::{Measured, PrecisionMeasure};

/// Number of quads per side of a Bezier patch.
const TESSELLATION: u32 = 4;

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

/// Eye rays on the teapot, from two sides. By default, at most one ray in a thousand is wrong. A bound on leaks alone
/// would not suffice: a format in which every ray hits something has no leaks.
pub(super) fn subject(mut profile: Profile) -> Result<SystemSubject, StudyError> {
    // Devices that support both versions choose between them by the format of their registers.
    if profile.supports(Version::Ps2_0) {
        profile.limits.versions.retain(|version| *version != Version::Ps1_4);
    }
    let mesh = teapot(TESSELLATION).expect("a tessellation above 0");
    let camera = Camera::teapot(PICTURE, PICTURE).expect("a picture of some pixels");
    let turned = camera.carried(DVec3::ZERO, &DMat3::from_cols(DVec3::Y, -DVec3::X, DVec3::Z));
    let tracer = Tracer::new(&mesh);
    let views = [camera, turned].map(|camera| {
        let view = RayBatch::new(PICTURE, PICTURE, camera.rays()).expect("a ray for each pixel");
        let judged = JudgedRays::new(&tracer, view.rays().to_vec(), Sides::Front);
        (view, judged)
    });
    let measure = move |input: usize, profile: &Profile, executor: &Executor| -> Result<Measured, StudyError> {
        let (view, judged) = &views[input];
        let hits = Crossbar::new(profile.clone(), executor.clone()).intersect(&mesh, view, Sides::Front)?.hits;
        let (verdicts, tally) = judged.judge(&mesh, &hits);
        let values = vec![
            ("leaks", tally.leaks as f64),
            ("wrong_triangles", tally.wrong_triangle as f64),
            ("false_hits", tally.false_hits as f64),
            ("wrong", tally.wrong() as f64 / tally.rays as f64),
            ("largest_t", tally.largest_t_error),
        ];
        let mut pixels = judged.pixels(&verdicts);
        let picture = Some(rgb8(PICTURE, PICTURE, pixels.clone().map(PixelVerdict::color)));
        let worst = pixels.position(|verdict| verdict.is_error());
        let worst = worst.map(|at| format!("ray at pixel {}, {}", at as u32 % PICTURE, at as u32 / PICTURE));
        Ok(Measured { values, worst, picture })
    };
    let executor = ExecutorKind::Batch.into();
    let (programs, _) =
        PixelPrograms::of(&profile, &executor, |device, executor| measure(INPUTS[0], device, executor))?;
    let goal = Goal::at_most("wrong", 0.001);
    let (title, measure) = ("The Ray Engine on the teapot", Box::new(measure));
    Ok(SystemSubject { title, goal, measures: &MEASURES, profile, executor, programs, measure })
}
