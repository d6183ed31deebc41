//! Textures: texel formats, images, addressing and filtering.
//!
//! Everything here is defined in integers: the exact value of a texel, an exact weighted sum (for fixed-point texels),
//! and one rounding to the register format. Batch executors compute the same bits by other means, and are tested
//! against this module. The rules are in docs/numbers.md, "Texels".

mod address;
mod error;
pub(crate) mod image;
mod kind;
mod layout;
mod lod;
mod mipmap;
mod pixels;
mod sample;
mod sampled;
mod texel;
pub(crate) mod value;

pub use crate::device::{
    BorderStorage, FilterArithmetic, MissingChannels, SignedTexelMinimum, TargetRounding, TexelValues, WeightRounding,
};
pub use crate::texel::{Channel, ChannelClass, ComponentSource, FormatRecord, TexelFormat};
pub use address::{AddressMode, CubeFace, cube_coordinates, linear_taps, nearest_index, project};
pub use error::TextureError;
pub use image::{Image, Level, Region};
pub use kind::TextureKind;
pub use layout::{Layout, TexelMap};
pub use lod::{Lod, lod_from_derivatives};
pub use mipmap::MipmapRules;
pub(crate) use mipmap::texels_under;
pub use pixels::ImagePixel;
pub use sample::{Filter, MipFilter, SamplerState, sample, touched, unbound};
pub use sampled::SampleRules;
pub(crate) use sampled::{SampledComponent, SampledSource};
pub use texel::{ChannelValue, Texel, decode, decode_channel, encode, encode_channel};
pub(crate) use texel::{denominator, encode_ratio};
