//! `crossbar bi-scale render` and `card`: pictures of a model from its transfer and bidirectional textures, on the host
//! and on an emulated card.

use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use strum::VariantNames as _;

use super::file::angle;
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::file::{BiScaleFile, load_bi_scale};
use crate::bi_scale::on_card::corner_coordinates;
use crate::bi_scale::texture::{PatchKind, load_bidirectional_texture};
use crate::cli::model_name::Model;
use crate::cli::study::{StudyArgs, StudyFiles};
use crate::cli::transfer::model::{materials_of, model_of};
use crate::cli::transfer::picture::{OnCardArgs, PictureArgs};
use crate::cli::{Problem, given};
use crate::names::did_you_mean;
use crate::options::number;
use crate::scene::Material;
use crate::study::prt::{BiScaleOnCard, BiScaleRendering, SurfaceTexture, TexturedSurface};
use crate::transfer::Vertices;

/// Textures, the sampling of patches, and their placement.
#[derive(Debug, clap::Args)]
struct TextureArgs {
    /// The bidirectional texture of a material, or of all materials without their own texture: a file (.npy) as
    /// `crossbar bi-scale texture` writes it, or the name of a patch: bumps, mail, tiles, bricks, weave
    #[arg(long, required = true, value_name = "[MATERIAL=]B.npy")]
    texture: Vec<TextureArg>,

    /// Repetitions of a texture per unit of texture coordinates
    #[arg(long, value_name = "X", default_value_t = 1.0, value_parser = number::positive)]
    repeat: f64,

    /// Texels per side, for textures of named patches [default: 64]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(1..=1024))]
    texture_size: Option<u32>,

    /// View directions per side of the square, for textures of named patches [default: 12]
    #[arg(long, value_name = "K", value_parser = number::whole::<u8>(1..=64))]
    texture_views: Option<u8>,

    /// The crease angle in degrees, as given to `crossbar bi-scale precompute`
    #[arg(long, value_name = "DEGREES", value_parser = angle, allow_hyphen_values = true)]
    crease: Option<f64>,
}

/// A texture, and the material to which it belongs.
#[derive(Clone, Debug, PartialEq)]
struct TextureArg {
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
    fn patch(&self) -> Option<PatchKind> {
        self.source.to_str().and_then(|name| name.parse().ok())
    }
}

/// Transfer with the model from which it was made, and its textures.
struct TexturedTransfer {
    file: BiScaleFile,
    model: Model,
    vertices: Vertices,
    textures: Vec<SurfaceTexture>,
    /// Texture index per triangle.
    texture_of: Vec<u32>,
}

impl TextureArgs {
    fn load(&self, path: &Path, name: &Path) -> miette::Result<TexturedTransfer> {
        if self.texture.iter().all(|texture| texture.patch().is_none()) {
            let of_patches =
                [("--texture-size", self.texture_size.is_some()), ("--texture-views", self.texture_views.is_some())];
            let help = "remove the option: a file has its own size";
            given::refuse(of_patches, "textures of named patches, found texture files only", help)?;
        }
        let file = load_bi_scale(path)?;
        let Some(meaning) = file.meaning else {
            let what = format!("{}: expected transfer of a mesh, found a matrix without a mesh", path.display());
            return Err(Problem::usage(
                what,
                "give a file that `crossbar bi-scale precompute` wrote, or the biclusters of such a file",
            )
            .into());
        };
        let (model, vertices, _) = model_of(path, Some(meaning.mesh), name, self.crease)?;
        let light = LocalDirections::new(meaning.side as usize)?;
        let (materials, material_of) = materials_of(name, &model)?;
        let of_material = self.of_materials(&materials)?;
        let texture_of = material_of.iter().map(|&material| of_material[material as usize]).collect();
        let textures = self.texture.iter().map(|texture| self.texture(texture, &light)).collect::<Result<_, _>>()?;
        Ok(TexturedTransfer { file, model, vertices, textures, texture_of })
    }

    /// The files of the picture: transfer, textures, light and model.
    fn files<'a>(&'a self, out: &'a Path, transfer: &'a Path, picture: &'a PictureArgs) -> StudyFiles<'a> {
        let files = self.texture.iter().filter(|texture| texture.patch().is_none());
        let files = files.map(|texture| texture.source.as_path());
        StudyFiles::new(Some(out), picture.inputs([transfer].into_iter().chain(files)))
    }

    /// Index of the texture of each material.
    fn of_materials(&self, materials: &[Material]) -> Result<Vec<u32>, Problem> {
        for (at, TextureArg { material, .. }) in self.texture.iter().enumerate() {
            if self.texture[..at].iter().any(|before| before.material == *material) {
                let of = material.as_deref().map_or("all other materials".to_owned(), |name| format!("`{name}`"));
                return Err(Problem::usage(format!("expected one texture for {of}, found two"), "remove one of them"));
            }
            let names: Vec<&str> = materials.iter().map(|material| material.name.as_str()).collect();
            if let Some(name) = material.as_deref().filter(|name| !names.contains(name)) {
                let meant = did_you_mean(name, names.iter().copied());
                let what = format!("the model has no material `{name}`");
                return Err(Problem::usage(what, format!("{meant}the materials are {}", names.join(", "))));
            }
        }
        let of = |material: &Material| {
            let own = self.texture.iter().position(|texture| texture.material.as_ref() == Some(&material.name));
            let found = own.or_else(|| self.texture.iter().position(|texture| texture.material.is_none()));
            found.map(|at| at as u32).ok_or_else(|| {
                let what = format!("expected a texture for material `{}`, found none", material.name);
                Problem::usage(what, "add a texture for all materials: `--texture mail`, or `--texture B.npy`")
            })
        };
        materials.iter().map(of).collect()
    }

