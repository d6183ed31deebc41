//! The light of the room: form factors by the Ray Engine's rays, radiosity on a card, and a probe.

use std::f64::consts::PI;

use glam::DVec3;
use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;
use refsim::timing::Picoseconds;

use super::clock::modelled;
use crate::geom::exact::Sides;
use crate::geom::vector::{narrow, wide};
use crate::geom::{Mesh, Ray};
use crate::radiosity::display::Display;
use crate::radiosity::form_factor::VisibilityParameters;
use crate::radiosity::on_card::{CardOptions, CardSolver, Storage, to_f64};
use crate::radiosity::packing::Packing;
use crate::radiosity::{FormFactors, Patches, System};
use crate::scene::Camera;
use crate::sphere::{HarmonicLight, harmonics};
use crate::study::caster::{CastRecord, CasterChoice};
use crate::study::radiosity::no_card;
use crate::study::{ProgressFn, StudyError};
use crate::tracer::Caster;
use crate::transfer::grid::{LIGHT_MAP, LIGHT_SIDE, LIGHT_TEXELS, face_row_column, texel_center};
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
    let options = CardOptions { tolerance: 1e-6, most_iterations: ITERATIONS, check_every: 1 };
    let solution = solver.solve(system, &options, &mut |_| ()).map_err(no_card)?;
    Ok((to_f64(&solution.radiosity), solution.iterations(), modelled(profile, &solver.take_log())?))
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
    let ray = |texel| Ray::new(narrow(at), narrow(texel_center(texel)));
    let rays: Vec<Ray> = (0..LIGHT_TEXELS).map(ray).collect::<Result<_, _>>()?;
    let mut open = caster.open_judged(walls, Sides::Front)?;
    let hits = open.cast(&rays).map_err(crate::error::InputError::from)?;
    let radiance = |(ray, hit): (&Ray, &Option<crate::geom::Hit>)| {
        let Some(hit) = hit else { return [0.0; 3] };
        let point = wide(ray.origin()) + f64::from(hit.t) * wide(ray.direction());
        let face = patches.face_of(hit.triangle);
        let on_face = patches.list().iter().zip(radiosity).filter(|(patch, _)| patch.face == face);
        let distance = |patch: &crate::radiosity::Patch| patch.center().distance_squared(point);
        let nearest = on_face.min_by(|(a, _), (b, _)| distance(a).total_cmp(&distance(b)));
        nearest.map_or([0.0; 3], |(_, radiosity)| radiosity.map(|b| b / PI))
    };
    Ok((CubeLight::new(rays.iter().zip(&hits).map(radiance).collect())?, open.record()))
}

/// Projects the light to harmonics.
pub(super) fn harmonic(light: &CubeLight, order: usize) -> Result<HarmonicLight, StudyError> {
    let mut y = vec![0.0; order * order];
    let mut channels = [const { Vec::new() }; 3].map(|_: Vec<f64>| vec![0.0; order * order]);
    for (texel, radiance) in light.texels().iter().enumerate() {
        let [_, row, column] = face_row_column(texel, LIGHT_SIDE);
        harmonics(order, texel_center(texel), &mut y);
        let solid_angle = LIGHT_MAP.solid_angle(column, row);
        for (channel, radiance) in channels.iter_mut().zip(radiance) {
            channel.iter_mut().zip(&y).for_each(|(sum, y)| *sum += solid_angle * radiance * y);
        }
    }
    Ok(HarmonicLight::new(channels)?)
}
