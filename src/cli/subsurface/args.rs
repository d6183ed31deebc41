//! The arguments of `crossbar subsurface`.

use std::path::PathBuf;

use super::values::{LightArg, choices, coefficient, direct_light, maps, place, rgb, yes_or_no};
use crate::cli::card::CardArgs;
use crate::cli::number;
use crate::cli::one_of::variants;
use crate::cli::part::PartArgs;
use crate::cli::scene_name::EyeArgs;
use crate::cli::size::Size;
use crate::study::subsurface::{ALL_PAIRS_SIDE, MapBits};
use crate::subsurface::kernels::{Combine, DirectLight, EyeTransmittance, LinkLayout};
use crate::subsurface::on_card::{FloatTexels, LightStage};

const EXAMPLES: &str = "\
Examples:
  crossbar subsurface stand-in-head --material marble --mm-per-unit 10 --all-pairs yes
      a stand-in for the paper's head with 16 fixed links per texel, beside all pairs of texels, as one page
  crossbar subsurface stand-in-head --material skin1 --mm-per-unit 10 --choice fixed --choice adaptive --links 4,16,64 --channels rgb --all-pairs yes
      both choices of links, and how the error falls with their number
  crossbar subsurface stand-in-head --sigma-s 2.21 --sigma-a 0.0012 --eta 1.3 --mm-per-unit 20 --map 8bit --map fp16 --map fp32 --link-format fp16 --link-format fp32
      the coefficients of the paper's Figure 7, in every format of map and links
  crossbar subsurface stand-in-head --material marble --mm-per-unit 10 --light point:0,-3,1:40,36,30 --light sky:0.1,0.1,0.2 --frames 8
      a lamp and a sky, and the lamp carried round the model
  crossbar subsurface stand-in-head --material marble --eta 1.3 --mm-per-unit 10 --light disk:1,-1,2:20 --walk 20000
      an environment map with shadows, marble behind another boundary, and photons that walk beside the dipole
  crossbar subsurface stand-in-head --material skin1 --mm-per-unit 10 --choice adaptive --link-table --probe 0,-1,0
      where one texel gathers from: clusters, factors and distances

