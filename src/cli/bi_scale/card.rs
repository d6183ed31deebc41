//! `crossbar bi-scale card`: biclusters and bidirectional textures on an emulated card.

use std::path::PathBuf;

use super::texture_args::TextureArgs;
use super::textures::TransferOfModel;
use crate::bi_scale::on_card::{DisplayOptions, LightFormat, corner_coordinates};
use crate::cli::Problem;
use crate::cli::study::{StudyArgs, StudyFiles};
use crate::cli::transfer::light::{CUBE_LIGHT, DEFAULT_LIGHT, DistantLightArg};
use crate::cli::transfer::on_card::OnCardArgs;
use crate::cli::transfer::picture::PictureArgs;
use crate::study::prt::BiScaleOnCard;

const EXAMPLES: &str = "\
Examples:
  crossbar bi-scale card docs/examples/court_biclusters.npz --model docs/examples/court.obj --texture tiles --texture-size 8 --texture-views 4 --repeat 4 --size 64x48
      on the GeForce GTX 280: light times biclusters, then a bidirectional texture pass by pass
  crossbar bi-scale card docs/examples/court_biclusters.npz --model docs/examples/court.obj --texture tiles --texture-size 8 --texture-views 4 --sweep --size 64x48
      the error of coarser light, local light, textures and targets, one at a time

Written to --out: index.html (self-contained), pictures, card.exr, timeline.json, blame.csv, with --sweep precision.csv. \
docs/papers/bi_scale.md explains all of it.";

/// Draw a model under distant light on an emulated card, from biclusters and bidirectional textures
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// Biclusters, as `crossbar bi-scale bicluster` writes them
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,

    #[command(flatten)]
    textures: TextureArgs,

    #[arg(long, value_name = "LIGHT", default_value = DEFAULT_LIGHT, allow_hyphen_values = true, help = CUBE_LIGHT)]
    light: DistantLightArg,

    #[command(flatten)]
    card: OnCardArgs,

    #[command(flatten)]
    picture: PictureArgs,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/bi-scale-card")]
    out: PathBuf,
}

impl StudyArgs for Args {
    type Study = BiScaleOnCard;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(Some(&self.out), self.textures.inputs(&self.file, &self.picture, &self.light))
    }

    fn study(&self) -> miette::Result<BiScaleOnCard> {
        let (textures, name) = (&self.textures, &self.picture.model);
        let (TransferOfModel { file, model, vertices, light: directions }, texture_of) =
            textures.transfer(&self.file, name)?;
        let Some(biclusters) = file.biclusters else {
            let what = format!("{}: expected biclusters, found a matrix only", self.file.display());
            return Err(Problem::usage(what, "`crossbar bi-scale bicluster` makes them").into());
        };
        let repeat = textures.patches.repeat as f32;
        let coordinates = corner_coordinates(&model.mesh, [repeat; 2]).map_err(|error| {
            Problem::usage(format!("{}: {error}", name.display()), "name a model with texture coordinates (`vt`)")
        })?;
        let card = self.card.setting("gt200")?;
        Ok(BiScaleOnCard {
            view: self.picture.view(&model.mesh, self.light.name())?,
            vertices,
            coordinates,
            biclusters,
            textures: textures.textures(&directions)?.into_iter().map(|texture| texture.samples).collect(),
            texture_of,
            light: self.light.distant()?,
            card,
            light_format: LightFormat::default(),
            options: DisplayOptions::default(),
        })
    }
}
