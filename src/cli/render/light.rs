//! `crossbar render` with a host renderer.

use std::io::Write as _;
use std::time::Instant;

use clap::ValueEnum;
use miette::IntoDiagnostic as _;
use refsim::num::{Format, Kind, Rounding};
use serde_json::json;

use super::scene::{Asked, camera};
use super::{Args, Out, Problem, SMALLER, Verdict, view};
use crate::cli::caster::{self, CasterArg};
use crate::cli::{Progress, memory, number};
use crate::geom::exact::Sides;
use crate::io::atomic::FileSet;
use crate::ray_engine::engine::EngineCounts;
use crate::renderer::photon::{self, Photons};
use crate::renderer::{Lens, RenderedPicture, Settings, WatchProgress, distributed, eye, path, tone, whitted};
use crate::report::picture::rgb8;
use crate::report::{Channel, exr};
use crate::scene::{Camera, Scene};
use crate::tracer::Caster;

/// How light is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Renderer {
    /// Eye rays alone, with a lamp at the eye
    Eye,
    /// Point lights, hard shadows, mirrors, glass
    Whitted,
    /// Soft shadows, gloss, depth of field; no light between diffuse surfaces
    Distributed,
    /// All light, by random walks, unbiased
    Path,
    /// All light, by photon maps and final gather
    Photon,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Light")]
pub(super) struct LightArgs {
    /// How light is found [default for scenes by name: whitted]
    #[arg(long, value_enum, value_name = "R")]
    renderer: Option<Renderer>,

    /// Samples a pixel [default: 1 for eye, 4 for whitted, else 16]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    samples: Option<u32>,

    /// The most surfaces that light meets between lamp and eye
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(0..=1024))]
    depth: u32,

    /// Which random numbers
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,

    /// A view of the scene, by its name [default: its first]
    #[arg(long, value_name = "NAME")]
    pub(super) view: Option<String>,

    /// What radiance is multiplied by for picture.png; 1 is white
    #[arg(long, value_name = "X", default_value_t = 1.0, value_parser = number::positive)]
    exposure: f64,

    /// Radiance that Whitted's model adds to what diffuse surfaces show, times their albedo; 0 leaves shadows black
    #[arg(long, value_name = "X", default_value_t = 0.08, value_parser = number::not_negative_single)]
    ambient: f64,

    /// A lens: its radius, and the distance at which all is sharp
    #[arg(long, value_name = "RADIUS,FOCUS", value_parser = parse_lens, allow_hyphen_values = true)]
    lens: Option<Lens>,

    /// Photons for each map [default: 100000]
    #[arg(long, value_name = "N")]
    photons: Option<u32>,

    /// Gather rays of each hit of photon mapping; 0 shows the map itself [default: 16]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=65536))]
    gather: Option<u32>,

    /// Who finds first hits [default: host]
    #[arg(long, value_enum, value_name = "C")]
    caster: Option<CasterArg>,

    /// Say on standard error how long it took, and how many rays a second that is
    #[arg(long)]
    time: bool,
}

impl LightArgs {
    /// Whether anything was said that only makes sense of a lit scene.
    pub(super) fn asked(&self) -> bool {
        self.renderer.is_some() || self.samples.is_some() || self.view.is_some() || self.caster.is_some()
    }
}

fn parse_lens(text: &str) -> Result<Lens, String> {
    let (radius, focus) =
        text.split_once(',').ok_or_else(|| format!("expected RADIUS,FOCUS as in 0.02,1.5; found `{text}`"))?;
    let radius = number::not_negative(radius).map_err(|what| format!("radius: {what}"))?;
    let focus = number::positive(focus).map_err(|what| format!("focus: {what}"))?;
    Ok(Lens { radius, focus })
}

pub(super) fn run(args: &Args, asked: &Asked, out: &mut Out) -> miette::Result<Verdict> {
    let renderer = args.light.renderer.unwrap_or(if asked.lit { Renderer::Whitted } else { Renderer::Eye });
    check_lights(renderer, &asked.scene)?;
    let caster = args.light.caster.unwrap_or(CasterArg::Host);
    let caster = caster.choose(args.device.as_deref(), args.executor, &args.gpu)?;
    let camera = camera(args, &asked.scene)?;
    require_memory(args, renderer, &asked.scene)?;
    let folder = FileSet::new(&args.out).map_err(Problem::from)?;
    let rounding = unit_roundoff(caster.format());
    let mut caster = caster.build(asked.scene.mesh(), Sides::from(args.sides))?;
    let picture = trace(renderer, args, &asked.scene, &camera, rounding, caster.caster())?;
    let engine = caster.counts();
    view::write_folder(folder, &files(&picture, args.light.exposure)?)?;
    tell(args, &picture, engine.as_ref(), out)?;
    Ok(Verdict::Done)
}

/// What the picture, its files and the photons take.
fn require_memory(args: &Args, renderer: Renderer, scene: &Scene) -> Result<(), Problem> {
    const PER_PIXEL: u64 = 250;
    const PER_PHOTON: u64 = 450;
    let photons = match renderer {
        Renderer::Photon => {
            let usual = Photons::for_scene(scene);
            let [global, caustic] = [usual.global, usual.caustic].map(|n| u64::from(args.light.photons.unwrap_or(n)));
            (global + caustic) * PER_PHOTON
        }
        _ => 0,
    };
    let need = memory::of_pixels(args.size.width, args.size.height, PER_PIXEL, photons);
    let help = if photons > 0 { "ask for a smaller `--size` or fewer `--photons`" } else { SMALLER };
    memory::require(format_args!("a lit picture of {} pixels", args.size), need, help)
}

/// Half a step of single precision, the host's.
const SINGLE: f64 = 1.0 / 16_777_216.0;

