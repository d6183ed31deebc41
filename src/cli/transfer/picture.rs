//! Options of a model's picture: model, camera, size, exposure.

use std::path::{Path, PathBuf};

use crate::cli::model_name;
use crate::cli::scene_name::EyeArgs;
use crate::geom::Mesh;
use crate::options::Size;
use crate::options::number;
use crate::study::prt::LitView;

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

    /// Exposure: factor on radiance in pictures, where 1 is white [default: auto-exposure, the model at 18 % grey on
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
}
