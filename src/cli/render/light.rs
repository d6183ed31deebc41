//! `crossbar render` with a host renderer.

use std::time::Instant;

use miette::IntoDiagnostic as _;
use refsim::device::Profile;
use serde_json::json;

use super::args::{Args, Renderer};
use crate::card::RasterizedEyes;
use crate::case::device_named;
use crate::cli::executor::{Decider, engine_executor};
use crate::cli::scene_name::{self, Viewpoint};
use crate::cli::words::counted;
use crate::cli::{CommandLine, Out, Problem, ProgressBar, given, study, view};
use crate::geom::exact::Sides;
use crate::io::{require_writable, write_files};
use crate::picture::{Picture, RgbImage};
use crate::renderer::environment::{self, EnvironmentCard};
use crate::renderer::photon::{self, Photons};
use crate::renderer::{RenderedPicture, Settings, WatchProgress, distributed, eye, layers, path, whitted};
use crate::report::digits::count;
use crate::report::{Findings, FoundTable, NamedPicture, Provenance, Table, Verdict};
use crate::scene::{Camera, Scene};
use crate::study::caster::CastRecord;
use crate::tracer::Caster;
use crate::tracer::offset::unit_roundoff;

const SEED: u64 = 1;

/// Renders a scene; `is_lit` if it has its own lights and views.
pub(super) fn run(
    args: &Args,
    scene: &Scene,
    is_lit: bool,
    command_line: &CommandLine,
    out: &mut Out,
) -> miette::Result<Verdict> {
    let renderer = args.light.renderer.unwrap_or(if is_lit { Renderer::Whitted } else { Renderer::Eye });
    args.light.refuse_others(Some(renderer))?;
    check_lights(renderer, scene)?;
    let is_mapped = renderer == Renderer::Environment;
    let executor = args.executor.filter(|_| !is_mapped || args.caster.is_engine());
    let no_card = [
        ("--device", args.device.is_some() && !is_mapped),
        ("--executor", executor.is_some() && !args.caster.is_engine()),
    ];
    let help = "remove the option, or add `--caster engine` and choose the engine's card with `--caster-device`";
    given::refuse(no_card, "the eye rays of a mesh", help)?;
    let caster = args.caster.choose(engine_executor(&args.caster, executor)?)?;
    let drawing = caster.profile().filter(|_| args.light.drawn_eyes);
    let no_engine = [("--drawn-eyes", args.light.drawn_eyes && drawing.is_none())];
    given::refuse(no_engine, "the card of the Ray Engine", "remove `--drawn-eyes`, or add `--caster engine`")?;
    let mapping =
        is_mapped.then(|| device_named(args.device.as_deref().unwrap_or(view::DEFAULT_DEVICE))).transpose()?;
    let viewpoint = Viewpoint { size: args.size, view: args.light.view.as_deref(), eye: args.eye };
    let camera = viewpoint.camera(scene)?;
    require_writable(&args.out).map_err(Problem::from)?;
    let rounding = unit_roundoff(caster.format());
    let mut open = caster.open(scene.mesh(), Sides::Both)?;
    let view = (&camera, mapping.as_ref());
    let picture = match drawing {
        None => trace(renderer, args, scene, view, rounding, &mut open)?,
        Some(profile) => {
            let mut eyes = RasterizedEyes::new(profile, scene.mesh(), camera, &mut open).into_diagnostic()?;
            trace(renderer, args, scene, view, rounding, &mut eyes)?
        }
    };
    let engine = open.record();
    let numbers = layers(&picture, scene, &camera)?;
    let exposure = args.light.exposure.unwrap_or(1.0);
    let caption = format!("{}, exposure {exposure}, encoded in sRGB", renderer.title());
    let mut findings = page(args, &camera, picture.display(exposure), numbers, &caption);
    findings.table(FoundTable::from(rays(&picture)).unprinted());
    let mut provenance = study::with_inputs(Provenance::new(&command_line.text), &scene_name::named_file(&args.scene));
    provenance.seed = Some(args.light.seed.unwrap_or(SEED));
    provenance.profiles.extend(caster.profile().map(|_| caster.label().to_owned()));
    provenance.profiles.extend(mapping.map(|card| card.name));
    report(args, &picture, engine.as_ref(), &mut findings);
    write_files(&args.out, &findings.take_files(&provenance)?).map_err(Problem::from)?;
    study::show(&findings, out)
}

fn rays(picture: &RenderedPicture) -> Table {
    let mut table = Table::of("Rays", "kind rays");
    for (kind, count) in picture.counts.kinds().into_iter().filter(|kind| kind.1 > 0) {
        table.push([kind.into(), count.into()]);
    }
    table
}

