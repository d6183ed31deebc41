//! `crossbar prt card` of bi-scale transfer.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use refsim::texture::TexelFormat;

use crate::cli::memory::MemoryNeed;
use crate::cli::model_name;
use crate::cli::prt::card;
use crate::cli::prt::model::{load as load_model, vertices};
use crate::cli::study::StudyArgs;
use crate::cli::{Problem, number, view};
use crate::prt::bi_scale::directions::LocalDirections;
use crate::prt::bi_scale::kernels::BlockEdges;
use crate::prt::bi_scale::on_card::{DisplayOptions, LightFormat, LocalFormat, corner_coordinates};
use crate::prt::bi_scale::texture::{BidirectionalTexture, PatchKind, TextureSampling, load_bidirectional_texture};
use crate::prt::file::{MeshDigest, PrtFileError, load_bi_scale};
use crate::study::prt::BiScaleOnCard;

/// Options of bi-scale transfer.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Options of bi-scale transfer")]
pub(in crate::cli::prt) struct BiScaleCardArgs {
    /// The bidirectional texture: a file (.npy) that `crossbar prt texture` wrote or one like it, or a patch: bumps,
    /// mail, tiles, bricks, weave
    #[arg(long, value_name = "B.npy")]
    texture: Option<PathBuf>,

    /// Texels along an edge of the texture of a patch [default: 64]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    texture_size: Option<u32>,

    /// Directions of the view along an edge of the square, of the texture of a patch [default: 12]
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u8).range(1..=64))]
    texture_views: Option<u8>,

    /// How often the texture repeats where texture coordinates grow by 1 [default: 1]
    #[arg(long, value_name = "X", value_parser = number::positive)]
    repeat: Option<f64>,

    /// Format of the volume that holds it: rgba8, of the largest sample, rgba16f or rgba32f [default: rgba8]
    #[arg(long, value_name = "F")]
    texture_format: Option<TexelFormat>,

    /// How the volume's blocks meet [default: wrapped]
    #[arg(long, value_enum, value_name = "EDGES")]
    blocks: Option<BlocksArg>,

    /// What the card holds light in [default: fp32]
    #[arg(long, value_enum, value_name = "F")]
    light_format: Option<HeldArg>,

    /// What vertices hold local light in [default: fp32]
    #[arg(long, value_enum, value_name = "F")]
    local_format: Option<HeldArg>,
}

/// How blocks meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum BlocksArg {
    /// A texel around each repeats the opposite edge: the patch has no seam
    Wrapped,
    /// As in the paper's Figure 4, with a seam
    Touching,
}

/// What numbers are held in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum HeldArg {
    /// Fractions of 8 bits of the largest number
    Bytes,
    /// Half precision
    Fp16,
    /// Single precision
    Fp32,
}

impl BiScaleCardArgs {
    /// Refuses all of these for transfer of other kinds.
    pub(in crate::cli::prt) fn refuse(&self) -> Result<(), Problem> {
        let Self { texture, texture_size, texture_views, repeat, texture_format, blocks, light_format, local_format } =
            self;
        let given = [
            ("--texture", texture.is_some()),
            ("--texture-size", texture_size.is_some()),
            ("--texture-views", texture_views.is_some()),
            ("--repeat", repeat.is_some()),
            ("--texture-format", texture_format.is_some()),
            ("--blocks", blocks.is_some()),
            ("--light-format", light_format.is_some()),
            ("--local-format", local_format.is_some()),
        ];
        match given.into_iter().find(|(_, given)| *given) {
            Some((option, _)) => {
                let what = format!("`{option}` is for bi-scale transfer, found transfer of another kind");
                Err(Problem::usage(what, "leave it out"))
            }
            None => Ok(()),
        }
    }

