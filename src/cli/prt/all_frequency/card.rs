//! `crossbar prt card` of all-frequency transfer.

use std::path::Path;

use super::LitArgs;
use crate::cli::memory::MemoryNeed;
use crate::cli::prt::card;
use crate::cli::study::StudyArgs;
use crate::study::prt::AllFrequencyOnCard;

/// The options of `card`, for such a file.
#[derive(Debug)]
pub(in crate::cli::prt) struct Args<'a>(pub(in crate::cli::prt) &'a card::Args);

impl StudyArgs for Args<'_> {
    type Study = AllFrequencyOnCard;
    const COMMAND: &'static str = "prt card";

    fn folder(&self) -> Option<&Path> {
        self.0.folder()
    }

    fn inputs(&self) -> Vec<&Path> {
        self.0.inputs()
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        Ok(Some(self.0.pictures()))
    }

    fn study(&self) -> miette::Result<AllFrequencyOnCard> {
        let card::Args { model, original, light, keep, card, eye, size, exposure, target_format, .. } = self.0;
        let profile = card.profile("r350")?;
        let place = self.0.place(&profile)?;
        let lit = LitArgs {
            file: self.0.file(),
            model,
            original: original.as_deref(),
            light,
            keep: *keep,
            eye,
            size: *size,
            exposure: *exposure,
        };
        Ok(AllFrequencyOnCard {
            lit: lit.load()?,
            switches: card.switches(),
            executor: card.executor()?,
            format: *target_format,
            place,
            sums_on_card: self.0.sums_on_card(),
            sweep: self.0.sweep,
            profile,
        })
    }
}
