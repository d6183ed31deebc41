//! The arguments of `crossbar radiosity`.

use std::path::PathBuf;

use clap::ValueEnum;

use super::values::{MaterialColor, SolverArg, light_of, paint_of};
use crate::atlas::MAX_SIDE;
use crate::cli::card::CardArgs;
use crate::cli::number;
use crate::cli::one_of::variants;
use crate::cli::part::PartArgs;
use crate::cli::scene_name::EyeArgs;
use crate::cli::size::Size;
use crate::radiosity::on_card::Storage;
use crate::radiosity::packing::Packing;

const EXAMPLES: &str = "\
Examples:
  crossbar radiosity cornell-room
      the paper's scene on an emulated GeForce FX 5900 Ultra, Gauss-Seidel and the direct solution beside it, as one page
  crossbar radiosity cornell-room-blocks --packing rgb --packing luminance --storage fp32 --storage fp16 --frames 1,2,4,8
      both packings in both precisions, and how the room looks after some iterations
  crossbar radiosity cornell-room --emit light=4,12,17 --paint red=0.1,0.1,0.6
      solve, then change the light and the left wall, and go on from the solution
  crossbar radiosity docs/examples/room.obj --patches 2000 --solver gauss-seidel --solver sor:1.15 --solver shooting --solver direct
      a scene of your own, on the host alone
  crossbar radiosity cornell-room-blocks --solver gauss-seidel --patches 500 --atlas 256
      the solution as a texture of a meshed atlas, and the room drawn from it
  crossbar radiosity cornell-room --solver card --storage fp16 --switch rounding=rtz --sweep 60,240,515,889
      half floats on a card that truncates, and how dark the room gets with more patches and under every open switch

Written to --out: index.html (self-contained), rows.csv, patches.csv and vertices.csv (radiosities per patch, and \
between patches per vertex), study.json, residual.svg, with --sweep \
sweep.csv and sweep.svg, pictures of every method \
(NAME-flat.png, NAME-smooth.png; on a card, beside direct, NAME-error.png) and of --frames, with --atlas atlas.csv, \
atlas.png and atlas-view.png; with a method on a card timeline.json, a trace for https://ui.perfetto.dev or \
chrome://tracing. docs/papers/radiosity.md explains all of it.";

/// Solve for diffuse light in a scene: patches, form factors, iterations as fragment programs
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(in crate::cli) struct Args {
    /// A Wavefront OBJ, PLY, STL or glTF file, a scene file (.toml), or a scene of the project: see `crossbar scene`
    #[arg(value_name = "SCENE")]
    pub(super) scene: PathBuf,

    /// Cut faces into at most so many patches in all
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..=16384))]
    pub(super) patches: u32,

    /// Cut each side of each face into so many parts instead
    #[arg(long, value_name = "N", conflicts_with = "patches", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(super) per_side: Option<u32>,

    /// Where form factors come from
    #[arg(long, value_enum, value_name = "HOW", default_value = "rays")]
    pub(super) factors: FactorsArg,

    /// For rays: strata along a side of a patch; their square is the number of rays per pair [default: 3]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub(super) strata: Option<u32>,

    /// For hemicubes: pixels along a side of the top face, an even number [default: 64]
    #[arg(long, value_name = "N")]
    pub(super) hemicube: Option<u32>,

    /// For rays: random seed [default: 1]
    #[arg(long, value_name = "N")]
    pub(super) seed: Option<u64>,

    /// End with an error unless all form factors of a patch sum to 1 within this
    #[arg(long, value_name = "X", value_parser = number::not_negative)]
    pub(super) require_closed: Option<f64>,

    /// Enforce reciprocity or closure of form factors; `closure` enforces both
    #[arg(long, value_enum, value_name = "LAW")]
    pub(super) enforce: Option<Law>,

    /// card, jacobi, gauss-seidel, sor:FACTOR, shooting or direct; may be repeated [default: card, gauss-seidel and
    /// direct]
    #[arg(long, value_name = "S")]
    pub(super) solver: Vec<SolverArg>,

    /// For the card: one element per texel and all channels at once, or four elements per texel and one channel at a
    /// time; may be repeated [default: rgb]
    #[arg(long, value_name = "P", value_parser = variants::<Packing>())]
    pub(super) packing: Vec<Packing>,

    /// For the card: what registers, textures and targets hold; may be repeated [default: fp32]
    #[arg(long, value_name = "F", value_parser = variants::<Storage>())]
    pub(super) storage: Vec<Storage>,

    #[command(flatten)]
    pub(super) card: CardArgs,

    /// Stop when the norm of the residual is at most this fraction of the emittance's [default: 1e-4; 0 with
    /// --iterations]
    #[arg(long, value_name = "X", value_parser = number::not_negative)]
    pub(super) tolerance: Option<f64>,

    /// The most iterations [default: 1000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(super) iterations: Option<u32>,

    /// After the first solution, the radiance of a material; may be repeated
    #[arg(long, value_name = "MATERIAL=R,G,B", value_parser = light_of)]
    pub(super) emit: Vec<MaterialColor>,

    /// After the first solution, the reflectance of a material; may be repeated
    #[arg(long, value_name = "MATERIAL=R,G,B", value_parser = paint_of)]
    pub(super) paint: Vec<MaterialColor>,

    /// Pictures of the first way on the card after so many iterations
    #[arg(long, value_name = "N,N", value_delimiter = ',', allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(super) frames: Vec<u32>,

    /// Resample a solution (the direct one, or the first) into a meshed atlas of so many texels along a side, a power
    /// of two, and draw the room from it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=MAX_SIDE as i64))]
    pub(super) atlas: Option<u32>,

    /// Solve the room in so many patches too, on the card as it is and with each of its open switches turned
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=16384))]
    pub(super) sweep: Vec<u32>,

    /// Pixels of the pictures
    #[arg(long, value_name = "WxH", default_value = "256x256", allow_hyphen_values = true)]
    pub(super) size: Size,

    /// A view of the scene, by its name [default: its first]
    #[arg(long, value_name = "NAME")]
    pub(super) view: Option<String>,

    #[command(flatten)]
    pub(super) eye: EyeArgs,

    /// Factor of radiance in pictures; 1 is white [default: auto-exposure, surfaces that
    /// do not emit at 18 % grey on average]
    #[arg(long, value_name = "X", value_parser = number::positive)]
    pub(super) exposure: Option<f64>,

    #[command(flatten)]
    pub(super) part: PartArgs,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/radiosity")]
    pub(super) out: PathBuf,
}

/// Where form factors come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum FactorsArg {
    /// As if nothing stood between any two patches: for convex rooms
    Unoccluded,
    /// Closed forms and contour integrals, times what sample rays find open
    Rays,
    /// Pictures of the scene from each patch, drawn by the emulated card
    Hemicube,
}

/// Law that form factors must obey.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Law {
    /// Area times form factor is the same from both sides
    Reciprocity,
    /// Form factors of a patch sum to 1
    Closure,
}
