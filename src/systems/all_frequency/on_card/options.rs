//! Ways to draw all-frequency transfer.

use refsim::device::Profile;
use refsim::isa::Version;
use refsim::texture::{ChannelClass, TexelFormat};

use super::error::FactoredCardError;
use crate::all_frequency::kernels::{MapFilter, SetLayout, ViewNumbers};
use crate::card::{MeshError, require_versions};

/// Where step 4, G(v) . T_p, is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProductPlace {
    /// By the host for each vertex; the card interpolates colors. What the authors did.
    Vertices(VertexColors),
    /// By the card for each pixel. What they proposed. The one term of a diffuse surface does not depend on the view:
    /// then colors of vertices are the same, and are drawn.
    Pixels(ProductOptions),
}

/// What a vertex holds its color in.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::Display, strum::EnumIter)]
#[strum(serialize_all = "lowercase")]
pub enum VertexColors {
    /// Four bytes, as Direct3D's `D3DCOLOR`: fractions of 8 bits from 0 to 1. Runs on every card.
    #[default]
    Bytes,
    /// Three floats as texture coordinates, of any sign and size; needs ps_2_0.
    Floats,
}

/// Who computes the view of a vertex.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::Display, strum::EnumIter)]
#[strum(serialize_all = "lowercase")]
pub enum ViewMaker {
    /// The vertex program, from position, tangent and normal.
    #[default]
    Program,
    /// The host, in f64; the numbers are sent with those of transferred radiance.
    Host,
}

/// What a vertex holds transferred radiance in.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::Display, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum RadianceFormat {
    /// Single precision.
    #[default]
    Fp32,
    /// Half precision, the numbers of the view too where the host computes them.
    Fp16,
}

impl RadianceFormat {
    /// Bytes of a number.
    pub const fn bytes(self) -> usize {
        match self {
            Self::Fp32 => 4,
            Self::Fp16 => 2,
        }
    }
}

/// Variants of products per pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProductOptions {
    /// What is interpolated for the view.
    pub view: ViewNumbers,
    /// Who computes it at the vertices.
    pub view_maker: ViewMaker,
    /// Whether a pass draws one channel, so that fewer numbers are interpolated, or all three.
    pub is_pass_per_channel: bool,
    /// The format of the maps of G. Signed fractions are of the largest magnitude of each term; the factors are worked
    /// into T_p.
    pub map_format: TexelFormat,
    /// Who interpolates between their texels.
    pub filter: MapFilter,
    /// G is rounded to signed fractions of so many bits (2 to 24) before it is stored; `None`: by its format alone.
    pub map_bits: Option<u32>,
    /// What vertices hold T_p in.
    pub radiance: RadianceFormat,
    /// Whether the pixel program asks for the device's partial precision.
    pub is_partial: bool,
    /// The language of the vertex program; `None`: vs_2_0 where the device has it, else vs_1_1.
    pub vertex_version: Option<Version>,
}

impl Default for ProductOptions {
    fn default() -> Self {
        Self {
            view: ViewNumbers::default(),
            view_maker: ViewMaker::default(),
            is_pass_per_channel: false,
            map_format: TexelFormat::Rgba16Snorm,
            filter: MapFilter::default(),
            map_bits: None,
            radiance: RadianceFormat::default(),
            is_partial: false,
            vertex_version: None,
        }
    }
}

impl ProductOptions {
    /// Terms in a texel.
    pub(super) fn terms_per_texel(&self) -> usize {
        usize::from(self.map_format.record().channel_count)
    }

    /// The places of so many terms.
    pub fn layout(&self, terms: usize) -> SetLayout {
        SetLayout { terms, channels: if self.is_pass_per_channel { 1 } else { 3 }, view: self.view }
    }

    /// Refuses what a device has no room for.
    pub(super) fn check(&self, profile: &Profile, terms: usize) -> Result<(), FactoredCardError> {
        require_versions(profile, &[Version::Ps2_0], "the product per pixel")?;
        if let Some(found) = self.map_bits.filter(|bits| !(2..=24).contains(bits)) {
            return Err(MeshError::Figure { what: "2 to 24 bits of G", found: found.into() }.into());
        }
        let (device, format, record) = (profile.name.clone(), self.map_format, self.map_format.record());
        let holds = |class| matches!(class, ChannelClass::Snorm | ChannelClass::Float(_));
        if ![2, 4].contains(&record.channel_count) || !record.stored().iter().all(|channel| holds(channel.class)) {
            return Err(FactoredCardError::MapFormat { found: format });
        }
        let by_program = self.filter == MapFilter::Program;
        match record.is_float() {
            _ if by_program && record.channel_count == 2 => return Err(FactoredCardError::TwoTerms { found: format }),
            true if !profile.limits.float_mipmaps => return Err(FactoredCardError::FloatRectangles { device, format }),
            true if !by_program && !profile.limits.float_filtering => {
                return Err(FactoredCardError::FloatFilter { device, format });
            }
            _ => {}
        }
        let layout = self.layout(terms);
        let found = profile.limits.texture_coordinates.map_or(8, |limit| limit as usize).min(8);
        if layout.sets() > found {
            let (channels, view, needed) = (layout.channels, layout.view.count(), layout.sets());
            return Err(FactoredCardError::Coordinates { terms, channels, view, needed, device, found });
        }
        let found = profile.limits.samplers.map_or(16, |limit| limit as usize).min(16);
        let needed = terms.div_ceil(self.terms_per_texel());
        if needed > found {
            return Err(FactoredCardError::Samplers { terms, format, needed, device, found });
        }
        Ok(())
    }
}
