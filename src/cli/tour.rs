//! `crossbar tour`: one room through four systems.

use std::path::PathBuf;

use super::study::{StudyArgs, StudyFiles};
use crate::options::Size;
use crate::options::number;
use crate::study::tour::Parameters;

const EXAMPLES: &str = "\
Examples:
  crossbar tour
      a room lit by matrix radiosity, with form factors by the Ray Engine's rays; in it, a glossy bunny and a marble suit of armor

Written to --out: index.html (self-contained), room.png, clock.csv and timeline.json (the modelled time of every step, a trace \
for https://ui.perfetto.dev or chrome://tracing), formats.csv (what each number format costs each system).";

/// Take one room through four systems: rays, radiosity, radiance transfer, subsurface scattering
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// Pixels of the picture
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true)]
    size: Size,

    /// Lengthen edges of patches and models by this factor, for a quick look
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = number::whole::<u32>(1..=8))]
    coarser: u32,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/tour")]
    out: PathBuf,
}

impl StudyArgs for Args {
    type Study = Parameters;
    const QUICKER: &'static str = "a higher `--coarser`";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(Some(&self.out), Vec::new())
    }

    fn study(&self) -> miette::Result<Parameters> {
        Ok(Parameters { size: self.size, coarser: self.coarser })
    }
}