/// Half a step of a format's numbers near 1, a whole one where it cuts off; of single precision at most, since rays are single precision.
fn unit_roundoff(format: Format) -> f64 {
    let bits = match format.kind {
        Kind::Fixed { frac_bits, .. } => frac_bits,
        Kind::Float { man_bits, .. } => man_bits,
    };
    let nearest = matches!(format.rounding, Rounding::NearestEven | Rounding::NearestAway);
    let step = 1.0 / f64::from(1_u32 << bits.min(31));
    (if nearest { step / 2.0 } else { step }).max(SINGLE)
}

/// A picture without any light is not what anybody asks for.
fn check_lights(renderer: Renderer, scene: &Scene) -> Result<(), Problem> {
    let (points, emitters) = (!scene.point_lights.is_empty(), !scene.emitters().is_empty());
    let dark = match renderer {
        Renderer::Eye => false,
        Renderer::Whitted => !points,
        _ => !points && !emitters,
    };
    let help = match emitters {
        true => "use `--renderer distributed`, `path` or `photon`, which its emitters light",
        false => "use `--renderer eye`, which brings its own lamp",
    };
    if dark { Err(Problem::usage("the scene has no lights that this renderer knows", help)) } else { Ok(()) }
}

fn trace(
    renderer: Renderer,
    args: &Args,
    scene: &Scene,
    camera: &Camera,
    rounding: f64,
    caster: &mut dyn Caster,
) -> miette::Result<RenderedPicture> {
    let light = &args.light;
    let usual = match renderer {
        Renderer::Eye => 1,
        Renderer::Whitted => 4,
        _ => 16,
    };
    let settings = Settings {
        samples: light.samples.unwrap_or(usual),
        depth: light.depth,
        seed: light.seed,
        rounding,
        lens: light.lens,
        ambient: [light.ambient as f32; 3],
        ..Settings::default()
    };
    let mut photons = Photons::for_scene(scene);
    photons.global = light.photons.unwrap_or(photons.global);
    photons.caustic = light.photons.unwrap_or(photons.caustic);
    photons.gather = light.gather.unwrap_or(photons.gather);
    let (start, bar) = (Instant::now(), Progress::new("rendering", 1));
    let mut watch = |progress: crate::renderer::RenderProgress| {
        let rate = progress.rays as f64 / start.elapsed().as_secs_f64().max(1e-3) / 1e6;
        bar.show(format!("{}, {rate:.2} M rays/s", progress.what), progress.done, progress.total);
    };
    let watch: &mut WatchProgress<'_> = &mut watch;
    let picture = match renderer {
        Renderer::Eye => eye::render(scene, camera, &settings, caster, watch),
        Renderer::Whitted => whitted::render(scene, camera, &settings, caster, watch),
        Renderer::Distributed => distributed::render(scene, camera, &settings, caster, watch),
        Renderer::Path => path::render(scene, camera, &settings, path::Direct::Both, caster, watch),
        Renderer::Photon => photon::render(scene, camera, &settings, &photons, caster, watch),
    };
    let picture = picture.into_diagnostic()?;
    if light.time {
        let seconds = start.elapsed().as_secs_f64();
        let rate = picture.counts.rays() as f64 / seconds.max(1e-9) / 1e6;
        // Nothing is to be done if nobody reads this.
        writeln!(std::io::stderr().lock(), "time: {seconds:.2} s, {rate:.3} M rays/s").ok();
    }
    Ok(picture)
}

fn files(picture: &RenderedPicture, exposure: f64) -> miette::Result<Vec<(String, Vec<u8>)>> {
    let (w, h) = (picture.width as usize, picture.height as usize);
    let [red, green, blue] = [0, 1, 2].map(|channel| picture.channel(channel));
    let (t, triangles) = (picture.t(), picture.triangles());
    let layers = [
        ("R", Channel::Float(&red)),
        ("G", Channel::Float(&green)),
        ("B", Channel::Float(&blue)),
        ("t", Channel::Float(&t)),
        ("triangle", Channel::Uint(&triangles)),
    ];
    Ok(vec![
        ("picture.png".to_owned(), rgb8(w, h, &tone::bytes(&picture.color, exposure))?),
        ("layers.exr".to_owned(), exr(w, h, &layers)?),
    ])
}

fn tell(args: &Args, picture: &RenderedPicture, engine: Option<&EngineCounts>, out: &mut Out) -> miette::Result<()> {
    let (pixels, found) = (picture.first.len(), picture.first.iter().flatten().count());
    let counts = picture.counts;
    if out.json() {
        let kinds: serde_json::Map<_, _> =
            counts.kinds().into_iter().map(|(kind, n)| (kind.to_owned(), n.into())).collect();
        let engine = engine.map(caster::document);
        let rays = json!({ "total": counts.rays(), "kinds": kinds, "bundles": counts.bundles });
        out.document(&json!({ "pixels": pixels, "hits": found, "not_finite": picture.not_finite, "rays": rays,
                              "engine": engine, "out": args.out }))?;
        return Ok(());
    }
    let kinds: Vec<String> =
        counts.kinds().into_iter().filter(|kind| kind.1 > 0).map(|(kind, n)| format!("{n} {kind}")).collect();
    out.line(format_args!("{} rays in {} bundles: {}", counts.rays(), counts.bundles, kinds.join(", ")))?;
    if let Some(engine) = engine {
        out.line(format_args!("{}", caster::sentence(engine)))?;
    }
    if picture.not_finite > 0 {
        out.line(format_args!("{} samples were not finite and count as black", picture.not_finite))?;
    }
    out.line(format_args!("{found} of {pixels} pixels hit; written to {}", args.out.display()))?;
    Ok(())
}