    /// A texture, read from its file, or sampled from a named patch in a transfer's local directions.
    fn texture(&self, texture: &TextureArg, light: &LocalDirections) -> miette::Result<SurfaceTexture> {
        let (name, source) = (texture.source.display().to_string(), &texture.source);
        let Some(kind) = texture.patch() else {
            given::require_file(source, "patch", PatchKind::VARIANTS, "npy")?;
            return Ok(SurfaceTexture { name, samples: load_bidirectional_texture(source)?, patch: None });
        };
        let view = LocalDirections::new(self.texture_views.unwrap_or(12).into())?;
        let size = self.texture_size.unwrap_or(64) as usize;
        let patch = kind.patch(1.0);
        let samples = patch.texture(size, &view, light, &mut |_, _| ()).map_err(|error| {
            Problem::usage(error.to_string(), "use a smaller `--texture-size` or `--texture-views`")
        })?;
        Ok(SurfaceTexture { name, samples, patch: Some(patch) })
    }
}

fn no_coordinates(model: &Path, error: impl Display) -> Problem {
    Problem::usage(format!("{}: {error}", model.display()), "give a model with texture coordinates (`vt`)")
}

const RENDER_EXAMPLES: &str = "\
Examples:
  crossbar bi-scale render docs/examples/court_biclusters.npz --model docs/examples/court.obj --texture floor=tiles --texture bricks --repeat 4 --texture-size 8 --texture-views 4 --size 64x48
      textures by material, under a clear sky with a sun
  crossbar bi-scale render docs/examples/court_biclusters.npz --model docs/examples/court.obj --texture tiles --repeat 4 --texture-size 8 --texture-views 4 --reference --size 8x6
      compared with a ray-traced picture, with the error by cause: takes milliseconds per pixel

Written to --out: index.html (self-contained), pictures, picture.exr. The host interpolates local light over \
triangles.";

/// Draw a model under distant light from its transfer and bidirectional textures
#[derive(Debug, clap::Args)]
#[command(after_help = RENDER_EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Render {
    /// A matrix or its biclusters, as `crossbar bi-scale precompute` or `bicluster` wrote them
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,

    #[command(flatten)]
    textures: TextureArgs,

    /// Also ray-trace the picture, and split the error by cause; takes milliseconds per pixel. All textures
    /// must be patches
    #[arg(long)]
    reference: bool,

    #[command(flatten)]
    picture: PictureArgs,

    /// Where to write pictures and the page
    #[arg(long, value_name = "DIR", default_value = "out/bi-scale")]
    out: PathBuf,
}

impl StudyArgs for Render {
    type Study = BiScaleRendering;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        self.textures.files(&self.out, &self.file, &self.picture)
    }

    fn study(&self) -> miette::Result<BiScaleRendering> {
        let name = &self.picture.model;
        let TexturedTransfer { file, model, vertices, textures, texture_of } = self.textures.load(&self.file, name)?;
        let view = self.picture.view(&model.mesh)?;
        let surface = TexturedSurface::new(model.mesh, vertices, texture_of, self.textures.repeat);
        let surface = surface.map_err(|error| no_coordinates(name, error))?;
        let light = self.picture.light.distant()?;
        Ok(BiScaleRendering { view, textures, surface, file, light, reference: self.reference })
    }
}

const CARD_EXAMPLES: &str = "\
Examples:
  crossbar bi-scale card docs/examples/court_biclusters.npz --model docs/examples/court.obj --texture tiles --texture-size 8 --texture-views 4 --repeat 4 --size 64x48
      on the GeForce GTX 280: light times biclusters, then the bidirectional texture, in several passes
  crossbar bi-scale card docs/examples/court_biclusters.npz --model docs/examples/court.obj --texture tiles --texture-size 8 --texture-views 4 --sweep --size 64x48
      the error of coarser light, local light, textures and targets, changed one at a time

Written to --out: index.html (self-contained), pictures, card.exr, timeline.json, blame.csv, with --sweep precision.csv. \
docs/papers/bi_scale.md explains these files.";

/// Draw a model under distant light on an emulated card, from biclusters and bidirectional textures
#[derive(Debug, clap::Args)]
#[command(after_help = CARD_EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Card {
    /// Biclusters, as `crossbar bi-scale bicluster` writes them
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,

    #[command(flatten)]
    textures: TextureArgs,

    #[command(flatten)]
    card: OnCardArgs,

    #[command(flatten)]
    picture: PictureArgs,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/bi-scale-card")]
    out: PathBuf,
}

impl StudyArgs for Card {
    type Study = BiScaleOnCard;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        self.textures.files(&self.out, &self.file, &self.picture)
    }

    fn study(&self) -> miette::Result<BiScaleOnCard> {
        let name = &self.picture.model;
        let TexturedTransfer { file, model, vertices, textures, texture_of } = self.textures.load(&self.file, name)?;
        let biclusters = file.biclusters.ok_or_else(|| {
            let what = format!("{}: expected biclusters, found a matrix only", self.file.display());
            Problem::usage(what, "run `crossbar bi-scale bicluster` to make biclusters")
        })?;
        let coordinates = corner_coordinates(&model.mesh, [self.textures.repeat as f32; 2])
            .map_err(|error| no_coordinates(name, error))?;
        Ok(BiScaleOnCard {
            card: self.card.setting("gt200")?,
            view: self.picture.view(&model.mesh)?,
            vertices,
            coordinates,
            biclusters,
            textures: textures.into_iter().map(|texture| texture.samples).collect(),
            texture_of,
            light: self.picture.light.distant()?,
        })
    }
}
