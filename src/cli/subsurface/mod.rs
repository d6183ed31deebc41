//! `crossbar subsurface`: links over an atlas, three passes on a card, compared with all pairs.

mod light;

use std::path::PathBuf;

use super::card::CardArgs;
use super::materials::published;
use super::scene_name::EyeArgs;
use super::study::{StudyArgs, StudyFiles};
use super::{Problem, given, model_name};
use crate::atlas::require_side;
use crate::options::{Size, number};
use crate::study::caster::CasterOptions;
use crate::study::subsurface::{Lighting, Parameters, SubsurfaceOptions, no_atlas};
use crate::subsurface::{Coefficients, Material};
use light::{LightArg, coefficient, lighting};

const EXAMPLES: &str = "\
Examples:
  crossbar subsurface stand-in-head --material marble --mm-per-unit 10 --all-pairs yes
      a stand-in for the paper's head with 16 fixed links per texel, compared with all pairs of texels, as one page
  crossbar subsurface stand-in-head --material skin1 --mm-per-unit 10 --choice fixed --choice adaptive --links 4,16,64 --channels rgb --all-pairs yes
      both choices of links, and how the error falls with the number of links
  crossbar subsurface stand-in-head --sigma-s 2.21 --sigma-a 0.0012 --eta 1.3 --mm-per-unit 20 --map 8bit --map fp16 --map fp32 --link-format fp16 --link-format fp32
      the coefficients of the paper's Figure 7, with every format of the map and of the links
  crossbar subsurface stand-in-head --material marble --mm-per-unit 10 --light point:0,-3,1:40,36,30 --light ambient:0.1,0.1,0.2
      a lamp, and ambient light as a sky
  crossbar subsurface stand-in-head --material marble --eta 1.3 --mm-per-unit 10 --light disk:1,-1,2:20
      an environment map with shadows, and marble with another index of refraction

Written to --out: index.html (self-contained), rows.csv, faces.csv and vertices.csv (E and B of every face, and of \
every vertex of the model, for every variant), study.json, angles.csv (errors by angle from the light; only with all \
pairs and a directional light), timeline.json (a trace for https://ui.perfetto.dev or chrome://tracing), whole.exr, \
pictures. docs/papers/subsurface.md explains these files.";

/// The default index of refraction for coefficients given on the command line.
const ETA: f64 = 1.3;

/// Subsurface scattering (Carr, Hall, Hart 2003) on an emulated card, compared with brute force
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A Wavefront OBJ, PLY, STL or glTF file, a scene file (.toml), a built-in scene, or a stand-in for a model
    /// of the paper: stanford-bunny, stand-in-dolphin, stand-in-head
    #[arg(value_name = "MODEL")]
    model: PathBuf,

    /// A published medium: see `crossbar materials`
    #[arg(long, value_name = "NAME", conflicts_with_all = ["sigma_s", "sigma_a"])]
    material: Option<String>,

    /// Reduced scattering coefficient per mm, for all channels or as R,G,B
    #[arg(long, value_name = "S", value_parser = coefficient, requires = "sigma_a", allow_hyphen_values = true)]
    sigma_s: Option<[f64; 3]>,

    /// Absorption coefficient per mm, for all channels or as R,G,B
    #[arg(long, value_name = "A", value_parser = coefficient, requires = "sigma_s", allow_hyphen_values = true)]
    sigma_a: Option<[f64; 3]>,

    /// Index of refraction, 1 to 3 [default: the published index; 1.3 with --sigma-s and --sigma-a]
    #[arg(long, value_name = "N", value_parser = number::finite)]
    eta: Option<f64>,

    #[command(flatten)]
    options: SubsurfaceOptions,

    /// ambient:R,G,B, directional:X,Y,Z:R,G,B or point:X,Y,Z:R,G,B[:K0,K1,K2]; may be repeated. Or one environment map,
    /// with shadows: a lat-long, angular-probe, cube-cross or cube-strip picture, a table of a cube's texels (.csv) or
    /// of small sources (.sources.csv), disk:X,Y,Z:DEGREES[:R,G,B], constant[:R,G,B], sky:X,Y,Z (towards the sun),
    /// red-and-blue or scene:SCENE@X,Y,Z (as seen from a place in a scene) [default: a white light above and beside the
    /// camera]
    #[arg(long, value_name = "LIGHT", allow_hyphen_values = true)]
    light: Vec<LightArg>,

    #[command(flatten)]
    card: CardArgs,

    /// Size of the pictures, in pixels
    #[arg(long, value_name = "WxH", default_value = "256x256", allow_hyphen_values = true)]
    size: Size,

    #[command(flatten)]
    eye: EyeArgs,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/subsurface")]
    out: PathBuf,

    #[command(flatten)]
    caster: CasterOptions,
}

impl StudyArgs for Args {
    type Study = Parameters;
    const QUICKER: &'static str = "a smaller `--atlas`, fewer `--links`, or `--all-pairs no`";

    fn files(&self) -> StudyFiles<'_> {
        let lights = self.light.iter().filter_map(|light| match light {
            LightArg::Environment(light) => light.file(),
            LightArg::OfPass(_) => None,
        });
        let inputs = model_name::named_file(&self.model).into_iter().chain(lights).collect();
        StudyFiles::new(Some(&self.out), inputs)
    }

    fn study(&self) -> miette::Result<Parameters> {
        self.options.check()?;
        require_side(self.options.side).map_err(no_atlas)?;
        let material = self.material()?;
        let ways = self.options.ways(&material)?;
        let profile = self.card.profile("nv35")?;
        let mesh = model_name::mesh(&self.model)?;
        let camera = self.eye.framing(&mesh, self.size)?;
        let lighting = lighting(&self.light, &camera)?;
        let idle = self.caster.is_named() && matches!(lighting, Lighting::Lights(_));
        given::refuse(
            [("--caster", idle)],
            "shadows of an environment map",
            "remove `--caster`, or give an environment map with `--light`",
        )?;
        Ok(Parameters {
            model: self.model.display().to_string(),
            caster: self.caster.choose(self.card.executor()?)?,
            lighting,
            switches: self.card.switches(),
            executor: self.card.executor()?,
            options: self.options.clone(),
            material,
            ways,
            profile,
            mesh,
            camera,
        })
    }
}

impl Args {
    /// A published medium, or the given coefficients.
    fn material(&self) -> miette::Result<Material> {
        match (&self.material, self.sigma_s, self.sigma_a) {
            (Some(name), ..) => {
                let published = published(name)?.material();
                let Some(eta) = self.eta else { return Ok(published) };
                Ok(Material::new(format!("{}, eta {eta}", published.name), published.channels, eta)?)
            }
            (None, Some(s), Some(a)) => {
                let channel = |c: usize| Coefficients { sigma_s_prime: s[c], sigma_a: a[c] };
                Ok(Material::new("the coefficients given", [0, 1, 2].map(channel), self.eta.unwrap_or(ETA))?)
            }
            _ => {
                let help = "add `--material NAME` (see `crossbar materials`), or `--sigma-s` and `--sigma-a` per mm";
                Err(Problem::usage("expected a medium, found none", help).into())
            }
        }
    }
}
