//! `crossbar prt render` of all-frequency transfer.

use std::path::Path;

use super::{FileOfModel, color, original_of};
use crate::cli::memory::MemoryNeed;
use crate::cli::prt::render;
use crate::cli::study::StudyArgs;
use crate::cli::view;
use crate::prt::all_frequency::light::Decimation;
use crate::study::prt::{AllFrequencyRendering, RenderedGround};

/// The options of `render`, for such a file.
#[derive(Debug)]
pub(in crate::cli::prt) struct Args<'a>(pub(in crate::cli::prt) &'a render::Args);

impl StudyArgs for Args<'_> {
    type Study = AllFrequencyRendering;
    const COMMAND: &'static str = "prt render";

    fn folder(&self) -> Option<&Path> {
        self.0.folder()
    }

    fn inputs(&self) -> Vec<&Path> {
        self.0.inputs()
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        Ok(Some(self.0.pictures()))
    }

    fn study(&self) -> miette::Result<AllFrequencyRendering> {
        self.0.bi_scale.refuse()?;
        let render::Args { model: name, original, light, keep, frames, size, eye, exposure, .. } = self.0;
        view::require_file(self.0.file(), 3, "name a smaller file")?;
        let FileOfModel { file, model, vertices, digest } = FileOfModel::load(self.0.file(), name)?;
        let original = original.as_ref().map(|path| original_of(&file, &digest, path)).transpose()?;
        let ground = self.0.ground.as_ref().map(|path| {
            let beside = path.with_extension("obj");
            view::require_file(path, 3, "name a smaller file")?;
            let FileOfModel { file, model, vertices, .. } =
                FileOfModel::load(path, self.0.ground_model.as_ref().unwrap_or(&beside))?;
            let colors = model.materials.iter().map(color).collect();
            Ok::<_, miette::Report>(RenderedGround { mesh: model.mesh, vertices, colors, file })
        });
        Ok(AllFrequencyRendering {
            ground: ground.transpose()?,
            model: name.display().to_string(),
            camera: eye.framing(&model.mesh, *size)?,
            colors: model.materials.iter().map(color).collect(),
            mesh: model.mesh,
            vertices,
            file,
            original,
            light_name: light.name(),
            light: light.distant()?,
            decimation: Decimation::SolidAngle,
            keep: keep.map(|keep| keep as usize),
            exposure: *exposure,
            frames: *frames,
            turning: self.0.turning(),
        })
    }
}
