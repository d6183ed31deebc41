//! Pictures on an emulated card.

use refsim::texture::TexelFormat;

use crate::cli::card::CardArgs;
use crate::cli::transfer::picture::ValuesArgs;
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
    pub(in crate::cli) values: ValuesArgs,

    #[command(flatten)]
    pub(in crate::cli) card: CardArgs,
}

impl OnCardArgs {
    /// The card that draws, without [`Self::values`]; `device` is drawn on where none is named.
    pub(in crate::cli) fn setting(&self, device: &str) -> miette::Result<CardSetting> {
        let Self { target_format: format, sweep, card, .. } = self;
        let (profile, executor) = (card.profile(device)?, card.executor()?);
        Ok(CardSetting { profile, switches: card.switches(), executor, format: *format, sweep: *sweep, values: None })
    }
}
