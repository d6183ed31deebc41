//! Inputs of a pixel program other than its fragment: constants, textures, stage state.

use super::Constants;
use crate::event::SAMPLERS;
use crate::texture::{Image, MipFilter, SamplerState};

/// Number of texture stages with bump state (ps_1_x).
pub const BUMP_STAGES: usize = 8;

/// A texture bound to a sampler.
#[derive(Clone, Copy, Debug)]
pub struct SamplerBinding<'a> {
    /// The texture.
    pub image: &'a Image,
    /// Sampler state.
    pub state: SamplerState,
}

impl SamplerBinding<'_> {
    /// Returns `true` if a read can depend on the level of detail; otherwise executors don't compute it.
    pub fn needs_detail(&self) -> bool {
        let levels = self.state.mip != MipFilter::None && self.image.levels().len() > 1;
        levels || self.state.min != self.state.mag
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

/// Texture projection of a stage (`D3DTTFF_PROJECTED`): `tex`, `texbem` and `texbeml` first divide the coordinates, in
/// single precision. ps_1_4 uses `_dz` and `_dw` instead, and ps_2_0 uses `texldp`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Projection {
    /// No division.
    #[default]
    #[serde(skip)]
    None,
    /// The first two components are divided by the third (`D3DTTFF_COUNT3`).
    Z,
    /// The first three components are divided by the fourth (`D3DTTFF_COUNT4`).
    W,
}

/// All inputs of a pixel program other than its fragment.
#[derive(Clone, Copy, Debug)]
pub struct PixelBindings<'a> {
    /// Constants set by the host.
    pub constants: &'a Constants,
    /// Textures; an unbound sampler reads (0, 0, 0, 1).
    pub samplers: [Option<SamplerBinding<'a>>; SAMPLERS],
    /// Bump state of the stages.
    pub bump: [BumpStage; BUMP_STAGES],
    /// Texture projection of the stages.
    pub projections: [Projection; BUMP_STAGES],
}

impl<'a> PixelBindings<'a> {
    /// Bindings with constants only: no textures, no bump state.
    pub fn new(constants: &'a Constants) -> Self {
        Self {
            constants,
            samplers: [None; SAMPLERS],
            bump: [BumpStage::default(); BUMP_STAGES],
            projections: [Projection::None; BUMP_STAGES],
        }
    }
}
