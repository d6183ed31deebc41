//! `crossbar tour`: one room through four systems.

use std::path::PathBuf;

use super::study::{StudyArgs, StudyFiles};
use crate::study::tour::Parameters;

const EXAMPLES: &str = "\
Examples:
  crossbar tour
      a room lit by matrix radiosity, whose form factors use rays of the Ray Engine; \
in the room, a glossy bunny and a marble suit of armor

Written to --out: index.html (self-contained), room.png, clock.csv and timeline.json (the modelled time of every step, a trace \
for https://ui.perfetto.dev or chrome://tracing), formats.csv (the error of each system in each number format).";

/// Compute one room with four systems: rays, radiosity, radiance transfer, subsurface scattering
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    #[command(flatten)]
    parameters: Parameters,

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
        Ok(self.parameters)
    }
}
