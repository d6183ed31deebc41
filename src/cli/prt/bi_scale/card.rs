//! `crossbar prt card` of bi-scale transfer.

use std::path::Path;

use super::textures::TransferOfModel;
use crate::bi_scale::on_card::corner_coordinates;
use crate::cli::Problem;
use crate::cli::memory::MemoryNeed;
use crate::cli::prt::card;
use crate::cli::study::StudyArgs;
use crate::study::prt::BiScaleOnCard;

/// The options of `card`, for such a file.
#[derive(Debug)]
pub(in crate::cli::prt) struct Args<'a>(pub(in crate::cli::prt) &'a card::Args);

impl StudyArgs for Args<'_> {
    type Study = BiScaleOnCard;
    const COMMAND: &'static str = "prt card";

    fn folder(&self) -> Option<&Path> {
        self.0.folder()
    }

    fn inputs(&self) -> Vec<&Path> {
        self.0.bi_scale.textures.inputs(self.0.file(), &self.0.model, &self.0.light)
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        Ok(Some(self.0.bi_scale.textures.memory(self.0.pictures())))
    }

    fn study(&self) -> miette::Result<BiScaleOnCard> {
        self.0.refuse_others()?;
        let card::Args { model: name, light, card, target_format, bi_scale, .. } = self.0;
        let textures = &bi_scale.textures;
        textures.require()?;
        let (TransferOfModel { file, model, vertices, light: directions }, texture_of) =
            textures.transfer(self.0.file(), name)?;
        let Some(biclusters) = file.biclusters else {
            let what = format!("{}: expected biclusters, found a matrix alone", self.0.file().display());
            return Err(Problem::usage(what, "`crossbar prt bicluster` makes them").into());
        };
        let repeat = textures.patches.repeat() as f32;
        let coordinates = corner_coordinates(&model.mesh, [repeat; 2]).map_err(|error| {
            Problem::usage(format!("{}: {error}", name.display()), "name a model with texture coordinates (`vt`)")
        })?;
        Ok(BiScaleOnCard {
            model: name.display().to_string(),
            camera: self.0.eye.framing(&model.mesh, self.0.size)?,
            vertices,
            coordinates,
            biclusters,
            textures: textures.textures(&directions)?.into_iter().map(|texture| texture.samples).collect(),
            texture_of,
            light_name: light.name(),
            light: light.distant()?,
            exposure: self.0.exposure,
            profile: card.profile("gt200")?,
            switches: card.switches(),
            executor: card.executor()?,
            format: *target_format,
            light_format: bi_scale.light(),
            options: bi_scale.options(),
            sweep: self.0.sweep,
        })
    }
}
