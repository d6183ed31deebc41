//! Options of `crossbar prt render` for bi-scale transfer.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use super::textures::{PatchArgs, patch_kind, refuse};
use crate::cli::Problem;
use crate::names::did_you_mean;
use crate::prt::bi_scale::directions::LocalDirections;
use crate::scene::Material;
use crate::study::prt::SurfaceTexture;

/// Options of bi-scale transfer.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Options of bi-scale transfer")]
pub(in crate::cli::prt) struct BiScaleRenderArgs {
    /// The bidirectional texture of a material, or of all that have none of their own: a file (.npy) that `crossbar prt
    /// texture` wrote or one like it, or a patch: bumps, mail, tiles, bricks, weave
    #[arg(long, value_name = "[MATERIAL=]B.npy")]
    pub(super) texture: Vec<TextureArg>,

    #[command(flatten)]
    pub(super) patches: PatchArgs,

    /// Draw a picture by rays too, and tell the error apart by its causes; takes milliseconds per pixel. All textures
    /// must be patches
    #[arg(long)]
    pub(super) reference: bool,
}

/// A texture, and the material that it belongs to.
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

impl BiScaleRenderArgs {
    /// Refuses all of these for transfer of other kinds.
    pub(in crate::cli::prt) fn refuse(&self) -> Result<(), Problem> {
        let own = [("--texture", !self.texture.is_empty()), ("--reference", self.reference)];
        refuse(own.into_iter().chain(self.patches.given()))
    }

    /// Bytes of the samples of patches.
    pub(super) fn bytes(&self) -> u64 {
        let patches = self.texture.iter().filter(|texture| patch_kind(&texture.source).is_some()).count() as u64;
        patches.saturating_mul(self.patches.bytes())
    }

    /// The files of textures.
    pub(super) fn files(&self) -> impl Iterator<Item = &Path> {
        self.texture.iter().map(|texture| texture.source.as_path()).filter(|source| patch_kind(source).is_none())
    }

    /// The texture of each material, by its number among those given.
    pub(super) fn of_materials(&self, materials: &[Material]) -> Result<Vec<u32>, Problem> {
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

    /// The textures, those of patches sampled in a transfer's local directions.
    pub(super) fn textures(&self, light: &LocalDirections) -> miette::Result<Vec<SurfaceTexture>> {
        self.texture.iter().map(|texture| self.patches.texture(&texture.source, light)).collect()
    }
}
