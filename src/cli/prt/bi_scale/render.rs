//! `crossbar prt render` of bi-scale transfer.

use std::path::Path;

use super::textures::TransferOfModel;
use crate::cli::Problem;
use crate::cli::memory::MemoryNeed;
use crate::cli::prt::render;
use crate::cli::study::StudyArgs;
use crate::study::prt::{BiScaleRendering, TexturedSurface};

/// The options of `render`, for such a file.
#[derive(Debug)]
pub(in crate::cli::prt) struct Args<'a>(pub(in crate::cli::prt) &'a render::Args);

impl Args<'_> {
    /// Options of other kinds of transfer are not for this one.
    fn refuse_others(&self) -> Result<(), Problem> {
        for (given, option) in [
            (self.0.original.is_some(), "--original"),
            (self.0.ground.is_some(), "--ground"),
            (self.0.keep.is_some(), "--keep"),
        ] {
            if given {
                let what = format!("`{option}` is for other kinds of transfer, found bi-scale transfer");
                return Err(Problem::usage(what, "leave it out"));
            }
        }
        self.0.bi_scale.textures.require()
    }
}

impl StudyArgs for Args<'_> {
    type Study = BiScaleRendering;
    const COMMAND: &'static str = "prt render";

    fn folder(&self) -> Option<&Path> {
        self.0.folder()
    }

    fn inputs(&self) -> Vec<&Path> {
        self.0.bi_scale.textures.inputs(self.0.file(), &self.0.model, &self.0.light)
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        Ok(Some(self.0.bi_scale.textures.memory(self.0.pictures())))
    }

    fn study(&self) -> miette::Result<BiScaleRendering> {
        self.refuse_others()?;
        let render::Args { model: name, bi_scale, .. } = self.0;
        let textures = &bi_scale.textures;
        let (TransferOfModel { file, model, vertices, light }, texture_of) = textures.transfer(self.0.file(), name)?;
        let surface = TexturedSurface::new(model.mesh.clone(), vertices, texture_of, textures.patches.repeat());
        let surface = surface.map_err(|error| {
            Problem::usage(format!("{}: {error}", name.display()), "name a model with texture coordinates (`vt`)")
        })?;
        let render::Args { light: light_args, frames, size, eye, exposure, .. } = self.0;
        Ok(BiScaleRendering {
            model: name.display().to_string(),
            camera: eye.framing(&model.mesh, *size)?,
            textures: textures.textures(&light)?,
            surface,
            file,
            light_name: light_args.name(),
            light: light_args.distant()?,
            exposure: *exposure,
            frames: *frames,
            turning: self.0.turning(),
            reference: bi_scale.reference,
        })
    }
}
