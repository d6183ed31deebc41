//! Options of a model's picture: light, model, camera, size, exposure; and the card that draws it.

use std::path::{Path, PathBuf};

use refsim::texture::TexelFormat;

use super::light::{DEFAULT_LIGHT, DistantLightArg, LIGHT};
use crate::cli::card::CardArgs;
use crate::cli::model_name;
use crate::cli::scene_name::EyeArgs;
use crate::geom::Mesh;
use crate::options::Size;
use crate::options::number;
use crate::study::prt::{CardSetting, LitView};

/// The transfer of a picture, and the transfer to compare it with.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct TransferFiles {
    /// A file that `precompute` or `compress` wrote; if it holds compressed transfer, this is drawn
    #[arg(value_name = "FILE.npz")]
    pub(in crate::cli) file: PathBuf,

    /// The file that was compressed, to measure the error of the compression
    #[arg(long, value_name = "X.npz")]
    pub(in crate::cli) original: Option<PathBuf>,
}

impl TransferFiles {
    pub(in crate::cli) fn paths(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.file].into_iter().chain(&self.original)
    }
}

/// A picture of a model.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct PictureArgs {
    #[arg(long, value_name = "LIGHT", default_value = DEFAULT_LIGHT, allow_hyphen_values = true, help = LIGHT)]
    pub(in crate::cli) light: DistantLightArg,

    /// The model from which the file was made, as given to `precompute`
    #[arg(long, value_name = "MODEL")]
    pub(in crate::cli) model: PathBuf,

    /// Size of the pictures, in pixels
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true)]
    size: Size,

    #[command(flatten)]
    eye: EyeArgs,

    /// Exposure: radiance is multiplied by this factor; in pictures, 1 is white [default: automatic, so that the mean
    /// of the model is 18 % grey]
    #[arg(long, value_name = "X", value_parser = number::positive)]
    exposure: Option<f64>,
}

impl PictureArgs {
    /// The input files of a picture: these, and the files of light and model.
    pub(in crate::cli) fn inputs<'a, P: AsRef<Path> + ?Sized + 'a>(
        &'a self,
        files: impl IntoIterator<Item = &'a P>,
    ) -> Vec<&'a Path> {
        let files = files.into_iter().map(P::as_ref);
        files.chain(self.light.file()).chain(model_name::named_file(&self.model)).collect()
    }

    pub(in crate::cli) fn view(&self, mesh: &Mesh) -> miette::Result<LitView> {
        let (model, light) = (self.model.display().to_string(), self.light.name());
        Ok(LitView { model, light, camera: self.eye.framing(mesh, self.size)?, exposure: self.exposure })
    }
}

/// The card, and the option to vary its settings.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct OnCardArgs {
    /// Vary number formats, maps and targets, one at a time, and show the error of each change
    #[arg(long)]
    sweep: bool,

    #[command(flatten)]
    card: CardArgs,
}

impl OnCardArgs {
    /// The card that draws: the requested one, otherwise `device`.
    pub(in crate::cli) fn setting(&self, device: &str) -> miette::Result<CardSetting> {
        let Self { sweep, card } = self;
        let (profile, executor) = (card.profile(device)?, card.executor()?);
        let format = TexelFormat::Bgra8;
        Ok(CardSetting { profile, switches: card.switches(), executor, format, sweep: *sweep })
    }
}
