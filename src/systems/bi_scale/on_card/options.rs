//! Ways to hold the numbers of a frame.

use refsim::texture::TexelFormat;

use crate::bi_scale::kernels::BlockEdges;
use crate::card::through_half;

/// What the card holds light in, before it is multiplied.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::Display, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum LightFormat {
    /// Fractions of 8 bits of the largest number.
    Bytes,
    /// Half precision, as fractions of the largest number.
    Fp16,
    /// Single precision: the same bits as the host's sums.
    #[default]
    Fp32,
}

impl LightFormat {
    /// The texels.
    pub const fn texels(self) -> TexelFormat {
        match self {
            Self::Bytes => TexelFormat::Rgba8,
            Self::Fp16 => TexelFormat::Rgba16f,
            Self::Fp32 => TexelFormat::Rgba32f,
        }
    }

    /// What numbers are divided by, of which this is the largest.
    pub(super) fn scale(self, largest: f32) -> f32 {
        if self == Self::Fp32 || largest == 0.0 { 1.0 } else { largest }
    }
}

/// What vertices hold local light in.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::Display, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum LocalFormat {
    /// Fractions of 8 bits of the frame's largest number.
    Bytes,
    /// Half precision.
    Fp16,
    /// Single precision.
    #[default]
    Fp32,
}

impl LocalFormat {
    /// A number as the format holds it, where this is the largest of the frame.
    pub(super) fn rounded(self, value: f64, largest: f64) -> f32 {
        match self {
            Self::Fp32 => value as f32,
            Self::Fp16 => through_half(value as f32),
            Self::Bytes if largest > 0.0 => ((value / largest * 255.0).round_ties_even() / 255.0 * largest) as f32,
            Self::Bytes => 0.0,
        }
    }

    /// Bytes of a number.
    pub const fn bytes(self) -> usize {
        match self {
            Self::Bytes => 1,
            Self::Fp16 => 2,
            Self::Fp32 => 4,
        }
    }
}

/// Variants of the display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DisplayOptions {
    /// How the blocks of the volume meet.
    pub edges: BlockEdges,
    /// What it holds samples in: `rgba8`, of the largest sample, `rgba16f` or `rgba32f`.
    pub texture: TexelFormat,
    /// What vertices hold local light in.
    pub local: LocalFormat,
}

impl Default for DisplayOptions {
    fn default() -> Self {
        Self { edges: BlockEdges::default(), texture: TexelFormat::Rgba8, local: LocalFormat::default() }
    }
}
