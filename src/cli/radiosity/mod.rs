//! `crossbar radiosity`: matrix radiosity on a card and on the host, side by side.

mod ask;

use std::path::PathBuf;

use clap::ValueEnum;

use super::executor::{DeviceExecutor, GpuArgs};
use super::scene_name::{self, EyeArgs, Stand};
use super::size::Size;
use super::{Out, Problem, Progress, Verdict, memory, number, view};
use crate::io::atomic::FileSet;
use crate::radiosity::solve::Options;
use crate::report::Provenance;
use crate::study::radiosity::{Parameters, files, run as run_study, tables};

const EXAMPLES: &str = "\
Examples:
  crossbar radiosity cornell-room
      the paper's scene on an emulated GeForce FX 5900 Ultra, Gauss-Seidel and the direct solution beside it, as one page
  crossbar radiosity cornell-room-blocks --packing rgb --packing luminance --storage fp32 --storage fp16 --frames 1,2,4,8
      both packings in both precisions, and how the room looks after some iterations
  crossbar radiosity cornell-room --emit light=4,12,17 --paint red=0.1,0.1,0.6
      solve, then change the light and the left wall, and go on from the solution
  crossbar radiosity room.obj --patches 2000 --solver gauss-seidel --solver sor:1.15 --solver shooting --solver direct
      a scene of your own, on the host alone
  crossbar radiosity cornell-room --solver card --storage fp16 --switch rounding=rtz --sweep 60,240,515,889
      half floats on a card that truncates, and how dark the room gets with more patches and under every open switch

Written to --out: index.html (self-contained), rows.csv, patches.csv, study.json, residual.svg, with --sweep \
sweep.csv and sweep.svg, pictures of every way \
(NAME-flat.png, NAME-smooth.png) and of --frames; with a way on a card timeline.json, a trace for https://ui.perfetto.dev or \
chrome://tracing. docs/papers/radiosity.md explains all of it.";

/// Solve for diffuse light in a scene: patches, form factors, iterations as fragment programs
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A Wavefront OBJ or PLY file, a scene file (.toml), or a scene of the project: see `crossbar scene`
    #[arg(value_name = "SCENE")]
    scene: PathBuf,

    /// Cut faces into at most so many patches in all
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..=16384))]
    patches: u32,

    /// Cut each side of each face into so many parts instead
    #[arg(long, value_name = "N", conflicts_with = "patches", value_parser = clap::value_parser!(u32).range(1..=1024))]
    per_side: Option<u32>,

    /// Where form factors come from
    #[arg(long, value_enum, value_name = "HOW", default_value = "rays")]
    factors: FactorsArg,

    /// For rays: strata along a side of a patch, so the square of it in rays a pair
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=64))]
    strata: u32,

    /// For hemicubes: pixels along a side of the top face, an even number
    #[arg(long, value_name = "N", default_value_t = 64)]
    hemicube: u32,

    /// Which random numbers
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,

    /// End with an error unless all form factors of a patch sum to 1 within this
    #[arg(long, value_name = "X", value_parser = number::not_negative)]
    require_closed: Option<f64>,

    /// Make form factors obey what form factors obey; `closure` makes them reciprocal too
    #[arg(long, value_enum, value_name = "LAW")]
    enforce: Option<Law>,

    /// card, jacobi, gauss-seidel, sor:FACTOR, shooting or direct; may be repeated [default: card, gauss-seidel and direct]
    #[arg(long, value_name = "S")]
    solver: Vec<ask::SolverArg>,

    /// For the card: one texel an element and three channels at once, or four elements a texel and a channel at a time; may be
    /// repeated [default: rgb]
    #[arg(long, value_enum, value_name = "P")]
    packing: Vec<ask::PackingArg>,

    /// For the card: what registers, textures and targets hold; may be repeated [default: fp32]
    #[arg(long, value_enum, value_name = "F")]
    storage: Vec<ask::StorageArg>,

    /// The card
    #[arg(long, value_name = "D", default_value = "nv35")]
    device: String,

    /// A switch of the device; may be given several times
    #[arg(long, value_name = "NAME=VALUE", value_parser = super::switch::parse)]
    switch: Vec<(String, String)>,

    /// Which executor computes; the bits are the same
    #[arg(long, value_enum, default_value = "batch")]
    executor: DeviceExecutor,

    #[command(flatten)]
    gpu: GpuArgs,

    /// Stop when the residual's length is this share of the emittance's [default: 1e-4; 0 with --iterations]
    #[arg(long, value_name = "X", value_parser = number::not_negative)]
    tolerance: Option<f64>,

    /// The most iterations [default: 1000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    iterations: Option<u32>,

    /// After the first solution, the radiance of a material; may be repeated
    #[arg(long, value_name = "MATERIAL=R,G,B", value_parser = ask::light_of)]
    emit: Vec<ask::Colour>,

    /// After the first solution, the reflectance of a material; may be repeated
    #[arg(long, value_name = "MATERIAL=R,G,B", value_parser = ask::paint_of)]
    paint: Vec<ask::Colour>,

    /// Pictures of the first way on the card after so many iterations
    #[arg(long, value_name = "N,N", value_delimiter = ',', allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    frames: Vec<u32>,

    /// Solve the room in so many patches too, on the card as it is and with each of its open switches turned
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=16384))]
    sweep: Vec<u32>,

    /// Pixels of the pictures
    #[arg(long, value_name = "WxH", default_value = "256x256", allow_hyphen_values = true)]
    size: Size,

    /// A view of the scene, by its name [default: its first]
    #[arg(long, value_name = "NAME")]
    view: Option<String>,

    #[command(flatten)]
    eye: EyeArgs,

    /// What radiance is multiplied by in pictures; 1 is white [default: so that what does not shine is grey in the mean]
    #[arg(long, value_name = "X", value_parser = number::positive)]
    exposure: Option<f64>,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/radiosity")]
    out: PathBuf,
}

