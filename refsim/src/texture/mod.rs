//! Textures: texel formats, images, addressing, filtering.
//!
//! Everything here is a definition in integers: the exact value of a texel, an exact weighted sum of them where the
//! texels are integers, and one rounding into the register format. Batch executors compute the same bits by other
//! means and are compared with this. docs/numbers.md, "Texels", has the rules in prose.

mod address;
mod error;
mod format;
pub(crate) mod image;
mod lod;
mod sample;
mod texel;
pub(crate) mod value;

pub use address::{AddressMode, CubeFace, cube_coordinates, linear_taps, nearest_index, project};
pub use error::TextureError;
pub use format::{Channel, ChannelClass, ComponentSource, FormatRecord, TexelFormat};
pub use image::{Image, Level, Region, TextureKind};
pub use lod::{Lod, lod_from_derivatives};
pub use sample::{Filter, MipFilter, SampleRules, SamplerState, fetch_nearest, nearest_texel, sample, unbound};
pub use texel::{ChannelValue, Texel, decode, decode_channel, encode, encode_channel};

/// What the smallest value of a signed normalised channel means (`signed-texel-minimum`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SignedTexelMinimum {
    /// -1, as Direct3D 10 and later define it.
    #[default]
    Clamp,
    /// The fraction as it stands: -128/127 for 8 bits. R200 decodes so (a comment of Wine's d3d9 test).
    BelowMinusOne,
}

/// How a value becomes the integer of a normalised target or depth buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TargetRounding {
    /// To the nearest integer, halves up (away from zero for signed channels): `floor(x + 0.5)`.
    #[default]
    Nearest,
    /// Toward zero.
    Truncate,
}