Written to --out: index.html (self-contained), rows.csv, faces.csv and vertices.csv (E and B of every face, and of every vertex of the model, in every \
way), study.json, with all pairs and a directional light angles.csv (errors by angle from the light), with --walk walk.csv, with --link-table links.csv, \
with --probe probes.csv, timeline.json (a trace for https://ui.perfetto.dev or chrome://tracing), whole.exr, pictures. docs/papers/subsurface.md explains all of it.";

/// Light below the surface of a model: links over an atlas, three passes on a card, all pairs beside them
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(in crate::cli) struct Args {
    /// A Wavefront OBJ, PLY, STL or glTF file, a scene file (.toml), a scene of the project, or a stand-in for a model
    /// of the paper: stand-in-bunny, stand-in-dolphin, stand-in-head
    #[arg(value_name = "MODEL")]
    pub(super) model: PathBuf,

    /// A published medium: see `crossbar materials`
    #[arg(long, value_name = "NAME", conflicts_with_all = ["sigma_s", "sigma_a"])]
    pub(super) material: Option<String>,

    /// Reduced scattering coefficient per mm, for all channels or as R,G,B
    #[arg(long, value_name = "S", value_parser = coefficient, requires = "sigma_a", allow_hyphen_values = true)]
    pub(super) sigma_s: Option<[f64; 3]>,

    /// Absorption coefficient per mm, for all channels or as R,G,B
    #[arg(long, value_name = "A", value_parser = coefficient, requires = "sigma_s", allow_hyphen_values = true)]
    pub(super) sigma_a: Option<[f64; 3]>,

    /// Index of refraction, 1 to 3 [default: the published one; 1.3 with --sigma-s and --sigma-a]
    #[arg(long, value_name = "N", value_parser = number::positive)]
    pub(super) eta: Option<f64>,

    /// Millimeters of a unit of the model; never guessed
    #[arg(long, value_name = "MM", value_parser = number::positive)]
    pub(super) mm_per_unit: f64,

    /// Texels along a side of the atlas: a power of two
    #[arg(long, value_name = "N", default_value_t = 128, value_parser = clap::value_parser!(u32).range(1..=8192))]
    pub(super) atlas: u32,

    /// Links per texel; for fixed ones 1, 4, 16, 64, ...
    #[arg(long, value_name = "L,L", value_delimiter = ',', default_value = "16", value_parser = clap::value_parser!(u32).range(1..=16384))]
    pub(super) links: Vec<u32>,

    /// Which links; may be repeated [default: fixed]
    #[arg(long, value_name = "HOW", value_parser = choices())]
    pub(super) choice: Vec<LinkLayout>,

    /// Factors per link; may be repeated [default: rgb, or scalar for a medium of one color]
    #[arg(long, value_name = "C", value_parser = rgb())]
    pub(super) channels: Vec<bool>,

    /// Format of link textures; may be repeated [default: fp16]
    #[arg(long, value_name = "F", value_parser = variants::<FloatTexels>())]
    pub(super) link_format: Vec<FloatTexels>,

    /// The radiosity map; may be repeated [default: fp16]
    #[arg(long, value_name = "F", value_parser = maps())]
    pub(super) map: Vec<MapBits>,

    /// Let pass 2 compute in half precision
    #[arg(long)]
    pub(super) half: bool,

    /// Largest relative error of factors, beside 1e-5 of the total; of the total between texels so long that less light
    /// leaves them
    #[arg(long, value_name = "X", default_value_t = crate::subsurface::factor::TOLERANCE, value_parser = number::positive)]
    pub(super) tolerance: f64,

    /// sky:R,G,B, directional:X,Y,Z:R,G,B or point:X,Y,Z:R,G,B[:K0,K1,K2]; may be repeated. Or one environment map,
    /// with shadows: a lat-long, angular-probe or cube-cross picture, a table of a cube's texels (.csv) or of small
    /// sources (.sources.csv), disk:X,Y,Z:DEGREES[:R,G,B], constant[:R,G,B] or red-and-blue [default: from beside the
    /// camera]
    #[arg(long, value_name = "LIGHT", allow_hyphen_values = true)]
    pub(super) light: Vec<LightArg>,

    /// In place of lights, what has entered each face: a table with the header r,g,b and a line per face
    #[arg(long, value_name = "FACES.csv", conflicts_with = "light")]
    pub(super) irradiance: Option<PathBuf>,

    /// Where pass 1 computes light [default: vertex]
    #[arg(long, value_name = "STAGE", value_parser = variants::<LightStage>())]
    pub(super) pass_1: Option<LightStage>,

    /// Where pass 3 computes direct light [default: fragment]
    #[arg(long, value_name = "STAGE", value_parser = direct_light())]
    pub(super) direct: Option<DirectLight>,

    /// The Fresnel transmittance towards the eye
    #[arg(long, value_name = "HOW", default_value = "exact", value_parser = variants::<EyeTransmittance>())]
    pub(super) fresnel: EyeTransmittance,

    /// How scattered and direct light make a color
    #[arg(long, value_name = "HOW", default_value = "added", value_parser = variants::<Combine>())]
    pub(super) combine: Combine,

    /// Diffuse reflectance for direct light, 0 to 1 [default: 0.1]
    #[arg(long, value_name = "X", value_parser = number::not_negative)]
    pub(super) diffuse: Option<f64>,

    /// A point of the surface at which B is asked for; may be repeated
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true)]
    pub(super) probe: Vec<[f64; 3]>,

    #[arg(long, value_name = "YES", value_parser = yes_or_no(), help = format!(
        "Gather over all pairs of texels too [default: yes for atlases up to {ALL_PAIRS_SIDE}]"
    ))]
    pub(super) all_pairs: Option<bool>,

    /// Follow so many photons per channel through the model as well: the dipole's own error
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(32..=1_000_000_000))]
    pub(super) walk: Option<u64>,

    /// List the links of the probes' texels, or of all texels without --probe: cluster, factor, distance
    #[arg(long)]
    pub(super) link_table: bool,

    /// Run every way with each value of the card's rounding switches too
    #[arg(long)]
    pub(super) roundings: bool,

    #[command(flatten)]
    pub(super) card: CardArgs,

    /// Pictures of the first way with the lights turned round the model in so many steps
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=360))]
    pub(super) frames: u32,

    /// Pixels of the pictures
    #[arg(long, value_name = "WxH", default_value = "256x256", allow_hyphen_values = true)]
    pub(super) size: Size,

    #[command(flatten)]
    pub(super) eye: EyeArgs,

    /// Factor of radiance in pictures; 1 is white [default: auto-exposure, the model at 18 % grey on
    /// average]
    #[arg(long, value_name = "X", value_parser = number::positive)]
    pub(super) exposure: Option<f64>,

    #[command(flatten)]
    pub(super) part: PartArgs,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/subsurface")]
    pub(super) out: PathBuf,
}
