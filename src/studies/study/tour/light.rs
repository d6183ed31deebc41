//! The light of the room: form factors by the Ray Engine's rays, radiosity on a card, and a probe.

use std::f64::consts::PI;

use glam::DVec3;
use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;
use refsim::timing::{Level, Model, Picoseconds};

use crate::geom::exact::Sides;
use crate::geom::vector::wide;
use crate::geom::{Hit, Mesh, Ray};
use crate::radiosity::display::Display;
use crate::radiosity::form_factor::VisibilityParameters;
use crate::radiosity::on_card::{CardSolver, Storage, to_f64};
use crate::radiosity::packing::Packing;
use crate::radiosity::solve::Options;
use crate::radiosity::{FormFactors, Patch, Patches, System};
use crate::renderer::environment::seen_around;
use crate::scene::Camera;
use crate::study::caster::{CastRecord, CasterChoice, makespan};
use crate::study::radiosity::no_card;
use crate::study::{ProgressFn, StudyError};
use crate::tracer::Caster;
use crate::transfer::grid::LIGHT_SIDE;
use crate::transfer::light::CubeLight;

/// Square root of the number of rays per pair of patches.
const SAMPLES: u32 = 2;
/// Maximum number of iterations on the card.
const ITERATIONS: u32 = 40;

/// Computes form factors by rays of a caster.
pub(super) fn factors(
    patches: &Patches,
    caster: &CasterChoice,
    progress: &mut ProgressFn<'_>,
) -> Result<(FormFactors, Option<CastRecord>), StudyError> {
    let mut open = caster.open_judged(patches.mesh(), Sides::Both)?;
    let how = VisibilityParameters { side: SAMPLES, ..VisibilityParameters::default() };
    let what = format!("form factors: {}", caster.label());
    let mut done = |done: usize, of: usize| progress(&what, done as u64, of as u64);
    Ok((FormFactors::with_visibility(patches, &mut open, how, &mut done)?, open.record()))
}

/// Radiosity of each patch, iterations, and their modelled time.
type Solved = (Vec<[f64; 3]>, u32, Option<Picoseconds>);

/// Solves a room's radiosity on a card.
pub(super) fn radiosity(system: &System, profile: &Profile, executor: &Executor) -> Result<Solved, StudyError> {
    let solver = CardSolver::new(profile.clone(), executor.clone(), system, Packing::Rgb, Storage::Fp32);
    let mut solver = solver.map_err(no_card)?;
    solver.record(true);
    let options = Options { tolerance: 1e-6, most_iterations: ITERATIONS };
    let solution = solver.solve(system, &options, &mut |_| ()).map_err(no_card)?;
    let rates = Model::new(Level::Pipeline, profile).ok();
    let time = rates.map(|rates| makespan(&solver.take_log(), &rates)).transpose()?;
    Ok((to_f64(&solution.radiosity), solution.iterations(), time))
}

/// The room drawn by a card, interpolated between corners of patches: exposed linear colors.
pub(super) fn picture(
    patches: &Patches,
    radiosity: &[[f64; 3]],
    (profile, executor): (&Profile, &Executor),
    camera: &Camera,
    exposure: f64,
) -> Result<Vec<[f64; 3]>, StudyError> {
    let machine = executor.clone().machine(profile.clone());
    let mut machine = machine.map_err(|error| StudyError::coded("tour::machine", error))?;
    let display = Display::new(&mut machine, patches, camera, TexelFormat::Rgba32f)?;
    let texture = display.upload(&mut machine, radiosity)?;
    let picture = display.smooth(&mut machine, texture, exposure)?;
    Ok(picture.linear()?.into_iter().map(|pixel| pixel.map(f64::from)).collect())
}

/// The light at a point: for each texel of a cube, the radiance of the patch that a ray from there hits. The coarse
/// bodies in the room are left out, because the point lies in one of them.
pub(super) fn probe(
    patches: &Patches,
    radiosity: &[[f64; 3]],
    walls: &Mesh,
    at: DVec3,
    caster: &CasterChoice,
) -> Result<(CubeLight, Option<CastRecord>), StudyError> {
    let mut open = caster.open_judged(walls, Sides::Front)?;
    let radiance = |(ray, hit): (&Ray, &Option<Hit>)| {
        let Some(hit) = hit else { return [0.0; 3] };
        let point = wide(ray.origin()) + f64::from(hit.t) * wide(ray.direction());
        let face = patches.face_of(hit.triangle);
        let on_face = patches.list().iter().zip(radiosity).filter(|(patch, _)| patch.face == face);
        let distance = |patch: &Patch| patch.center().distance_squared(point);
        let nearest = on_face.min_by(|(a, _), (b, _)| distance(a).total_cmp(&distance(b)));
        nearest.map_or([0.0; 3], |(_, radiosity)| radiosity.map(|b| b / PI))
    };
    let texels = seen_around(at, LIGHT_SIDE as u32, |camera| {
        let rays = camera.rays();
        Ok(rays.iter().zip(&open.cast(&rays)?).map(radiance).collect())
    })?;
    Ok((CubeLight::new(texels)?, open.record()))
}
