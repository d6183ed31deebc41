//! The arguments of `crossbar render`.

use std::path::PathBuf;

use clap::ValueEnum;

use crate::cli::executor::Decider;
use crate::cli::scene_name::EyeArgs;
use crate::cli::{Problem, given};
use crate::options::Size;
use crate::options::number;
use crate::renderer::Lens;
use crate::study::caster::CasterOptions;

const EXAMPLES: &str = "\
Examples:
  crossbar render docs/examples/teapot.obj --out out/teapot
      picture.png (shaded), layers.exr (depth and triangle of each pixel), framed automatically, in exact arithmetic;
      index.html shows the picture and says how it was made
  crossbar render docs/examples/teapot.obj --device r200 --size 256x256 --eye 0,-10,4 --target 0,0,1 --out out/leaky
      the same on a Radeon 8500
  crossbar render teapot-room --renderer path --samples 64 --size 256x256 --out out/room
      a built-in scene by path tracing; layers.exr also has colour, normals and albedo
  crossbar render teapot-room --caster engine --caster-device r300
      Whitted's ray tracing; the Ray Engine on a Radeon 9700 finds the first hits";

/// Render a mesh or a scene: picture.png, and depth and triangle of each pixel
///
/// An OBJ, PLY, STL or glTF file is shaded by a lamp at the eye; exact arithmetic or a card finds the hits of the eye
/// rays. A built-in scene, a scene file, or any input with `--renderer` is drawn with its lights; the host's octree or
/// the Ray Engine finds the first hits.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(in crate::cli) struct Args {
    /// A Wavefront OBJ, PLY, STL or glTF file, a scene file (.toml), or a built-in scene: see `crossbar scene`
    #[arg(value_name = "SCENE")]
    pub(super) scene: PathBuf,

    /// Size of the picture, in pixels
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true)]
    pub(super) size: Size,

    #[command(flatten)]
    pub(super) eye: EyeArgs,

    /// The card for a mesh without `--renderer`, and for an environment map; not needed for `exact` arithmetic
    /// [default: ideal-fp32]
    #[arg(long, value_name = "D")]
    pub(super) device: Option<String>,

    /// Arithmetic that decides hits [default: batch if a device is named or with `--caster engine`, otherwise exact]
    #[arg(long, value_enum)]
    pub(super) executor: Option<Decider>,

    /// Folder for picture.png, layers.exr and index.html
    #[arg(long, value_name = "DIR", default_value = "out/render")]
    pub(super) out: PathBuf,

    // Last, because its heading also covers the options that follow it.
    #[command(flatten)]
    pub(super) light: LightArgs,

    #[command(flatten)]
    pub(super) caster: CasterOptions,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Renderer {
    /// Eye rays alone, with a lamp at the eye
    Eye,
    /// Point lights, hard shadows, mirrors, glass
    Whitted,
    /// Like whitted, but mirrors show a cube map of their surroundings, drawn by `--device`
    Environment,
    /// Soft shadows, gloss, depth of field; no light between diffuse surfaces
    Distributed,
    /// All light, by unbiased random walks
    Path,
    /// All light, by photon maps and final gather
    Photon,
}

impl Renderer {
    pub(super) const fn title(self) -> &'static str {
        match self {
            Self::Eye => "Eye rays with a lamp at the eye",
            Self::Whitted => "Ray tracing after Whitted",
            Self::Environment => "Ray tracing after Whitted with an environment map",
            Self::Distributed => "Distributed ray tracing",
            Self::Path => "Path tracing",
            Self::Photon => "Photon mapping",
        }
    }
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Light")]
pub(super) struct LightArgs {
    /// Rendering method [default: whitted for built-in scenes and scene files, otherwise eye]
    #[arg(long, value_enum, value_name = "R")]
    pub(super) renderer: Option<Renderer>,

