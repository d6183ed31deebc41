//! `crossbar measure`: compares a card's pixels with every setting of a device's switches.

use std::path::PathBuf;

use super::study::{StudyArgs, StudyFiles};
use super::switch;
use crate::study::measure::{Measure, load_measurement};

const EXAMPLES: &str = "\
Examples:
  crossbar measure docs/examples/measured.csv --device nv25
      compares pixels captured on a card with all settings of the GeForce4 Ti's switches that affect these pixels
  crossbar measure docs/examples/measured.csv --device nv25 --switch mad=fused --json
      the same, with one switch already known, as JSON

The table has the header `case,column,row,red,green,blue,alpha,depth`: a case file, a pixel of it, and the codes that \
the card stored there. docs/measuring.md describes the table, and has a small case for each open switch of the cards \
that tells the switch's values apart.

Exit codes: 0 a setting reproduces every measured code, 1 no setting does, 2 the table or a case cannot be used.";

/// Compare pixels captured on a real card with every combination of a device's switches; list those that match
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// The measured pixels, a CSV file
    #[arg(value_name = "FILE.csv")]
    file: PathBuf,

    /// The card that drew the pixels; it replaces the device of the cases
    #[arg(long, value_name = "D")]
    device: String,

    /// A switch whose value is known; may be given several times
    #[arg(long, value_name = "NAME=VALUE", value_parser = switch::parse)]
    switch: Vec<(String, String)>,
}

impl StudyArgs for Args {
    type Study = Measure;
    const QUICKER: &'static str = "`--switch NAME=VALUE` for each switch that is known";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(None, vec![&self.file])
    }

    fn study(&self) -> miette::Result<Measure> {
        Ok(Measure {
            name: self.file.display().to_string(),
            cases: load_measurement(&self.file)?,
            profile: switch::device(&self.device, &self.switch)?,
            known: self.switch.clone(),
        })
    }
}
