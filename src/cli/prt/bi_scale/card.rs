//! `crossbar prt card` of bi-scale transfer.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use refsim::texture::TexelFormat;

use super::textures::{PatchArgs, TransferOfModel, no_texture, patch_kind, refuse};
use crate::cli::Problem;
use crate::cli::memory::MemoryNeed;
use crate::cli::model_name;
use crate::cli::prt::card;
use crate::cli::study::StudyArgs;
use crate::prt::bi_scale::kernels::BlockEdges;
use crate::prt::bi_scale::on_card::{DisplayOptions, LightFormat, LocalFormat, corner_coordinates};
use crate::study::prt::BiScaleOnCard;

/// Options of bi-scale transfer.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Options of bi-scale transfer")]
pub(in crate::cli::prt) struct BiScaleCardArgs {
    /// The bidirectional texture: a file (.npy) that `crossbar prt texture` wrote or one like it, or a patch: bumps,
    /// mail, tiles, bricks, weave
    #[arg(long, value_name = "B.npy")]
    texture: Option<PathBuf>,

    #[command(flatten)]
    patches: PatchArgs,

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
        let Self { texture, patches, texture_format, blocks, light_format, local_format } = self;
        let own = [
            ("--texture", texture.is_some()),
            ("--texture-format", texture_format.is_some()),
            ("--blocks", blocks.is_some()),
            ("--light-format", light_format.is_some()),
            ("--local-format", local_format.is_some()),
        ];
        refuse(own.into_iter().chain(patches.given()))
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
        let texture = self.0.bi_scale.texture.as_deref().filter(|source| patch_kind(source).is_none());
        [self.0.file()].into_iter().chain(model).chain(self.0.light.file()).chain(texture).collect()
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        let pictures = self.0.pictures();
        let bytes = pictures.bytes.saturating_add(self.0.bi_scale.patches.bytes());
        Ok(Some(MemoryNeed { bytes, help: "ask for a smaller `--size` or `--texture-size`", ..pictures }))
    }

    fn study(&self) -> miette::Result<BiScaleOnCard> {
        self.0.refuse_others()?;
        let card::Args { model: name, light, card, target_format, bi_scale, .. } = self.0;
        let source = bi_scale.texture.as_deref().ok_or_else(no_texture)?;
        let TransferOfModel { file, model, vertices, light: directions } =
            TransferOfModel::load(self.0.file(), name, bi_scale.patches.crease())?;
        let Some(biclusters) = file.biclusters else {
            let what = format!("{}: expected biclusters, found a matrix alone", self.0.file().display());
            return Err(Problem::usage(what, "`crossbar prt bicluster` makes them").into());
        };
        let repeat = bi_scale.patches.repeat() as f32;
        let coordinates = corner_coordinates(&model.mesh, [repeat; 2]).map_err(|error| {
            Problem::usage(format!("{}: {error}", name.display()), "name a model with texture coordinates (`vt`)")
        })?;
        Ok(BiScaleOnCard {
            model: name.display().to_string(),
            camera: self.0.eye.framing(&model.mesh, self.0.size)?,
            vertices,
            coordinates,
            biclusters,
            texture: bi_scale.patches.texture(source, &directions)?.samples,
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
