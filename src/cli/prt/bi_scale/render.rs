//! `crossbar prt render` of bi-scale transfer.

use std::path::Path;

use super::load_creased;
use crate::cli::memory::MemoryNeed;
use crate::cli::model_name::{self, Model};
use crate::cli::prt::model::{materials_of, vertices};
use crate::cli::prt::render;
use crate::cli::study::StudyArgs;
use crate::cli::{Problem, view};
use crate::prt::bi_scale::directions::LocalDirections;
use crate::prt::file::{BiScaleFile, MeshDigest, PrtFileError, load_bi_scale};
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
        if self.0.bi_scale.texture.is_empty() {
            let what = "bi-scale transfer is drawn with a bidirectional texture, found none";
            return Err(Problem::usage(what, "name one: `--texture mail`, or `--texture B.npy`"));
        }
        Ok(())
    }

    /// The model of a file, and its transfer.
    fn load(&self) -> miette::Result<(BiScaleFile, Model, TexturedSurface)> {
        let path = self.0.file();
        view::require_file(path, 6, "name a smaller file")?;
        let file = load_bi_scale(path)?;
        let name = &self.0.model;
        let Some(meaning) = file.meaning else {
            let what = format!("{}: expected transfer of a mesh, found a matrix of something else", path.display());
            return Err(Problem::usage(what, "name what `crossbar prt precompute --kind bi-scale` wrote").into());
        };
        let model = load_creased(name, meaning.mesh.tangents, self.0.bi_scale.crease)?;
        let vertices = vertices(&model, meaning.mesh.tangents)?;
        let expected = MeshDigest::new(&vertices);
        if meaning.mesh != expected {
            let found = Some(meaning.mesh);
            return Err(PrtFileError::OtherMesh { path: path.into(), expected, found }.into());
        }
        let (materials, material_of) = materials_of(name, &model)?;
        let of_material = self.0.bi_scale.of_materials(&materials)?;
        let texture_of = material_of.iter().map(|&material| of_material[material as usize]).collect();
        let repeat = self.0.bi_scale.repeat.unwrap_or(1.0);
        let mesh = model.mesh.clone();
        let surface = TexturedSurface::new(mesh, vertices, texture_of, repeat).map_err(|error| {
            Problem::usage(format!("{}: {error}", name.display()), "name a model with texture coordinates (`vt`)")
        })?;
        Ok((file, model, surface))
    }
}

impl StudyArgs for Args<'_> {
    type Study = BiScaleRendering;
    const COMMAND: &'static str = "prt render";

    fn folder(&self) -> Option<&Path> {
        self.0.folder()
    }

    fn inputs(&self) -> Vec<&Path> {
        let model = model_name::named_file(&self.0.model);
        [self.0.file()].into_iter().chain(model).chain(self.0.light.file()).chain(self.0.bi_scale.files()).collect()
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        let pictures = self.0.pictures();
        let bytes = pictures.bytes.saturating_add(self.0.bi_scale.bytes());
        Ok(Some(MemoryNeed { bytes, help: "ask for a smaller `--size` or `--texture-size`", ..pictures }))
    }

    fn study(&self) -> miette::Result<BiScaleRendering> {
        self.refuse_others()?;
        let (file, model, surface) = self.load()?;
        let side = file.meaning.map_or(0, |meaning| meaning.side as usize);
        let light =
            LocalDirections::new(side).map_err(|error| Problem::usage(error.to_string(), "name another file"))?;
        let render::Args { model: name, light: light_args, frames, size, eye, exposure, .. } = self.0;
        Ok(BiScaleRendering {
            model: name.display().to_string(),
            camera: eye.framing(&model.mesh, *size)?,
            textures: self.0.bi_scale.textures(&light)?,
            surface,
            file,
            light_name: light_args.name(),
            light: light_args.distant()?,
            exposure: *exposure,
            frames: *frames,
            turning: self.0.turning(),
            reference: self.0.bi_scale.reference,
        })
    }
}
