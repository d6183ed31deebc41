//! What the commands that trace rays share: sizes, sides, executors, folders of results.

use std::path::Path;

use clap::ValueEnum;
use refsim::machine::ExecutorKind;
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

/// Who computes on the card.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum DeviceExecutor {
    /// The reference: a fragment at a time, by integers
    Scalar,
    /// Many fragments at once
    Batch,
}

impl From<DeviceExecutor> for ExecutorKind {
    fn from(arg: DeviceExecutor) -> Self {
        match arg {
            DeviceExecutor::Scalar => Self::Scalar,
            DeviceExecutor::Batch => Self::Batch,
        }
    }
}

/// Who decides what a ray hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Decider {
    /// Exact arithmetic: the truth
    Exact,
    /// The emulated card, a fragment at a time
    Scalar,
    /// The emulated card, many fragments at once; the bits are those of scalar
    Batch,
}

impl Decider {
    /// What was asked for; a card that was named is asked, unless the executor says otherwise.
    pub(super) fn choose(executor: Option<Self>, device: Option<&str>) -> Self {
        executor.unwrap_or(if device.is_some() { Self::Batch } else { Self::Exact })
    }

    /// The executor of the card, or `None` for exact arithmetic.
    pub(super) const fn kind(self) -> Option<ExecutorKind> {
        match self {
            Self::Exact => None,
            Self::Scalar => Some(ExecutorKind::Scalar),
            Self::Batch => Some(ExecutorKind::Batch),
        }
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
