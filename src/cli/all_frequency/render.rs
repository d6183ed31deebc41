//! `crossbar all-frequency render`: pictures of a model from its transfer.

use std::path::PathBuf;

use super::file::LitArgs;
use crate::cli::study::{StudyArgs, StudyFiles};
use crate::study::prt::AllFrequencyRendering;

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency render docs/examples/step_all_small.npz --model docs/examples/step.obj --size 64x48
      under a clear sky with a sun: picture, a page
  crossbar all-frequency render docs/examples/step_all_small.npz --model docs/examples/step.obj --original docs/examples/step_all.npz --keep 200 --size 64x48
      beside the uncompressed transfer, with 200 coefficients of the light
  crossbar all-frequency render docs/examples/step_all.npz --model docs/examples/step.obj --light red-and-blue --size 64x48
      uncompressed, under a red and a blue light

Written to --out: index.html (self-contained), pictures, picture.exr. Every pixel takes its own view, on the host.";

/// Draw a model under distant light from its transfer, compressed or not
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    #[command(flatten)]
    lit: LitArgs,

    /// Where to write pictures and the page
    #[arg(long, value_name = "DIR", default_value = "out/all-frequency")]
    out: PathBuf,
}

impl StudyArgs for Args {
    type Study = AllFrequencyRendering;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(Some(&self.out), self.lit.inputs())
    }

    fn study(&self) -> miette::Result<AllFrequencyRendering> {
        Ok(AllFrequencyRendering { lit: self.lit.load()? })
    }
}
