//! `crossbar all-frequency render` and `card`: pictures of a model from its transfer, on the host and on an emulated
//! card.

use std::path::{Path, PathBuf};

use clap::ValueEnum;

use crate::all_frequency::file::{AllFrequencyFile, load_all_frequency};
use crate::all_frequency::on_card::{ProductOptions, ProductPlace, VertexColors};
use crate::cli::Problem;
use crate::cli::study::{StudyArgs, StudyFiles};
use crate::cli::transfer::model::model_of;
use crate::cli::transfer::picture::{OnCardArgs, PictureArgs, TransferFiles};
use crate::options::number;
use crate::scene::{Material, Surface};
use crate::study::prt::{AllFrequencyOnCard, LitModel, LitPart};
use crate::transfer::file::MeshDigest;

/// Model, light and camera.
#[derive(Debug, clap::Args)]
struct LitArgs {
    #[command(flatten)]
    transfer: TransferFiles,

    /// Number of light coefficients to keep, in descending order of area times magnitude [default: all]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(1..=6144))]
    keep: Option<u32>,

    #[command(flatten)]
    picture: PictureArgs,

    /// A ground file that `crossbar all-frequency precompute --ground` wrote, compressed or not; it contains the path
    /// of the ground's model
    #[arg(long, value_name = "G.npz")]
    ground: Option<PathBuf>,
}

impl LitArgs {
    fn files<'a>(&'a self, out: &'a Path) -> StudyFiles<'a> {
        StudyFiles::new(Some(out), self.picture.inputs(self.transfer.paths().chain(&self.ground)))
    }

    fn load(&self) -> miette::Result<LitModel> {
        let TransferFiles { file, original } = &self.transfer;
        let (model, mesh) = part(load_all_frequency(file, None)?, file, &self.picture.model)?;
        let original = original.as_deref().map(|path| original_of(&model.file, &mesh, path)).transpose()?;
        Ok(LitModel {
            view: self.picture.view(&model.mesh)?,
            model,
            original,
            ground: self.ground.as_deref().map(ground).transpose()?,
            light: self.picture.light.distant()?,
            keep: self.keep.map(|keep| keep as usize),
        })
    }
}

/// A file with the model from which it was made.
fn part(file: AllFrequencyFile, path: &Path, model: &Path) -> miette::Result<(LitPart, MeshDigest)> {
    let (model, vertices, digest) = model_of(path, Some(file.mesh), model, None)?;
    // Factor of a surface's radiance: its albedo, or 1 if it has none.
    let color = |material: &Material| match &material.surface {
        Surface::Diffuse { albedo } | Surface::Glossy { albedo, .. } => albedo.map(f64::from),
        _ => [1.0; 3],
    };
    let colors = model.materials.iter().map(color).collect();
    Ok((LitPart { mesh: model.mesh, vertices, colors, file }, digest))
}

/// A file with visibility, for the same mesh and reflectance as another file.
fn original_of(file: &AllFrequencyFile, mesh: &MeshDigest, path: &Path) -> miette::Result<AllFrequencyFile> {
    let original = load_all_frequency(path, Some(mesh))?;
    if original.visibility.is_none() || original.reflectance != file.reflectance || original.hats != file.hats {
        let what = format!("{}: expected visibility with the same reflectance, found none", path.display());
        return Err(Problem::usage(what, "give the file from which the transfer was compressed").into());
    }
    Ok(original)
}

/// A ground, with the model that its file names.
fn ground(path: &Path) -> miette::Result<LitPart> {
    let file = load_all_frequency(path, None)?;
    let Some(model) = file.model.as_ref().map(|name| path.with_file_name(name)) else {
        let what = format!("{}: expected a ground file with the path of its model, found no path", path.display());
        let help =
            "give the ground file that `crossbar all-frequency precompute --ground` wrote, or its compressed form";
        return Err(Problem::usage(what, help).into());
    };
    Ok(part(file, path, &model)?.0)
}

const RENDER_EXAMPLES: &str = "\
Examples:
  crossbar all-frequency render docs/examples/step_all_small.npz --model docs/examples/step.obj --size 64x48
      under a clear sky with a sun: a picture and a page
  crossbar all-frequency render docs/examples/step_all_small.npz --model docs/examples/step.obj --original docs/examples/step_all.npz --keep 200 --size 64x48
      compared with the uncompressed transfer, with 200 coefficients of the light
  crossbar all-frequency render docs/examples/step_all.npz --model docs/examples/step.obj --light red-and-blue --size 64x48
      from uncompressed transfer, under a red and a blue light

Written to --out: index.html (self-contained), pictures, picture.exr. The host interpolates vertex radiance over \
triangles.";

/// Draw a model under distant light from its transfer, compressed or not
#[derive(Debug, clap::Args)]
#[command(after_help = RENDER_EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Render {
    #[command(flatten)]
    lit: LitArgs,

    /// Where to write pictures and the page
    #[arg(long, value_name = "DIR", default_value = "out/all-frequency")]
    out: PathBuf,
}

impl StudyArgs for Render {
    type Study = LitModel;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        self.lit.files(&self.out)
    }

    fn study(&self) -> miette::Result<LitModel> {
        self.lit.load()
    }
}

const CARD_EXAMPLES: &str = "\
Examples:
  crossbar all-frequency card docs/examples/step_all_small.npz --model docs/examples/step.obj --way colors --size 64x48
      on the Radeon 9800, with interpolated vertex colors, as in the paper
  crossbar all-frequency card docs/examples/step_all_small.npz --model docs/examples/step.obj --original docs/examples/step_all.npz --sweep --size 64x48
      the error by compression, and by fewer bits in representatives, weights, maps and arithmetic
  crossbar all-frequency card docs/examples/step_all_small.npz --model docs/examples/step.obj --ground docs/examples/step_all_small.ground.npz --size 64x48
      with a ground below the model, and the model's shadow on it

Written to --out: index.html (self-contained), pictures, card.exr, timeline.json, blame.csv, with --sweep precision.csv. \
docs/papers/all_frequency.md explains these files.";

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum WayArg {
    /// The card only interpolates vertex colors, which the host computes
    Colors,
    /// The card multiplies by the view factors, which it reads from textures at each pixel
    Products,
}

/// Draw a model under distant light on an emulated card, from coded transfer
#[derive(Debug, clap::Args)]
#[command(after_help = CARD_EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Card {
    #[command(flatten)]
    lit: LitArgs,

    /// The part of the work that the card does
    #[arg(long, value_enum, value_name = "WAY", default_value = "products")]
    way: WayArg,

    #[command(flatten)]
    card: OnCardArgs,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/all-frequency-card")]
    out: PathBuf,
}

impl StudyArgs for Card {
    type Study = AllFrequencyOnCard;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        self.lit.files(&self.out)
    }

    fn study(&self) -> miette::Result<AllFrequencyOnCard> {
        let card = self.card.setting("r350")?;
        let place = match self.way {
            WayArg::Colors => ProductPlace::Vertices(VertexColors::Bytes),
            WayArg::Products => ProductPlace::Pixels(ProductOptions::of(&card.profile)),
        };
        Ok(AllFrequencyOnCard { lit: self.lit.load()?, place, card })
    }
}
