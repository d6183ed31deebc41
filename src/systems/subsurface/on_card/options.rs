//! Options of the passes: formats, stages, precision.

use refsim::texture::TexelFormat;

use crate::card::CardError;

/// The float format of a texture or target.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum FloatTexels {
    /// Half precision: four floats per texel.
    Fp16,
    /// Single precision: four floats per texel.
    #[default]
    Fp32,
}

impl FloatTexels {
    /// The texel format.
    pub fn format(self) -> TexelFormat {
        match self {
            Self::Fp16 => TexelFormat::Rgba16f,
            Self::Fp32 => TexelFormat::Rgba32f,
        }
    }

    /// The largest number, and the name of the format.
    pub(super) fn largest(self) -> (f32, &'static str) {
        match self {
            Self::Fp16 => (65504.0, "fp16"),
            Self::Fp32 => (f32::MAX, "fp32"),
        }
    }
}

/// The format of the radiosity map.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum MapFormat {
    /// 8 bits per channel, with levels that the card generates.
    Unorm8 {
        /// Factor that scales irradiance to [0, 1]; larger values are clamped.
        scale: f64,
    },
    /// Half floats in a rectangle, with levels computed by passes.
    Fp16,
    /// Single floats in a rectangle, with levels computed by passes.
    #[default]
    Fp32,
}

impl MapFormat {
    /// The texel format.
    pub fn format(self) -> TexelFormat {
        match self {
            Self::Unorm8 { .. } => TexelFormat::Bgra8,
            Self::Fp16 => TexelFormat::Rgba16f,
            Self::Fp32 => TexelFormat::Rgba32f,
        }
    }

    /// The largest value of the map.
    pub fn largest(self) -> f32 {
        match self {
            Self::Unorm8 { .. } => 1.0,
            Self::Fp16 => 65504.0,
            Self::Fp32 => f32::MAX,
        }
    }

    /// The map value that represents 1.
    pub fn scale(self) -> f64 {
        match self {
            Self::Unorm8 { scale } => scale,
            Self::Fp16 | Self::Fp32 => 1.0,
        }
    }

    /// Returns `true` if the map has levels and filters.
    pub(super) fn is_leveled(self) -> bool {
        matches!(self, Self::Unorm8 { .. })
    }
}

/// The stage of pass 1 that computes light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::EnumIter, strum::EnumMessage)]
pub enum LightStage {
    /// At the vertices of each face's rectangle, interpolated.
    #[default]
    #[strum(to_string = "vertex")]
    Vertices,
    /// At each texel, from a geometry image and a normal map.
    #[strum(to_string = "fragment")]
    Texels,
}

/// The options of the three passes, fixed for all frames.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SubsurfaceCardOptions {
    /// The stage of pass 1 that computes light.
    pub light: LightStage,
    /// Format of the radiosity map.
    pub map: MapFormat,
    /// Format of the textures of links.
    pub links: FloatTexels,
    /// Format of the scattered irradiance, which pass 2 writes.
    pub scattered: FloatTexels,
    /// True if pass 2 computes in half precision, except places in a rectangle.
    pub half: bool,
    /// Number of link textures that are tiles along an edge of one larger texture; `None` for separate textures.
    pub tiles: Option<u32>,
}

impl SubsurfaceCardOptions {
    /// Textures of links along an edge of one texture on the card.
    pub(super) fn tiles_per_edge(&self) -> usize {
        self.tiles.unwrap_or(1) as usize
    }

    pub(super) fn check(&self) -> Result<(), CardError> {
        let scale = self.map.scale();
        if self.tiles == Some(0) {
            return Err(CardError::figure("a number of tiles above 0", 0));
        }
        if scale.is_finite() && scale > 0.0 && (scale as f32).is_normal() {
            return Ok(());
        }
        Err(CardError::figure("a scale of the 8-bit map above 0", scale))
    }
}
