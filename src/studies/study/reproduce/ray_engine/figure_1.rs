//! Figure 1: a boat in wavy water, by an environment map and by ray tracing.

use refsim::device::Profile;
use refsim::machine::{Executor, ExecutorKind};

use super::{EntryFindings, RunResult, Shared, StudyError, paragraph};
use crate::card::RasterizedEyes;
use crate::geom::exact::Sides;
use crate::io::scenes;
use crate::ray_engine::engine::{EngineParameters, RayEngine};
use crate::renderer::environment::{self, EnvironmentCard};
use crate::renderer::{RenderedPicture, Settings, whitted};
use crate::report::{Cell, Table};
use crate::tracer::HostTracer;
use crate::tracer::offset::unit_roundoff;

/// Card that draws the environment map and the visible surfaces.
const DRAWS: &str = "r200";
/// Cards of the engine. The card that draws is not among them, because its fixed-point arithmetic leaks.
const ENGINES: [&str; 2] = ["r300", "ideal-fp32"];
const SIZE: [u32; 2] = [160, 120];
/// Smallest difference that an 8-bit display shows.
const STEP: f64 = 1.0 / 255.0;
const HOW: &str = "The scene is our own, in {} x {} pixels with one ray per pixel: a boat, posts and houses in mirroring water with three waves. The \
    reference is ray-cast on the host. A {} draws the picture with the environment map: the view direction is reflected at vertices, and looked up \
    in a cube map with byte texels. In the hybrid pictures, that card draws the visible surfaces, and the engine casts reflection and shadow rays. \
    Differences are in linear color, over the water pixels. The paper prints no numbers for this figure.";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let scene = scenes::named("harbour").ok_or("no scene `harbour`").on(DRAWS)?;
    let view = scene.views.first().ok_or("no view").on(DRAWS)?;
    let camera = view.camera(SIZE[0], SIZE[1]).on(DRAWS)?;
    let (settings, profile) = (Settings::default(), Profile::named(DRAWS)?);
    let mut host = HostTracer::new(scene.mesh(), Sides::Both);
    let traced = whitted::render(&scene, &camera, &settings, &mut host, &mut |_| {}).on(DRAWS)?;
    let card = EnvironmentCard { profile: &profile, executor: &Executor::from(ExecutorKind::Batch) };
    let mapped = environment::render(&scene, &camera, &settings, card, &mut host, &mut |_| {}).on(DRAWS)?;
    let is_water = |pixel: &usize| traced.first[*pixel].is_some_and(|hit| scene.material(hit.triangle).name == "water");
    let water: Vec<usize> = (0..traced.color.len()).filter(is_water).collect();
    let mut table = Table::of(
        "Reflections in water by ray casting, by environment map, and by hybrid rendering",
        "picture rays drawn_eye_rays rays_on_card_% rms_255ths largest_255ths pixels_that_differ_%",
    );
    let mut push = |name: String, picture: &RenderedPicture, engine: [Cell; 2]| {
        let [rms, largest, differ] = difference(&traced, picture, &water);
        let [drawn, share] = engine;
        let rays = Cell::from(picture.counts.rays());
        table.push([
            name.into(),
            rays,
            drawn,
            share,
            Cell::measured(rms),
            Cell::measured(largest),
            Cell::decimals(differ, 1),
        ]);
    };
    push("rays, host".to_owned(), &traced, [Cell::from(0_u64), Cell::from("")]);
    push(format!("environment map, {DRAWS}"), &mapped, [Cell::from(0_u64), Cell::from("")]);
    for device in ENGINES {
        let parameters = EngineParameters { sides: Sides::Both, ..EngineParameters::default() };
        let card = Profile::named(device)?;
        let rounding = unit_roundoff(card.rules.format);
        let engine = RayEngine::new(scene.mesh(), card, ExecutorKind::Batch, parameters);
        let mut engine = engine.on(device)?;
        let mut eyes = RasterizedEyes::new(&profile, scene.mesh(), camera, &mut engine).on(DRAWS)?;
        let settings = Settings { rounding, ..settings.clone() };
        let hybrid = whitted::render(&scene, &camera, &settings, &mut eyes, &mut |_| {}).on(device)?;
        let drawn = Cell::from(eyes.drawn);
        let share = Cell::decimals(100.0 * engine.counts().share_on_card(), 1);
        push(format!("hybrid, engine on {device}"), &hybrid, [drawn, share]);
    }
    Ok(EntryFindings::new([paragraph(HOW, &[&SIZE[0], &SIZE[1], &DRAWS])], [], [], [table]))
}

/// RMS and largest difference of a channel over some pixels, in steps of 1/255, and the percentage of pixels that
/// differ by more than one step.
fn difference(one: &RenderedPicture, other: &RenderedPicture, pixels: &[usize]) -> [f64; 3] {
    let of = |&pixel: &usize| {
        let (a, b) = (one.color[pixel], other.color[pixel]);
        [0, 1, 2].map(|channel| (a[channel].min(1.0) - b[channel].min(1.0)).abs() / STEP)
    };
    let all: Vec<[f64; 3]> = pixels.iter().map(of).collect();
    let squares: f64 = all.iter().flatten().map(|off| off * off).sum();
    let largest = all.iter().flatten().fold(0.0_f64, |most, off| most.max(*off));
    let differ = all.iter().filter(|off| off.iter().any(|off| *off > 1.0)).count();
    [(squares / (3 * pixels.len()) as f64).sqrt(), largest, 100.0 * differ as f64 / pixels.len() as f64]
}
