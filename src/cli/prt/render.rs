//! `crossbar prt render`: pictures of a model from its transfer.

use std::path::{Path, PathBuf};

use clap::ValueEnum;

use super::bi_scale::render_args::BiScaleRenderArgs;
use super::light::LightArgs;
use super::model::{FileOfModel, light_order};
use super::values::KindArg;
use crate::cli::memory::{self, MemoryNeed};
use crate::cli::scene_name::EyeArgs;
use crate::cli::size::Size;
use crate::cli::study::StudyArgs;
use crate::cli::{Problem, model_name, number};
use crate::study::prt::{Rendering, Turning};
use crate::transfer::file::{PrtFile, load_prt};

const EXAMPLES: &str = "\
Examples:
  crossbar prt render docs/examples/step_small.prt --model docs/examples/step.obj --size 64x48
      under a clear sky with a sun: picture, clusters, a page
  crossbar prt render docs/examples/step_small.prt --model docs/examples/step.obj --original docs/examples/step.prt --light disk:1,0,2:20 --size 64x48
      beside the uncompressed transfer: differences, and the error of every vertex
  crossbar prt render docs/examples/step.prt --model docs/examples/step.obj --light red-and-blue --frames 8 --size 64x48
      uncompressed, the light turned around z in eight steps
  crossbar prt render docs/examples/step_all_small.prt --model docs/examples/step.obj --original docs/examples/step_all.prt --keep 200 --size 64x48
      transfer of all frequencies, with 200 coefficients of the light
  crossbar prt render docs/examples/court_biclusters.prt --model docs/examples/court.obj --texture floor=tiles --texture bricks --repeat 4 --texture-size 8 --texture-views 4 --size 64x48
      bi-scale transfer, with textures by material
  crossbar prt render docs/examples/court_biclusters.prt --model docs/examples/court.obj --texture tiles --repeat 4 --texture-size 8 --texture-views 4 --reference --size 8x6
      held against a picture by rays, the error told apart by causes: milliseconds per pixel

Written to --out: index.html (self-contained), pictures, picture.exr. Vertex radiance is interpolated over triangles, on the host.";

/// What frames turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum TurnArg {
    /// The light, around z
    Light,
    /// The camera, around the model
    Camera,
}

/// Draw a model under distant light from its transfer, compressed or not
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(in crate::cli) struct Args {
    /// Transfer or clusters; clusters are drawn where there are both
    #[arg(value_name = "FILE.prt")]
    file: PathBuf,

    /// The model that the file was made from, as given to `crossbar prt precompute`
    #[arg(long, value_name = "MODEL")]
    pub(super) model: PathBuf,

    /// What the file must hold [default: whatever it holds]
    #[arg(long, value_enum, value_name = "KIND")]
    pub(super) kind: Option<KindArg>,

    /// Uncompressed transfer of the same model, to compare with
    #[arg(long, value_name = "X.prt")]
    pub(super) original: Option<PathBuf>,

    /// The ground that `crossbar prt precompute --ground` wrote, compressed or not, for transfer of all frequencies
    #[arg(long, value_name = "G.prt")]
    pub(super) ground: Option<PathBuf>,

    /// Its model [default: G.obj]
    #[arg(long, value_name = "MODEL", requires = "ground")]
    pub(super) ground_model: Option<PathBuf>,

    #[command(flatten)]
    pub(super) bi_scale: BiScaleRenderArgs,

    #[command(flatten)]
    pub(super) light: LightArgs,

    /// Light coefficients that are kept, those of largest area times magnitude, for transfer of all frequencies
    /// [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=6144))]
    pub(super) keep: Option<u32>,

    /// Pictures with the light turned around z, or the camera carried around the model, in so many steps
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=360))]
    pub(super) frames: u32,

    /// What these turn
    #[arg(long, value_enum, value_name = "WHAT", default_value = "light")]
    turn: TurnArg,

    /// Pixels of the pictures
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true)]
    pub(super) size: Size,

    #[command(flatten)]
    pub(super) eye: EyeArgs,

    /// What radiance is multiplied by in pictures; 1 is white [default: auto-exposure, the model at 18 % grey on
    /// average]
    #[arg(long, value_name = "X", value_parser = number::positive)]
    pub(super) exposure: Option<f64>,

    /// Where to write pictures and the page
    #[arg(long, value_name = "DIR", default_value = "out/prt")]
    pub(super) out: PathBuf,
}

impl Args {
    /// The file to draw.
    pub(super) fn file(&self) -> &Path {
        &self.file
    }

    /// What frames turn.
    pub(super) fn turning(&self) -> Turning {
        if self.turn == TurnArg::Camera { Turning::Camera } else { Turning::Light }
    }

    /// Memory of the pictures.
    pub(super) fn pictures(&self) -> MemoryNeed {
        const PER_PIXEL: u64 = 320;
        const PER_PIXEL_AND_FRAME: u64 = 16;
        let per_pixel = PER_PIXEL + PER_PIXEL_AND_FRAME * u64::from(self.frames);
        MemoryNeed {
            what: format!("{} pictures of {} pixels", 1 + self.frames, self.size),
            bytes: memory::of_pixels(self.size.width, self.size.height, per_pixel, 0),
            help: "ask for a smaller `--size` or fewer `--frames`",
        }
    }
}

impl StudyArgs for Args {
    type Study = Rendering;
    const COMMAND: &'static str = "prt render";

    fn folder(&self) -> Option<&Path> {
        Some(&self.out)
    }

    fn inputs(&self) -> Vec<&Path> {
        let files = [
            Some(self.file.as_path()),
            self.original.as_deref(),
            self.ground.as_deref(),
            self.ground_model.as_deref(),
            self.light.file(),
        ];
        files.into_iter().flatten().chain(model_name::named_file(&self.model)).collect()
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        Ok(Some(self.pictures()))
    }

    fn study(&self) -> miette::Result<Rendering> {
        self.bi_scale.refuse()?;
        if self.ground.is_some() {
            let what = "`--ground` is for transfer of all frequencies, found low frequency";
            return Err(Problem::usage(what, "leave it out").into());
        }
        let FileOfModel { file, model, vertices, digest } = FileOfModel::load(&self.file, &self.model)?;
        let light_order = light_order(&file)?;
        let original = match &self.original {
            None => None,
            Some(path) => {
                let PrtFile { meaning, transfer, .. } = load_prt(path, Some(&digest))?;
                let fits = transfer.filter(|_| meaning == file.meaning);
                Some(fits.ok_or_else(|| {
                    let what =
                        format!("{}: expected uncompressed transfer of the same kind, found other", path.display());
                    Problem::usage(what, "name the file that was compressed")
                })?)
            }
        };
        Ok(Rendering {
            model: self.model.display().to_string(),
            camera: self.eye.framing(&model.mesh, self.size)?,
            light: match self.keep {
                None => self.light.of_order(light_order)?,
                Some(_) => {
                    let what = "`--keep` is for transfer of all frequencies, found harmonics";
                    return Err(Problem::usage(what, "leave it out").into());
                }
            },
            light_name: self.light.name(),
            exposure: self.exposure,
            frames: self.frames,
            turning: self.turning(),
            mesh: model.mesh,
            vertices,
            file,
            original,
        })
    }
}