/// Refuses a scene without lights that the renderer knows: the picture would be black.
fn check_lights(renderer: Renderer, scene: &Scene) -> Result<(), Problem> {
    let (points, emitters) = (!scene.point_lights.is_empty(), !scene.emitters().is_empty());
    let dark = match renderer {
        Renderer::Eye => false,
        Renderer::Whitted | Renderer::Environment => !points,
        _ => !points && !emitters,
    };
    let help = match emitters {
        true => "use `--renderer distributed`, `path` or `photon`, which its emitters light",
        false => "use `--renderer eye`, which brings its own lamp",
    };
    if dark { Err(Problem::usage("the scene has no lights that this renderer supports", help)) } else { Ok(()) }
}

fn trace(
    renderer: Renderer,
    args: &Args,
    scene: &Scene,
    (camera, card): (&Camera, Option<&Profile>),
    rounding: f64,
    caster: &mut dyn Caster,
) -> miette::Result<RenderedPicture> {
    let light = &args.light;
    let usual = match renderer {
        Renderer::Eye | Renderer::Environment => 1,
        _ if light.drawn_eyes => 1,
        Renderer::Whitted => 4,
        _ => 16,
    };
    let settings = Settings {
        samples: light.samples.unwrap_or(usual),
        depth: light.depth.unwrap_or(8),
        seed: light.seed.unwrap_or(SEED),
        rounding,
        lens: light.lens,
        ..Settings::default()
    };
    let mut photons = Photons::for_scene(scene);
    photons.global = light.photons.unwrap_or(photons.global);
    photons.caustic = light.photons.unwrap_or(photons.caustic);
    photons.gather = light.gather.unwrap_or(photons.gather);
    let (start, bar) =
        (Instant::now(), ProgressBar::new("rendering", 1).quicker("fewer `--samples` or a smaller `--size`"));
    let mut watch = |progress: crate::renderer::RenderProgress| {
        let rate = progress.rays as f64 / start.elapsed().as_secs_f64().max(1e-3) / 1e6;
        bar.show(format!("{}, {rate:.2} M rays/s", progress.what), progress.done, progress.total);
    };
    let watch: &mut WatchProgress<'_> = &mut watch;
    let picture = match renderer {
        Renderer::Eye => eye::render(scene, camera, &settings, caster, watch),
        Renderer::Whitted => whitted::render(scene, camera, &settings, caster, watch),
        Renderer::Environment => {
            let executor = args.executor.unwrap_or(Decider::Batch).open()?;
            let help = "use `--executor scalar`, `batch` or `wgpu`";
            let executor = executor.ok_or_else(|| Problem::usage("a card does not draw in exact arithmetic", help))?;
            let profile = card.ok_or_else(|| Problem::usage("an environment map needs a card", "add a `--device`"))?;
            let card = EnvironmentCard { profile, executor: &executor };
            environment::render(scene, camera, &settings, card, caster, watch)
        }
        Renderer::Distributed => distributed::render(scene, camera, &settings, caster, watch),
        Renderer::Path => path::render(scene, camera, &settings, path::Direct::Both, caster, watch),
        Renderer::Photon => photon::render(scene, camera, &settings, &photons, caster, watch),
    };
    picture.into_diagnostic()
}

fn report(args: &Args, picture: &RenderedPicture, engine: Option<&CastRecord>, found: &mut Findings) {
    let (pixels, hits) = (picture.first.len(), picture.first.iter().flatten().count());
    let counts = picture.counts;
    let kinds: serde_json::Map<_, _> =
        counts.kinds().into_iter().map(|(kind, n)| (kind.to_owned(), n.into())).collect();
    let rays = json!({ "total": counts.rays(), "kinds": kinds, "bundles": counts.bundles });
    found.fields(json!({ "pixels": pixels, "hits": hits, "not_finite": picture.not_finite, "rays": rays,
                         "engine": null, "out": args.out }));
    let kinds: Vec<String> =
        counts.kinds().into_iter().filter(|kind| kind.1 > 0).map(|(kind, n)| format!("{} {kind}", count(n))).collect();
    let [rays, bundles] = [counts.rays(), counts.bundles].map(count);
    found.print(format!("{rays} rays in {bundles} bundles: {}", kinds.join(", ")));
    if let Some(engine) = engine {
        engine.report(found);
    }
    if picture.not_finite > 0 {
        found.print(format!("{} samples were not finite and count as black", count(picture.not_finite)));
    }
    found.print(hits_line(hits, pixels, args));
}

pub(super) fn page(args: &Args, camera: &Camera, image: RgbImage, layers: Picture, caption: &str) -> Findings {
    let mut found = Findings::new(format!("A picture of {}", args.scene.display()));
    found.taken_from(camera.world_to_camera());
    found.pictures(vec![NamedPicture::new("picture", image, caption)]);
    found.paragraph("layers.exr has two numbers for each pixel: the depth along the view (Z) and the triangle.");
    found.keep_layers("layers", layers);
    found
}

pub(super) fn hits_line(hits: usize, pixels: usize, args: &Args) -> String {
    format!("{} of {} pixels hit; written to {}", counted(hits), counted(pixels), args.out.display())
}
