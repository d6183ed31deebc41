//! Options of `crossbar prt card` for bi-scale transfer.

use clap::ValueEnum;
use refsim::texture::TexelFormat;

use super::texture_args::TextureArgs;
use super::textures::refuse;
use crate::bi_scale::kernels::BlockEdges;
use crate::bi_scale::on_card::{DisplayOptions, LightFormat, LocalFormat};
use crate::cli::Problem;

/// Options of bi-scale transfer.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Options of bi-scale transfer")]
pub(in crate::cli::prt) struct BiScaleCardArgs {
    #[command(flatten)]
    pub(super) textures: TextureArgs,

    /// Format of the volumes that hold textures: rgba8, of the largest sample, rgba16f or rgba32f [default: rgba8]
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
        let Self { textures, texture_format, blocks, light_format, local_format } = self;
        let own = [
            ("--texture-format", texture_format.is_some()),
            ("--blocks", blocks.is_some()),
            ("--light-format", light_format.is_some()),
            ("--local-format", local_format.is_some()),
        ];
        refuse(textures.given().chain(own))
    }

    /// Variants of the display.
    pub(super) fn options(&self) -> DisplayOptions {
        let local = match self.local_format {
            None | Some(HeldArg::Fp32) => LocalFormat::Fp32,
            Some(HeldArg::Fp16) => LocalFormat::Fp16,
            Some(HeldArg::Bytes) => LocalFormat::Bytes,
        };
        let touching = self.blocks == Some(BlocksArg::Touching);
        let edges = if touching { BlockEdges::Touching } else { BlockEdges::Wrapped };
        DisplayOptions { edges, texture: self.texture_format.unwrap_or(TexelFormat::Rgba8), local }
    }

    /// What the card holds light in.
    pub(super) fn light(&self) -> LightFormat {
        match self.light_format {
            None | Some(HeldArg::Fp32) => LightFormat::Fp32,
            Some(HeldArg::Fp16) => LightFormat::Fp16,
            Some(HeldArg::Bytes) => LightFormat::Bytes,
        }
    }
}
