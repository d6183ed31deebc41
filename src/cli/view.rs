//! What the commands that trace rays share: sizes, sides, folders of results.

use std::path::Path;

use clap::ValueEnum;
use refsim::num::FormatError;

use super::Problem;
use crate::geom::exact::Sides;
use crate::io::atomic::FileSet;

/// Which faces can be hit.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum SidesArg {
    /// The side from which the corners run counter-clockwise
    Front,
    /// Both sides
    Both,
}

impl From<SidesArg> for Sides {
    fn from(arg: SidesArg) -> Self {
        match arg {
            SidesArg::Front => Self::Front,
            SidesArg::Both => Self::Both,
        }
    }
}

impl std::fmt::Display for SidesArg {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Front => "front",
            Self::Both => "both",
        })
    }
}

/// The card where none is named.
pub(super) const DEFAULT_DEVICE: &str = "ideal-fp32";

/// `1,2.5,-3` as a point.
pub(super) fn parse_point(text: &str) -> Result<[f32; 3], String> {
    let wrong = || format!("expected three numbers X,Y,Z; found `{text}`");
    let parts: Vec<f32> = text
        .split(',')
        .map(|part| part.trim().parse::<f32>().ok().filter(|x| x.is_finite()).ok_or_else(wrong))
        .collect::<Result<_, _>>()?;
    parts.try_into().map_err(|_| wrong())
}

/// For `map_err` on parsing a number format.
pub(super) fn bad_format(error: FormatError) -> miette::Report {
    Problem::usage(format!("{error}"), "formats are s3.12, e5m10:rtz, fp24 and the like: see `crossbar alu --help`")
        .into()
}

/// Writes all files of a result, or none.
pub(super) fn write_folder(mut set: FileSet, files: &[(String, Vec<u8>)]) -> miette::Result<()> {
    for (name, bytes) in files {
        set.write(Path::new(name), |out| out.write_all(bytes)).map_err(Problem::from)?;
    }
    set.commit().map_err(Problem::from)?;
    Ok(())
}