/// Where form factors come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum FactorsArg {
    /// As if nothing stood between any two patches: for convex rooms
    Unoccluded,
    /// Closed forms and contour integrals, times what sample rays find open
    Rays,
    /// Pictures of the scene from each patch, drawn by the emulated card
    Hemicube,
}

/// What form factors obey.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Law {
    /// Areas times form factors are the same from both sides
    Reciprocity,
    /// Form factors of a patch sum to 1
    Closure,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    let ways = ask::ways(args)?;
    let scene = scene_name::scene(&args.scene)?;
    require_memory(args, ways.len() as u64)?;
    let stand = Stand { size: args.size, view: args.view.as_deref(), eye: args.eye };
    let parameters = Parameters {
        camera: stand.camera(&scene)?,
        subdivision: ask::subdivision(args),
        factors: ask::wishes(args),
        ways,
        profile: super::switch::device(&args.device, &args.switch)?,
        executor: args.executor.open(&args.gpu)?,
        options: Options {
            tolerance: args.tolerance.unwrap_or(if args.iterations.is_some() { 0.0 } else { 1e-4 }),
            most_iterations: args.iterations.unwrap_or(1000),
        },
        changes: ask::changes(args),
        exposure: args.exposure,
        frames: args.frames.clone(),
        sweep: args.sweep.clone(),
        scene,
    };
    // Before the long work, so that a folder that cannot be written is found out at once.
    let folder = FileSet::new(&args.out).map_err(Problem::from)?;
    let bar = Progress::new("radiosity", 1);
    let outcome = run_study(&parameters, &mut |what, done, of| bar.show(what.to_owned(), done, of))?;
    drop(bar);
    let provenance = provenance(args, &parameters);
    view::write_folder(folder, &files(&parameters, &outcome, &provenance)?)?;
    let found = tables(&parameters, &outcome);
    if out.json() {
        let mut document = found.json();
        document["provenance"] = serde_json::json!(provenance);
        document["out"] = serde_json::json!(args.out);
        out.document(&document)?;
        return Ok(Verdict::Done);
    }
    for table in found.all() {
        out.line(table.title())?;
        out.line(out.columns().map_or_else(|| table.text(), |columns| table.text_within(columns)))?;
        out.line("")?;
    }
    out.line(format_args!("pictures and tables: {}", args.out.join("index.html").display()))?;
    Ok(Verdict::Done)
}

/// What the matrices of so many patches take, and the pictures of every way.
fn require_memory(args: &Args, ways: u64) -> Result<(), Problem> {
    const PER_PAIR: u64 = 64;
    const PER_PIXEL_AND_WAY: u64 = 100;
    // How many patches the parts of sides make is known only when they are cut: the matrices have a limit of their own.
    let patches = args.per_side.map_or(u64::from(args.patches), |_| 0);
    let pictures = ways + args.frames.len() as u64;
    let need = memory::of_pixels(
        args.size.width,
        args.size.height,
        pictures * PER_PIXEL_AND_WAY,
        patches * patches * PER_PAIR,
    );
    let what = format_args!("radiosity of {patches} patches with {pictures} pictures of {} pixels", args.size);
    memory::require(what, need, "ask for fewer `--patches` or a smaller `--size`")
}

fn provenance(args: &Args, parameters: &Parameters) -> Provenance {
    let mut command = format!("crossbar radiosity {}", args.scene.display());
    command.push_str(&match args.per_side {
        Some(n) => format!(" --per-side {n}"),
        None => format!(" --patches {}", args.patches),
    });
    command.push_str(&ask::spelled(args));
    let mut provenance = Provenance::new(command);
    provenance.seed = (args.factors == FactorsArg::Rays).then_some(args.seed);
    provenance.profiles.push(parameters.profile.name.clone());
    provenance.switches.clone_from(&args.switch);
    provenance
}
