//! Number formats of light, local light and bidirectional textures on the card.

use refsim::texture::TexelFormat;

use crate::bi_scale::kernels::BlockEdges;
use crate::card::through_half;

/// Format of light: as texels before it is multiplied, and as local light in vertices.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::Display, strum::EnumIter)]
#[strum(serialize_all = "lowercase")]
pub enum LightFormat {
    /// 8-bit fractions of the largest number.
    Bytes,
    /// Half precision; in texels as fractions of the largest number.
    Fp16,
    /// Single precision: the same bits as the host's sums.
    #[default]
    Fp32,
}

impl LightFormat {
    /// The texel format.
    pub const fn texels(self) -> TexelFormat {
        match self {
            Self::Bytes => TexelFormat::Rgba8,
            Self::Fp16 => TexelFormat::Rgba16f,
            Self::Fp32 => TexelFormat::Rgba32f,
        }
    }

    /// The divisor of numbers whose largest magnitude is `largest`.
    pub(super) fn scale(self, largest: f32) -> f32 {
        if self == Self::Fp32 || largest == 0.0 { 1.0 } else { largest }
    }

    /// Rounds a number to the format, for a frame whose largest number is `largest`.
    pub(super) fn rounded(self, value: f64, largest: f64) -> f32 {
        match self {
            Self::Fp32 => value as f32,
            Self::Fp16 => through_half(value as f32),
            Self::Bytes if largest > 0.0 => ((value / largest * 255.0).round_ties_even() / 255.0 * largest) as f32,
            Self::Bytes => 0.0,
        }
    }
}

/// Options of the display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DisplayOptions {
    /// Borders between the blocks of the volume.
    pub edges: BlockEdges,
    /// Texel format of the volume: `rgba8`, scaled by the largest sample, `rgba16f` or `rgba32f`.
    pub texture: TexelFormat,
    /// Format of local light in vertices.
    pub local: LightFormat,
}

impl Default for DisplayOptions {
    fn default() -> Self {
        Self { edges: BlockEdges::default(), texture: TexelFormat::Rgba8, local: LightFormat::default() }
    }
}
