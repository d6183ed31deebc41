//! What a pixel program is run with: constants, textures, stage state.

use super::Constants;
use crate::event::SAMPLERS;
use crate::texture::{Filter, Image, MipFilter, SamplerState};

/// Texture stages with bump state (ps_1_x).
pub const BUMP_STAGES: usize = 8;

/// A texture bound to a sampler.
#[derive(Clone, Copy, Debug)]
pub struct SamplerBinding<'a> {
    /// The texture.
    pub image: &'a Image,
    /// How it is sampled.
    pub state: SamplerState,
}

impl SamplerBinding<'_> {
    /// Whether a read's result can depend on the level of detail; if not, executors need not compute it.
    pub fn needs_detail(&self) -> bool {
        let levels = self.state.mip != MipFilter::None && self.image.levels().len() > 1;
        levels || self.state.min != self.state.mag
    }

    /// Whether every read takes the nearest texel of level 0, so that [`crate::texture::fetch_nearest`] serves.
    pub fn is_plain(&self) -> bool {
        let nearest = self.state.min == Filter::Nearest && self.state.mag == Filter::Nearest;
        let single =
            self.image.levels().len() == 1 || (self.state.mip == MipFilter::None && self.state.max_mip_level == 0);
        nearest && single
    }
}

/// Bump mapping state of a texture stage, single precision patterns (`D3DTSS_BUMPENV*`). All zero by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BumpStage {
    /// `M00 M01 M10 M11`
    pub matrix: [u32; 4],
    /// Luminance scale of `texbeml`.
    pub luminance_scale: u32,
    /// Luminance offset of `texbeml`.
    pub luminance_offset: u32,
}

/// Projected textures of a texture stage (`D3DTTFF_PROJECTED`): what `tex`, `texbem` and `texbeml` divide the
/// coordinates of their stage by before anything else, in single precision. ps_1_4 has `_dz` and `_dw` instead,
/// ps_2_0 `texldp`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Projection {
    /// Nothing.
    #[default]
    #[serde(skip)]
    None,
    /// The third (`D3DTTFF_COUNT3`): the first two are divided.
    Z,
    /// The fourth (`D3DTTFF_COUNT4`): the first three are divided.
    W,
}

/// Everything that a pixel program reads besides its fragment.
#[derive(Clone, Copy, Debug)]
pub struct PixelBindings<'a> {
    /// Constants set by the host.
    pub constants: &'a Constants,
    /// Textures; an unbound sampler reads as (0, 0, 0, 1).
    pub samplers: [Option<SamplerBinding<'a>>; SAMPLERS],
    /// Bump state of the stages.
    pub bump: [BumpStage; BUMP_STAGES],
    /// Projected textures of the stages.
    pub projections: [Projection; BUMP_STAGES],
}

impl<'a> PixelBindings<'a> {
    /// Constants alone: no textures, no bump state.
    pub fn new(constants: &'a Constants) -> Self {
        Self {
            constants,
            samplers: [None; SAMPLERS],
            bump: [BumpStage::default(); BUMP_STAGES],
            projections: [Projection::None; BUMP_STAGES],
        }
    }
}
