//! Options of `crossbar prt render` for bi-scale transfer.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use super::angle;
use crate::cli::{Problem, number, view};
use crate::names::did_you_mean;
use crate::prt::bi_scale::directions::LocalDirections;
use crate::prt::bi_scale::texture::{PatchKind, TextureSampling, load_bidirectional_texture};
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

    /// How often a texture repeats where texture coordinates grow by 1 [default: 1]
    #[arg(long, value_name = "X", value_parser = number::positive)]
    pub(super) repeat: Option<f64>,

    /// Texels along an edge of the textures of patches [default: 64]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    texture_size: Option<u32>,

    /// Directions of the view along an edge of the square, of the textures of patches [default: 12]
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u8).range(1..=64))]
    texture_views: Option<u8>,

    /// The crease angle in degrees, as given to `crossbar prt precompute`
    #[arg(long, value_name = "DEGREES", value_parser = angle, allow_hyphen_values = true)]
    pub(super) crease: Option<f64>,

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

impl TextureArg {
    fn kind(&self) -> Option<PatchKind> {
        self.source.to_str().and_then(|name| name.parse().ok())
    }
}

impl BiScaleRenderArgs {
    /// Refuses all of these for transfer of other kinds.
    pub(in crate::cli::prt) fn refuse(&self) -> Result<(), Problem> {
        let Self { texture, repeat, texture_size, texture_views, crease, reference } = self;
        let given = [repeat.is_some(), texture_size.is_some(), texture_views.is_some(), crease.is_some(), *reference];
        if texture.is_empty() && !given.contains(&true) {
            return Ok(());
        }
        let what = "`--texture`, `--repeat`, `--texture-size`, `--texture-views`, `--crease` and `--reference` are for \
                    bi-scale transfer, found transfer of another kind";
        Err(Problem::usage(what, "leave them out"))
    }

    /// Bytes of the samples of patches, and the same laid out for shading, with up to 16 x 16 directions of light.
    pub(super) fn bytes(&self) -> u64 {
        let patches = self.texture.iter().filter(|texture| texture.kind().is_some()).count() as u64;
        let samples = 2 * 12 * 256 * u64::from(self.views()).pow(2) * u64::from(self.size()).pow(2);
        patches.saturating_mul(samples)
    }

    fn views(&self) -> u8 {
        self.texture_views.unwrap_or(12)
    }

    fn size(&self) -> u32 {
        self.texture_size.unwrap_or(64)
    }

    /// The files of textures.
    pub(super) fn files(&self) -> impl Iterator<Item = &Path> {
        self.texture.iter().filter(|texture| texture.kind().is_none()).map(|texture| texture.source.as_path())
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
        let of = |texture: &TextureArg| {
            let name = texture.source.display().to_string();
            let Some(kind) = texture.kind() else {
                let path = &texture.source;
                if !path.exists() && !name.contains(['.', '/']) {
                    let names: Vec<String> = PatchKind::ALL.iter().map(PatchKind::to_string).collect();
                    let meant = did_you_mean(&name, names.iter().map(String::as_str));
                    let help = format!("{meant}there are {}; a file needs its ending", names.join(", "));
                    return Err(Problem::usage(format!("there is no patch `{name}`"), help).into());
                }
                view::require_file(path, 5, "name a smaller texture")?;
                return Ok(SurfaceTexture { name, samples: load_bidirectional_texture(path)?, patch: None });
            };
            let directions = LocalDirections::new(self.views().into());
            let refused = |error: String| Problem::usage(error, "see `crossbar prt render --help`");
            let view = directions.map_err(|error| refused(error.to_string()))?;
            let sampling = TextureSampling { size: self.size() as usize, view, light: light.clone(), samples: 1 };
            let patch = kind.patch(1.0);
            let samples = patch.texture(&sampling, &mut |_, _| ()).map_err(|error| refused(error.to_string()))?;
            Ok(SurfaceTexture { name, samples, patch: Some(patch) })
        };
        self.texture.iter().map(of).collect()
    }
}
