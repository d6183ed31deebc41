//! The bidirectional textures of a model, by material.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use super::textures::{PatchArgs, TransferOfModel, patch_kind};
use crate::bi_scale::directions::LocalDirections;
use crate::cli::Problem;
use crate::cli::transfer::light::DistantLightArg;
use crate::cli::transfer::model::materials_of;
use crate::cli::transfer::picture::PictureArgs;
use crate::names::did_you_mean;
use crate::scene::Material;
use crate::study::prt::SurfaceTexture;

/// Textures, and the sampling of patches.
#[derive(Debug, clap::Args)]
pub(super) struct TextureArgs {
    /// The bidirectional texture of a material, or of all that have none of their own: a file (.npy) that `crossbar
    /// bi-scale texture` wrote or one like it, or a patch: bumps, mail, tiles, bricks, weave
    #[arg(long, required = true, value_name = "[MATERIAL=]B.npy")]
    texture: Vec<TextureArg>,

    #[command(flatten)]
    pub(super) patches: PatchArgs,
}

/// A texture, and the material to which it belongs.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TextureArg {
    material: Option<String>,
    source: PathBuf,
}

impl FromStr for TextureArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (material, source) = match text.split_once('=') {
            Some((material, source)) => (Some(material.to_owned()), source),
            None => (None, text),
        };
        if source.is_empty() || material.as_ref().is_some_and(String::is_empty) {
            return Err("expected a texture, or a material, `=` and its texture, as in floor=tiles".to_owned());
        }
        Ok(Self { material, source: source.into() })
    }
}

impl TextureArgs {
    /// Transfer with its model, and a texture index per triangle.
    pub(super) fn transfer(&self, file: &Path, model: &Path) -> miette::Result<(TransferOfModel, Vec<u32>)> {
        if !self.texture.iter().any(|texture| patch_kind(&texture.source).is_some()) {
            self.patches.require_patch()?;
        }
        let transfer = TransferOfModel::load(file, model, self.patches.crease)?;
        let (materials, material_of) = materials_of(model, &transfer.model)?;
        let of_material = self.of_materials(&materials)?;
        let texture_of = material_of.iter().map(|&material| of_material[material as usize]).collect();
        Ok((transfer, texture_of))
    }

    /// The input files of a picture: transfer, model, light, textures.
    pub(super) fn inputs<'a>(
        &'a self,
        transfer: &'a Path,
        picture: &'a PictureArgs,
        light: &'a DistantLightArg,
    ) -> Vec<&'a Path> {
        let files = self.texture.iter().map(|texture| texture.source.as_path());
        let files = files.filter(|source| patch_kind(source).is_none());
        [transfer].into_iter().chain(picture.inputs()).chain(light.file()).chain(files).collect()
    }

    /// Index of the texture of each material.
    fn of_materials(&self, materials: &[Material]) -> Result<Vec<u32>, Problem> {
        for (at, TextureArg { material, .. }) in self.texture.iter().enumerate() {
            if self.texture[..at].iter().any(|before| before.material == *material) {
                let of = material.as_deref().map_or("all other materials".to_owned(), |name| format!("`{name}`"));
                return Err(Problem::usage(format!("expected one texture for {of}, found two"), "leave one out"));
            }
            let Some(name) = material else { continue };
            if !materials.iter().any(|material| material.name == *name) {
                let names: Vec<&str> = materials.iter().map(|material| material.name.as_str()).collect();
                let meant = did_you_mean(name, names.iter().copied());
                let what = format!("the model has no material `{name}`");
                return Err(Problem::usage(what, format!("{meant}there are {}", names.join(", "))));
            }
        }
        let of = |material: &Material| {
            let own = self.texture.iter().position(|texture| texture.material.as_ref() == Some(&material.name));
            let found = own.or_else(|| self.texture.iter().position(|texture| texture.material.is_none()));
            found.map(|at| at as u32).ok_or_else(|| {
                let what = format!("expected a texture for material `{}`, found none", material.name);
                Problem::usage(what, "name one for all: `--texture mail`, or `--texture B.npy`")
            })
        };
        materials.iter().map(of).collect()
    }

    /// The textures; patches are sampled in a transfer's local directions.
    pub(super) fn textures(&self, light: &LocalDirections) -> miette::Result<Vec<SurfaceTexture>> {
        self.texture.iter().map(|texture| self.patches.texture(&texture.source, light)).collect()
    }
}
