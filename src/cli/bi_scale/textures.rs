//! Options of textures that `crossbar bi-scale render` and `card` share, and the transfer of a model.

use std::path::Path;

use super::file::{angle, load_creased};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::file::{BiScaleFile, load_bi_scale};
use crate::bi_scale::texture::{PatchKind, TextureSampling, load_bidirectional_texture};
use crate::cli::model_name::Model;
use crate::cli::transfer::model::vertices_of;
use crate::cli::{Problem, given};
use crate::options::number;
use crate::study::prt::SurfaceTexture;
use crate::transfer::Vertices;

/// Sampling of patches, and their placement.
#[derive(Debug, clap::Args)]
pub(super) struct PatchArgs {
    /// Repetitions of a texture per unit of texture coordinates
    #[arg(long, value_name = "X", default_value_t = 1.0, value_parser = number::positive)]
    pub(super) repeat: f64,

    /// Texels per side of textures of patches [default: 64]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(1..=1024))]
    texture_size: Option<u32>,

    /// View directions per side of the square, for textures of patches [default: 12]
    #[arg(long, value_name = "K", value_parser = number::whole::<u8>(1..=64))]
    texture_views: Option<u8>,

    /// The crease angle in degrees, as given to `crossbar bi-scale precompute`
    #[arg(long, value_name = "DEGREES", value_parser = angle, allow_hyphen_values = true)]
    pub(super) crease: Option<f64>,
}

impl PatchArgs {
    /// Rejects options of patches if no texture is a patch. The [`Problem`] names the option.
    pub(super) fn require_patch(&self) -> Result<(), Problem> {
        let of_patches =
            [("--texture-size", self.texture_size.is_some()), ("--texture-views", self.texture_views.is_some())];
        given::refuse(of_patches, "textures of patches, found files only", "leave it out: a file has its own size")
    }

    /// A texture, read from its file, or sampled from a named patch in a transfer's local directions.
    pub(super) fn texture(&self, source: &Path, light: &LocalDirections) -> miette::Result<SurfaceTexture> {
        let name = source.display().to_string();
        let Some(kind) = patch_kind(source) else {
            let names: Vec<String> = PatchKind::ALL.iter().map(PatchKind::to_string).collect();
            given::require_file(source, "patch", &names.iter().map(String::as_str).collect::<Vec<_>>(), "npy")?;
            return Ok(SurfaceTexture { name, samples: load_bidirectional_texture(source)?, patch: None });
        };
        let refused = |error: String| Problem::usage(error, "see `--help`");
        let view = LocalDirections::new(self.texture_views.unwrap_or(12).into())
            .map_err(|error| refused(error.to_string()))?;
        let size = self.texture_size.unwrap_or(64) as usize;
        let sampling = TextureSampling { size, view, light: light.clone(), samples: 1 };
        let patch = kind.patch(1.0);
        let samples = patch.texture(&sampling, &mut |_, _| ()).map_err(|error| refused(error.to_string()))?;
        Ok(SurfaceTexture { name, samples, patch: Some(patch) })
    }
}

/// The kind of a named patch.
pub(super) fn patch_kind(source: &Path) -> Option<PatchKind> {
    source.to_str().and_then(|name| name.parse().ok())
}

/// Transfer with the model from which it was made.
pub(super) struct TransferOfModel {
    pub(super) file: BiScaleFile,
    pub(super) model: Model,
    pub(super) vertices: Vertices,
    /// The local directions of the transfer's rows.
    pub(super) light: LocalDirections,
}

impl TransferOfModel {
    pub(super) fn load(path: &Path, name: &Path, crease: Option<f64>) -> miette::Result<Self> {
        let file = load_bi_scale(path)?;
        let Some(meaning) = file.meaning else {
            let what = format!("{}: expected transfer of a mesh, found another matrix", path.display());
            return Err(Problem::usage(what, "name what `crossbar bi-scale precompute` wrote").into());
        };
        let model = load_creased(name, meaning.mesh.tangents, crease)?;
        let (vertices, _) = vertices_of(path, Some(meaning.mesh), &model)?;
        let light = LocalDirections::new(meaning.side as usize)
            .map_err(|error| Problem::usage(error.to_string(), "name another file"))?;
        Ok(Self { file, model, vertices, light })
    }
}