    fn options(&self) -> DisplayOptions {
        let local = match self.local_format {
            None | Some(HeldArg::Fp32) => LocalFormat::Fp32,
            Some(HeldArg::Fp16) => LocalFormat::Fp16,
            Some(HeldArg::Bytes) => LocalFormat::Bytes,
        };
        let touching = self.blocks == Some(BlocksArg::Touching);
        let edges = if touching { BlockEdges::Touching } else { BlockEdges::Wrapped };
        DisplayOptions { edges, texture: self.texture_format.unwrap_or(TexelFormat::Rgba8), local }
    }

    fn kind(&self) -> Option<PatchKind> {
        self.texture.as_ref()?.to_str()?.parse().ok()
    }

    /// The texture, for so many directions of light along an edge.
    fn samples(&self, side: usize) -> miette::Result<BidirectionalTexture> {
        let refused = |error: &dyn Display| Problem::usage(error.to_string(), "see `crossbar prt card --help`");
        let Some(kind) = self.kind() else {
            let Some(path) = &self.texture else {
                let what = "bi-scale transfer is drawn with a bidirectional texture, found none";
                return Err(Problem::usage(what, "name one: `--texture mail`, or `--texture B.npy`").into());
            };
            view::require_file(path, 8, "name a smaller texture")?;
            return Ok(load_bidirectional_texture(path)?);
        };
        let directions = |side: usize| LocalDirections::new(side).map_err(|error| refused(&error));
        let view = directions(self.texture_views.unwrap_or(12).into())?;
        let (size, light) = (self.texture_size.unwrap_or(64) as usize, directions(side)?);
        let sampling = TextureSampling { size, view, light, samples: 1 };
        let texture = kind.patch(1.0).texture(&sampling, &mut |_, _| ());
        Ok(texture.map_err(|error| refused(&error))?)
    }

    fn light(&self) -> LightFormat {
        match self.light_format {
            None | Some(HeldArg::Fp32) => LightFormat::Fp32,
            Some(HeldArg::Fp16) => LightFormat::Fp16,
            Some(HeldArg::Bytes) => LightFormat::Bytes,
        }
    }
}

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
        let model = model_name::named_file(&self.0.model);
        let texture = self.0.bi_scale.texture.as_deref().filter(|_| self.0.bi_scale.kind().is_none());
        [self.0.file()].into_iter().chain(model).chain(self.0.light.file()).chain(texture).collect()
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        Ok(Some(self.0.pictures()))
    }

    fn study(&self) -> miette::Result<BiScaleOnCard> {
        self.0.refuse_others()?;
        let card::Args { model: name, light, card, target_format, bi_scale, .. } = self.0;
        let path = self.0.file();
        view::require_file(path, 6, "name a smaller file")?;
        let file = load_bi_scale(path)?;
        let Some(meaning) = file.meaning else {
            let what = format!("{}: expected transfer of a mesh, found a matrix of something else", path.display());
            return Err(Problem::usage(what, "name what `crossbar prt bicluster` made of transfer").into());
        };
        let Some(biclusters) = file.biclusters else {
            let what = format!("{}: expected biclusters, found a matrix alone", path.display());
            return Err(Problem::usage(what, "`crossbar prt bicluster` makes them").into());
        };
        let model = load_model(name, meaning.mesh.tangents)?;
        let vertices = vertices(&model, meaning.mesh.tangents)?;
        let (expected, found) = (MeshDigest::new(&vertices), Some(meaning.mesh));
        if found != Some(expected) {
            return Err(PrtFileError::OtherMesh { path: path.into(), expected, found }.into());
        }
        let repeat = bi_scale.repeat.unwrap_or(1.0) as f32;
        let coordinates = corner_coordinates(&model.mesh, [repeat; 2]).map_err(|error| {
            Problem::usage(format!("{}: {error}", name.display()), "name a model with texture coordinates (`vt`)")
        })?;
        Ok(BiScaleOnCard {
            model: name.display().to_string(),
            camera: self.0.eye.framing(&model.mesh, self.0.size)?,
            vertices,
            coordinates,
            biclusters,
            texture: bi_scale.samples(meaning.side as usize)?,
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
