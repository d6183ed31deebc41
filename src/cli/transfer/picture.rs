//! The picture of a model: which one, from where, how large, how bright.

use std::path::{Path, PathBuf};

use crate::cli::memory::{self, MemoryNeed};
use crate::cli::model_name;
use crate::cli::scene_name::EyeArgs;
use crate::cli::transfer::vertex_names::VertexNames;
use crate::geom::Mesh;
use crate::options::Size;
use crate::options::number;
use crate::options::one_of::variants;
use crate::study::prt::{LitView, TurnedFrames, ValuesFormat, VertexValues};
use crate::transfer::Vertices;

/// A picture of a model.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct PictureArgs {
    /// The model that the file was made from, as it was given to `precompute`
    #[arg(long, value_name = "MODEL")]
    pub(in crate::cli) model: PathBuf,

    /// Pixels of the pictures
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true)]
    size: Size,

    #[command(flatten)]
    eye: EyeArgs,

    /// Factor of radiance in pictures; 1 is white [default: auto-exposure, the model at 18 % grey on
    /// average]
    #[arg(long, value_name = "X", value_parser = number::positive)]
    exposure: Option<f64>,
}

impl PictureArgs {
    /// The model's file, unless the program builds it.
    pub(in crate::cli) fn inputs(&self) -> Vec<&Path> {
        model_name::named_file(&self.model)
    }

    /// The view of the model under a light of this name.
    pub(in crate::cli) fn view(&self, mesh: &Mesh, light: String) -> miette::Result<LitView> {
        let camera = self.eye.framing(mesh, self.size)?;
        Ok(LitView { model: self.model.display().to_string(), light, camera, exposure: self.exposure })
    }

    /// Memory of the picture and of frames.
    pub(in crate::cli) fn memory(&self, frames: TurnedFrames) -> MemoryNeed {
        const PER_PIXEL: u64 = 320;
        const PER_PIXEL_AND_FRAME: u64 = 16;
        let per_pixel = PER_PIXEL + PER_PIXEL_AND_FRAME * u64::from(frames.count);
        MemoryNeed {
            what: format!("{} pictures of {} pixels", 1 + frames.count, self.size),
            bytes: memory::of_pixels(self.size.width, self.size.height, per_pixel, 0),
            help: "ask for a smaller `--size` or fewer `--frames`",
        }
    }

    /// Memory of pictures on an emulated card.
    pub(in crate::cli) fn memory_on_card(&self) -> MemoryNeed {
        const PER_PIXEL: u64 = 400;
        MemoryNeed {
            what: format!("pictures of {} pixels", self.size),
            bytes: memory::of_pixels(self.size.width, self.size.height, PER_PIXEL, 0),
            help: "ask for a smaller `--size`",
        }
    }
}

/// Radiance of vertices as numbers.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct ValuesArgs {
    /// Write the radiance of each vertex towards the camera to --out as numbers, hidden or not
    #[arg(long, value_name = "FORMAT", value_parser = variants::<ValuesFormat>())]
    values: Option<ValuesFormat>,
}

impl ValuesArgs {
    /// The format and the names of a model's vertices, if their radiance is to be written.
    pub(in crate::cli) fn of(&self, model: &Path, vertices: &Vertices) -> Option<VertexValues> {
        Some(VertexValues { format: self.values?, numbers: VertexNames::new(model, vertices).numbers() })
    }
}
