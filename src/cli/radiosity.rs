//! `crossbar radiosity`: matrix radiosity on a card and on the host, compared.

use std::path::PathBuf;

use super::card::CardArgs;
use super::given;
use super::scene_name::{self, EyeArgs, Viewpoint};
use super::study::{StudyArgs, StudyFiles};
use crate::options::Size;
use crate::study::caster::CasterOptions;
use crate::study::radiosity::{Factors, Parameters, RadiosityOptions, SolveMethod};

const EXAMPLES: &str = "\
Examples:
  crossbar radiosity cornell-room
      the paper's scene on an emulated GeForce FX 5900 Ultra, with Gauss-Seidel and the direct solution, as one page
  crossbar radiosity cornell-room-blocks --packing rgb --packing luminance --storage fp32 --storage fp16 --picture-after 1,2,4,8
      both packings in both precisions, and pictures of the room after some iterations
  crossbar radiosity docs/examples/room.obj --patches 2000 --solver gauss-seidel --solver sor:1.15 --solver shooting --solver direct
      your own scene, on the host alone
  crossbar radiosity cornell-room-blocks --patches 300 --solver direct --caster engine --caster-format s3.12 --caster-format fp16
      the light that leaks into the room if the Ray Engine casts the rays of the form factors in short number formats
  crossbar radiosity cornell-room --solver card --storage fp16 --switch rounding=rtz --sweep-patches 60,240,515,889
      half floats on a card that truncates: the error by number of patches, and under every open switch

Written to --out: index.html (self-contained), rows.csv, patches.csv (radiosity of every patch), vertices.csv \
(radiosity of every vertex of the smooth display), study.json, residual.svg, sweep.csv and sweep.svg (with \
--sweep-patches), pictures of every method (NAME-flat.png and NAME-smooth.png; NAME-error.png for a card if direct is \
computed, too) and of --picture-after, timeline.json (for a card; a trace for https://ui.perfetto.dev or \
chrome://tracing). docs/papers/radiosity.md explains these files.";

/// Compute diffuse light in a scene by radiosity: patches, form factors, iterations as fragment programs
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A Wavefront OBJ, PLY, STL or glTF file, a scene file (.toml), or a built-in scene: see `crossbar scene`
    #[arg(value_name = "SCENE")]
    scene: PathBuf,

    #[command(flatten)]
    options: RadiosityOptions,

    #[command(flatten)]
    card: CardArgs,

    /// Size of the pictures, in pixels
    #[arg(long, value_name = "WxH", default_value = "256x256", allow_hyphen_values = true)]
    size: Size,

    /// The name of a view of the scene [default: the first view]
    #[arg(long, value_name = "NAME")]
    view: Option<String>,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/radiosity")]
    out: PathBuf,

    #[command(flatten)]
    caster: CasterOptions,
}

impl StudyArgs for Args {
    type Study = Parameters;
    const QUICKER: &'static str = "fewer `--patches`";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(Some(&self.out), scene_name::named_file(&self.scene))
    }

    fn study(&self) -> miette::Result<Parameters> {
        let scene = scene_name::scene(&self.scene)?;
        let viewpoint = Viewpoint { size: self.size, view: self.view.as_deref(), eye: EyeArgs::default() };
        let (camera, methods) = (viewpoint.camera(&scene)?, self.options.methods()?);
        let is_on_card = methods.iter().any(|method| matches!(method, SolveMethod::Card(_)));
        if !is_on_card {
            given::refuse(self.card.given(), "methods on a card", "remove the option, or add `--solver card`")?;
            let executor = [("--executor", self.card.names_executor() && !self.caster.is_engine())];
            let help = "remove the option, or add `--solver card` or `--caster engine`";
            given::refuse(executor, "methods on a card and the Ray Engine", help)?;
        }
        let unoccluded = self.options.factors == Factors::Unoccluded;
        let idle = unoccluded && self.caster.is_named();
        given::refuse([("--caster", idle)], "form factors by rays", "remove `--caster`")?;
        Ok(Parameters {
            casters: self.caster.choose_each(self.card.executor()?)?,
            scene,
            methods,
            profile: self.card.profile("nv35")?,
            switches: self.card.switches(),
            executor: self.card.executor()?,
            camera,
            options: self.options.clone(),
        })
    }
}
