//! `crossbar cpca render`: pictures of a model from its transfer.

use std::path::PathBuf;

use super::file::{FileOfModel, light_order};
use crate::cli::Problem;
use crate::cli::study::{StudyArgs, StudyFiles};
use crate::cli::transfer::light::{DEFAULT_LIGHT, DistantLightArg, HARMONIC_LIGHT};
use crate::cli::transfer::picture::PictureArgs;
use crate::study::prt::Rendering;
use crate::transfer::file::{PrtFile, load_prt};

const EXAMPLES: &str = "\
Examples:
  crossbar cpca render docs/examples/step_small.npz --model docs/examples/step.obj --size 64x48
      under a clear sky with a sun: picture, clusters, a page
  crossbar cpca render docs/examples/step_small.npz --model docs/examples/step.obj --original docs/examples/step.npz --light disk:1,0,2:20 --size 64x48
      beside the uncompressed transfer: differences, and the error of every vertex
  crossbar cpca render docs/examples/step.npz --model docs/examples/step.obj --light red-and-blue --size 64x48
      uncompressed
  crossbar cpca render docs/examples/step_small.npz --model docs/examples/step.obj --light scene:cornell-box@0.28,0.28,0.4 --size 64x48
      under the light at a place in a room, path-traced

Written to --out: index.html (self-contained), pictures, picture.exr. Vertex radiance is interpolated over triangles, on the host.";

/// Draw a model under distant light from its transfer, compressed or not
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// Transfer or clusters; clusters are drawn if there are both
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,

    /// Uncompressed transfer of the same model, to compare with
    #[arg(long, value_name = "X.npz")]
    original: Option<PathBuf>,

    #[arg(long, value_name = "LIGHT", default_value = DEFAULT_LIGHT, allow_hyphen_values = true, help = HARMONIC_LIGHT)]
    light: DistantLightArg,

    #[command(flatten)]
    picture: PictureArgs,

    /// Where to write pictures and the page
    #[arg(long, value_name = "DIR", default_value = "out/cpca")]
    out: PathBuf,
}

impl StudyArgs for Args {
    type Study = Rendering;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        let files = [Some(self.file.as_path()), self.original.as_deref(), self.light.file()];
        StudyFiles::new(Some(&self.out), files.into_iter().flatten().chain(self.picture.inputs()).collect())
    }

    fn study(&self) -> miette::Result<Rendering> {
        let FileOfModel { file, model, vertices, digest } = FileOfModel::load(&self.file, &self.picture.model)?;
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
            view: self.picture.view(&model.mesh, self.light.name())?,
            light: self.light.of_order(light_order)?,
            mesh: model.mesh,
            vertices,
            file,
            original,
        })
    }
}