    /// Samples per pixel [default: 1 for eye, environment and `--drawn-eyes`, 4 for whitted, otherwise 16]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(1..=1 << 20))]
    pub(super) samples: Option<u32>,

    /// Maximum number of surfaces on a path from lamp to eye; not for the renderers eye and environment [default: 8]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(0..=1024))]
    pub(super) depth: Option<u32>,

    /// Random seed [default: 1]
    #[arg(long, value_name = "N", value_parser = number::whole::<u64>(0..=u64::MAX))]
    pub(super) seed: Option<u64>,

    /// The name of a view of the scene [default: the first view]
    #[arg(long, value_name = "NAME")]
    pub(super) view: Option<String>,

    /// Exposure: radiance is multiplied by this factor; in picture.png, 1 is white [default: 1]
    #[arg(long, value_name = "X", value_parser = number::positive)]
    pub(super) exposure: Option<f64>,

    /// The lens of the camera: its radius, and the distance in focus
    #[arg(long, value_name = "RADIUS,FOCUS", value_parser = parse_lens, allow_hyphen_values = true)]
    pub(super) lens: Option<Lens>,

    /// Photons per map in photon mapping [default: 100000]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(0..=u32::MAX))]
    pub(super) photons: Option<u32>,

    /// Gather rays per hit in photon mapping; 0 shows the map itself [default: 16]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(0..=65536))]
    pub(super) gather: Option<u32>,

    /// The engine's card draws the front faces that the eye sees, and the engine casts all other rays
    #[arg(long)]
    pub(super) drawn_eyes: bool,
}

impl LightArgs {
    pub(super) fn asked(&self) -> bool {
        self.renderer.is_some() || self.samples.is_some() || self.view.is_some()
    }

    /// Rejects options that a renderer does not use; `None` stands for a mesh shaded without lights.
    pub(super) fn refuse_others(&self, renderer: Option<Renderer>) -> Result<(), Problem> {
        let is_photon = renderer == Some(Renderer::Photon);
        let of_photons = [("--photons", self.photons.is_some()), ("--gather", self.gather.is_some())];
        let of_photons = of_photons.map(|(option, given)| (option, given && !is_photon));
        given::refuse(of_photons, "photon mapping", "remove the option, or add `--renderer photon`")?;
        let is_mapped = renderer == Some(Renderer::Environment);
        let is_one = is_mapped || self.drawn_eyes;
        let jittered =
            [("--lens", self.lens.is_some()), ("--samples", self.samples.is_some_and(|samples| samples > 1))];
        let jittered = jittered.map(|(option, given)| (option, given && is_one));
        given::refuse(
            jittered,
            "rays that do not pass through pixel centers",
            "remove the option, or use a renderer other than `environment`, without `--drawn-eyes`",
        )?;
        let is_eye = renderer.is_none_or(|renderer| renderer == Renderer::Eye);
        let depth = [("--depth", self.depth.is_some() && (is_eye || is_mapped))];
        given::refuse(depth, "light that meets several surfaces", "remove `--depth`, or choose another `--renderer`")?;
        let of_light = [
            ("--seed", self.seed.is_some()),
            ("--exposure", self.exposure.is_some()),
            ("--lens", self.lens.is_some()),
            ("--drawn-eyes", self.drawn_eyes),
        ];
        let of_light = of_light.map(|(option, given)| (option, given && renderer.is_none()));
        given::refuse(of_light, "scenes with light", "remove the option, or add a `--renderer`")
    }
}

fn parse_lens(text: &str) -> Result<Lens, String> {
    let (radius, focus) =
        text.split_once(',').ok_or_else(|| format!("expected RADIUS,FOCUS as in 0.02,1.5; found `{text}`"))?;
    let radius = number::not_negative(radius).map_err(|what| format!("radius: {what}"))?;
    let focus = number::positive(focus).map_err(|what| format!("focus: {what}"))?;
    Ok(Lens { radius, focus })
}
