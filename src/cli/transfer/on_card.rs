//! Pictures on an emulated card.

use clap::ValueEnum;
use refsim::isa::Version;
use refsim::texture::TexelFormat;

use crate::cli::card::CardArgs;
use crate::study::prt::CardSetting;

/// The card, its target, and what of it is varied.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct OnCardArgs {
    /// Format of the picture
    #[arg(long, value_name = "F", default_value = "bgra8")]
    pub(in crate::cli) target_format: TexelFormat,

    /// Vary number formats, maps and targets, one after the other: what each of them costs
    #[arg(long)]
    pub(in crate::cli) sweep: bool,

    #[command(flatten)]
    pub(in crate::cli) card: CardArgs,
}

impl OnCardArgs {
    /// The card that draws; `device` is drawn on where none is named.
    pub(in crate::cli) fn setting(&self, device: &str) -> miette::Result<CardSetting> {
        let Self { target_format: format, sweep, card } = self;
        let (profile, executor) = (card.profile(device)?, card.executor()?);
        Ok(CardSetting { profile, switches: card.switches(), executor, format: *format, sweep: *sweep })
    }
}

/// A vertex language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum VertexArg {
    #[value(name = "vs_1_1")]
    Vs1_1,
    #[value(name = "vs_2_0")]
    Vs2_0,
}

impl From<VertexArg> for Version {
    fn from(arg: VertexArg) -> Self {
        match arg {
            VertexArg::Vs1_1 => Self::Vs1_1,
            VertexArg::Vs2_0 => Self::Vs2_0,
        }
    }
}
