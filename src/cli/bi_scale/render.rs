//! `crossbar bi-scale render`: pictures of a model from its transfer and bidirectional textures.

use std::path::PathBuf;

use super::texture_args::TextureArgs;
use super::textures::TransferOfModel;
use crate::cli::Problem;
use crate::cli::study::{StudyArgs, StudyFiles};
use crate::cli::transfer::light::{CUBE_LIGHT, DEFAULT_LIGHT, DistantLightArg};
use crate::cli::transfer::picture::PictureArgs;
use crate::study::prt::{BiScaleRendering, TexturedSurface};

const EXAMPLES: &str = "\
Examples:
  crossbar bi-scale render docs/examples/court_biclusters.npz --model docs/examples/court.obj --texture floor=tiles --texture bricks --repeat 4 --texture-size 8 --texture-views 4 --size 64x48
      textures by material, under a clear sky with a sun
  crossbar bi-scale render docs/examples/court_biclusters.npz --model docs/examples/court.obj --texture tiles --repeat 4 --texture-size 8 --texture-views 4 --reference --size 8x6
      compared with a ray-traced picture, with the error by cause: takes milliseconds per pixel

Written to --out: index.html (self-contained), pictures, picture.exr. Local light is interpolated over triangles, on the host.";

/// Draw a model under distant light from its transfer and bidirectional textures
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A matrix or its biclusters, as `crossbar bi-scale precompute` or `bicluster` wrote them
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,

    #[command(flatten)]
    textures: TextureArgs,

    /// Also ray-trace the picture, and split the error by cause; takes milliseconds per pixel. All textures
    /// must be patches
    #[arg(long)]
    reference: bool,

    #[arg(long, value_name = "LIGHT", default_value = DEFAULT_LIGHT, allow_hyphen_values = true, help = CUBE_LIGHT)]
    light: DistantLightArg,

    #[command(flatten)]
    picture: PictureArgs,

    /// Where to write pictures and the page
    #[arg(long, value_name = "DIR", default_value = "out/bi-scale")]
    out: PathBuf,
}

impl StudyArgs for Args {
    type Study = BiScaleRendering;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(Some(&self.out), self.textures.inputs(&self.file, &self.picture, &self.light))
    }

    fn study(&self) -> miette::Result<BiScaleRendering> {
        let (textures, name) = (&self.textures, &self.picture.model);
        let (TransferOfModel { file, model, vertices, light }, texture_of) = textures.transfer(&self.file, name)?;
        let surface = TexturedSurface::new(model.mesh.clone(), vertices, texture_of, textures.patches.repeat);
        let surface = surface.map_err(|error| {
            Problem::usage(format!("{}: {error}", name.display()), "name a model with texture coordinates (`vt`)")
        })?;
        Ok(BiScaleRendering {
            view: self.picture.view(&model.mesh, self.light.name())?,
            textures: textures.textures(&light)?,
            surface,
            file,
            light: self.light.distant()?,
            reference: self.reference,
        })
    }
}
