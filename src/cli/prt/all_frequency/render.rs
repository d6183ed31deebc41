//! `crossbar prt render` of all-frequency transfer.

use std::path::Path;

use super::FileOfModel;
use crate::cli::memory::MemoryNeed;
use crate::cli::prt::render;
use crate::cli::study::StudyArgs;
use crate::cli::{Problem, view};
use crate::prt::all_frequency::light::Decimation;
use crate::prt::file::load_all_frequency;
use crate::scene::{Material, Surface};
use crate::study::prt::AllFrequencyRendering;

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
        let render::Args { model: name, original, light, keep, frames, size, eye, exposure, .. } = self.0;
        view::require_file(self.0.file(), 3, "name a smaller file")?;
        let FileOfModel { file, model, vertices, digest } = FileOfModel::load(self.0.file(), name)?;
        let original = match original {
            None => None,
            Some(path) => {
                view::require_file(path, 3, "name a smaller file")?;
                let original = load_all_frequency(path, Some(&digest))?;
                if original.visibility.is_none()
                    || original.reflectance != file.reflectance
                    || original.hats != file.hats
                {
                    let what =
                        format!("{}: expected visibility with the same reflectance, found other", path.display());
                    return Err(Problem::usage(what, "name the file that was compressed").into());
                }
                Some(original)
            }
        };
        Ok(AllFrequencyRendering {
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

/// What a surface's radiance is multiplied by: its albedo, or 1 if it has none.
fn color(material: &Material) -> [f64; 3] {
    match &material.surface {
        Surface::Diffuse { albedo } | Surface::Glossy { albedo, .. } => albedo.map(f64::from),
        _ => [1.0; 3],
    }
}
