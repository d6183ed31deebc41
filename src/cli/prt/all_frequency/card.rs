//! `crossbar prt card` of all-frequency transfer.

use std::path::Path;

use super::{FileOfModel, color, original_of};
use crate::cli::memory::MemoryNeed;
use crate::cli::prt::card;
use crate::cli::study::StudyArgs;
use crate::cli::view;
use crate::prt::all_frequency::light::Decimation;
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
        let card::Args { model: name, original, light, keep, card, target_format, .. } = self.0;
        let profile = card.profile("r350")?;
        let place = self.0.place(&profile)?;
        view::require_file(self.0.file(), 3, "name a smaller file")?;
        let FileOfModel { file, model, vertices, digest } = FileOfModel::load(self.0.file(), name)?;
        let original = original.as_ref().map(|path| original_of(&file, &digest, path)).transpose()?;
        Ok(AllFrequencyOnCard {
            model: name.display().to_string(),
            camera: self.0.eye.framing(&model.mesh, self.0.size)?,
            colors: model.materials.iter().map(color).collect(),
            mesh: model.mesh,
            vertices,
            file,
            original,
            light_name: light.name(),
            light: light.distant()?,
            decimation: Decimation::SolidAngle,
            keep: keep.map(|keep| keep as usize),
            exposure: self.0.exposure,
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
