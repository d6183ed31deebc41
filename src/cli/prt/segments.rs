//! Options of compression that only transfer of all frequencies has.

use std::path::PathBuf;

use clap::ValueEnum;

/// Which numbers share a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum ScaleArg {
    /// Those of a representative, and the weights on it
    #[default]
    Representative,
    /// All of a segment
    Segment,
}

/// How transfer of all frequencies is compressed and coded.
#[derive(Clone, Debug, Default, PartialEq, clap::Args)]
pub(super) struct SegmentArgs {
    /// The model that transfer of all frequencies was made from
    #[arg(long, value_name = "MODEL")]
    pub(super) model: Option<PathBuf>,

    /// Vertices per cluster on average, for transfer of all frequencies [default: 200]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) points_per_cluster: Option<u32>,

    /// Bits of the numbers of representatives, for transfer of all frequencies [default: 16]
    #[arg(long, value_name = "BITS", value_parser = clap::value_parser!(u8).range(2..=16))]
    pub(super) bits: Option<u8>,

    /// Bits of weights, for transfer of all frequencies [default: 16]
    #[arg(long, value_name = "BITS", value_parser = clap::value_parser!(u8).range(2..=16))]
    pub(super) weight_bits: Option<u8>,

    /// Which numbers share a step, for transfer of all frequencies [default: representative]
    #[arg(long, value_enum, value_name = "OF")]
    pub(super) scale: Option<ScaleArg>,

    /// Keep finished segments in this folder, and take those that it has, for transfer of all frequencies
    #[arg(long, value_name = "FOLDER")]
    pub(super) resume: Option<PathBuf>,
}
