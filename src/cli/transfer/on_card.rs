//! Pictures on an emulated card.

use refsim::texture::TexelFormat;

use crate::cli::card::CardArgs;
use crate::study::prt::CardSetting;

/// The card, and the option to vary its settings.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct OnCardArgs {
    /// Vary number formats, maps and targets, one at a time, and show the error of each
    #[arg(long)]
    sweep: bool,

    #[command(flatten)]
    card: CardArgs,
}

impl OnCardArgs {
    /// The card that draws: the requested one, otherwise `device`.
    pub(in crate::cli) fn setting(&self, device: &str) -> miette::Result<CardSetting> {
        let Self { sweep, card } = self;
        let (profile, executor) = (card.profile(device)?, card.executor()?);
        let format = TexelFormat::Bgra8;
        Ok(CardSetting { profile, switches: card.switches(), executor, format, sweep: *sweep })
    }
}
