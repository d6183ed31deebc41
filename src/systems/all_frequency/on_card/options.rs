//! Options of drawing all-frequency transfer.

use refsim::device::Profile;
use refsim::isa::Version;
use refsim::texture::{ChannelClass, TexelFormat};

use crate::all_frequency::kernels::{MapFilter, SetLayout, ViewNumbers};
use crate::card::{CardError, require_versions, signed_format};

/// The place of step 4, G(v) . T_p.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProductPlace {
    /// The host multiplies at each vertex, and the card interpolates colors: the authors' implementation.
    Vertices(VertexColors),
    /// The card multiplies at each pixel: the authors' proposal. A diffuse surface has one term that does not depend on
    /// the view, so vertex colors are drawn instead; the picture is identical.
    Pixels(ProductOptions),
}

/// The format of vertex colors.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum VertexColors {
    /// Four bytes, as in Direct3D's `D3DCOLOR`: 8-bit fractions in [0, 1]. Every card supports them.
    #[default]
    Bytes,
    /// Three floats as texture coordinates, of any sign and magnitude; needs ps_2_0.
    Floats,
}

/// The format of transferred radiance in vertices.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum RadianceFormat {
    /// Single precision.
    #[default]
    Fp32,
    /// Half precision.
    Fp16,
}

impl RadianceFormat {
    /// Bytes per number.
    pub const fn bytes(self) -> usize {
        match self {
            Self::Fp32 => 4,
            Self::Fp16 => 2,
        }
    }
}

/// Options of products per pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProductOptions {
    /// The representation of the view that is interpolated.
    pub view: ViewNumbers,
    /// True if a pass draws one channel, with fewer interpolated numbers; otherwise it draws all three.
    pub is_pass_per_channel: bool,
    /// The format of the maps of G. Signed fractions are relative to the largest magnitude of each term; T_p is
    /// multiplied by these magnitudes.
    pub map_format: TexelFormat,
    /// The interpolation between texels of G.
    pub filter: MapFilter,
    /// The number of bits (2 to 24) of signed fractions to which G is rounded before it is stored; `None`: G is rounded
    /// only to its format.
    pub map_bits: Option<u32>,
    /// The format of T_p in vertices.
    pub radiance: RadianceFormat,
    /// True if the pixel program requests the device's partial precision.
    pub is_partial: bool,
}

impl Default for ProductOptions {
    fn default() -> Self {
        Self {
            view: ViewNumbers::default(),
            is_pass_per_channel: false,
            map_format: TexelFormat::Rgba16Snorm,
            filter: MapFilter::default(),
            map_bits: None,
            radiance: RadianceFormat::default(),
            is_partial: false,
        }
    }
}

impl ProductOptions {
    /// The default options, with maps in signed 16 bits if a device has them, otherwise in 8 bits.
    pub fn of(profile: &Profile) -> Self {
        let map_format = signed_format(profile, &[TexelFormat::Rgba16Snorm, TexelFormat::Rg16Snorm]);
        Self { map_format, ..Self::default() }
    }

    pub(super) fn terms_per_texel(&self) -> usize {
        usize::from(self.map_format.record().channel_count)
    }

    /// The layout of `terms` terms.
    pub fn layout(&self, terms: usize) -> SetLayout {
        SetLayout { terms, channels: if self.is_pass_per_channel { 1 } else { 3 }, view: self.view }
    }

    pub(super) fn check(&self, profile: &Profile, terms: usize) -> Result<(), CardError> {
        require_versions(profile, &[Version::Ps2_0], "the product per pixel")?;
        if let Some(found) = self.map_bits.filter(|bits| !(2..=24).contains(bits)) {
            return Err(CardError::figure("2 to 24 bits of G", found));
        }
        let (device, format, record) = (&profile.name, self.map_format, self.map_format.record());
        let refused = |sentence: String| Err(CardError::Input(sentence));
        let holds = |class| matches!(class, ChannelClass::Snorm | ChannelClass::Float(_));
        if ![2, 4].contains(&record.channel_count) || !record.stored().iter().all(|channel| holds(channel.class)) {
            return refused(format!(
                "expected maps in floats or signed fractions of two or four components, found {format}"
            ));
        }
        let by_program = self.filter == MapFilter::Program;
        match record.is_float() {
            _ if by_program && record.channel_count == 2 => {
                return refused(format!(
                    "maps of two terms per texel are filtered by the sampler alone, found {format} filtered by the \
                     program"
                ));
            }
            true if !profile.limits.float_mipmaps => {
                return refused(format!(
                    "`{device}` has {format} textures as rectangles only (limits.float_mipmaps), which ps_2_0 cannot \
                     address; store G in signed fractions"
                ));
            }
            true if !by_program && !profile.limits.float_filtering => {
                return refused(format!(
                    "`{device}` does not filter {format} textures (limits.float_filtering); filter in the program, or \
                     store G in signed fractions"
                ));
            }
            _ => {}
        }
        let layout = self.layout(terms);
        let found = profile.limits.texture_coordinates.map_or(8, |limit| limit as usize).min(8);
        if layout.sets() > found {
            let (channels, view, needed) = (layout.channels, layout.view.count(), layout.sets());
            return refused(format!(
                "{terms} terms of {channels} channels and {view} numbers of the view need {needed} sets of texture \
                 coordinates; `{device}` has {found} (limits.texture_coordinates); draw one channel per pass, or use \
                 fewer terms"
            ));
        }
        check_samplers(profile, terms, format, terms.div_ceil(self.terms_per_texel()))
    }
}

/// Rejects more textures than the device has samplers.
fn check_samplers(profile: &Profile, terms: usize, format: TexelFormat, needed: usize) -> Result<(), CardError> {
    let (device, found) = (&profile.name, profile.limits.samplers.map_or(16, |limit| limit as usize).min(16));
    if needed <= found {
        return Ok(());
    }
    Err(CardError::input(format!(
        "{terms} terms in {format} need {needed} textures; `{device}` has {found} samplers (limits.samplers)"
    )))
}
