//! Texture reads in WGSL: the sampler table, images as words, and the text of the texture library.
//!
//! The text defines `texture_read` and `texel_decode`. The rest of the module must define: the bindings `samplers` and
//! `video` (both `array<u32>`), `format(k: u32) -> Format` with `MAIN`, `texture_operand` and `texture_result` for
//! operands and results, and `Format`, `n_round`, `n_infinite`, `n_nan` and `s_alu` of the number library.
//!
//! All parameters of a read are in the sampler table, so one module serves all textures and states. A sampler has
//! [`SAMPLER_WORDS`] words; constants define their offsets, with the same names in Rust and WGSL.

use super::parts::Parts;
use crate::exec::SamplerBinding;
use crate::num::Format;
use crate::texture::{
    AddressMode, Channel, ChannelClass, ChannelValue, Filter, FilterArithmetic, Image, MipFilter, SampleRules,
    SampledComponent, SampledSource, SamplerState, SignedTexelMinimum, TexelFormat, TexelValues, TextureError,
    TextureKind, WeightRounding,
};

/// Defines constants shared by Rust and WGSL; they are written at the head of the text.
macro_rules! shared {
    ($($(#[$doc:meta])* $name:ident = $value:literal;)*) => {
        $($(#[$doc])* pub const $name: usize = $value;)*
        const SHARED: &[(&str, usize)] = &[$((stringify!($name), $value),)*];
    };
}

shared! {
    /// Words per sampler in the table.
    SAMPLER_WORDS = 80;
    /// Flags, at the bits named `FLAG_*`.
    SAMPLER_FLAGS = 0;
    /// Finest level that may be read (bits 0 to 7), coarsest level (8 to 15).
    SAMPLER_LEVEL_RANGE = 1;
    /// Bias of the level of detail, FP32 bits.
    SAMPLER_LOD_BIAS = 2;
    /// Texels of level 0 per unit of a coordinate, by axis, FP32 bits.
    SAMPLER_SCALES = 4;
    /// The four components: class (`TEXEL_*`, bits 0 to 7), shift (8 to 15), width (from 16 on).
    SAMPLER_COMPONENTS = 8;
    /// The four components of the border: codes of integers, FP32 bits of float texels.
    SAMPLER_BORDER = 12;
    /// The levels, four words each.
    SAMPLER_LEVELS = 16;
    /// Kind of texture (3 bits): `KIND_*`.
    FLAG_KIND = 0;
    /// Filter between levels (2 bits): `MIP_*`.
    FLAG_MIP = 3;
    /// Address modes of the three axes after adjustment to the kind of texture (2 bits each): `ADDRESS_*`.
    FLAG_ADDRESS = 5;
    /// Fraction bits of filter weights, at most 12 (4 bits).
    FLAG_FILTER_BITS = 11;
    /// Fraction bits of the level of detail, at most 8 (4 bits).
    FLAG_LOD_BITS = 15;
    /// Words per texel: 1, 2 or 4 (3 bits).
    FLAG_TEXEL_WORDS = 19;
    /// Number of texture axes; 0 if nothing is bound (2 bits).
    FLAG_AXES = 22;
    /// Linear minification filter.
    FLAG_MIN = 24;
    /// Linear magnification filter.
    FLAG_MAG = 25;
    /// The level of detail affects reads.
    FLAG_DETAIL = 26;
    /// All stored channels are floating-point.
    FLAG_FLOAT = 27;
    /// Coordinates are normalised (0 to 1); else they are in texels.
    FLAG_NORMALISED = 28;
    /// Filter weights are truncated; else they are rounded.
    FLAG_CUT = 29;
    /// Bytes are interpolated in steps that are rounded to bytes.
    FLAG_BYTES = 30;
    /// Offset of a level in `video`, in words.
    LEVEL_OFFSET = 0;
    /// Texels per row.
    LEVEL_WIDTH = 1;
    /// Rows per slice.
    LEVEL_HEIGHT = 2;
    /// Number of slices (or faces).
    LEVEL_SLICES = 3;
    /// 1-D texture.
    KIND_D1 = 0;
    /// 2-D texture.
    KIND_D2 = 1;
    /// Rectangle texture.
    KIND_RECTANGLE = 2;
    /// Cube map.
    KIND_CUBE = 3;
    /// Volume texture.
    KIND_VOLUME = 4;
    /// Finest allowed level only.
    MIP_NONE = 0;
    /// Nearest level.
    MIP_NEAREST = 1;
    /// Interpolation between the nearest two levels.
    MIP_LINEAR = 2;
    /// Repeats the image.
    ADDRESS_WRAP = 0;
    /// Repeats the image mirrored.
    ADDRESS_MIRROR = 1;
    /// Repeats the texel at the edge.
    ADDRESS_CLAMP = 2;
    /// Returns the border texel.
    ADDRESS_BORDER = 3;
    /// Always 0.
    TEXEL_ZERO = 0;
    /// Always 1, as the byte 255.
    TEXEL_ONE = 1;
    /// `k / (2^n - 1)`
    TEXEL_UNORM = 2;
    /// `k / (2^(n-1) - 1)`, with the smallest value below -1.
    TEXEL_SNORM = 3;
    /// `k / (2^(n-1) - 1)`, with the smallest value clamped to -1.
    TEXEL_SNORM_CLAMPED = 4;
    /// `k / 15` above zero, `k / 16` below.
    TEXEL_SPLIT = 5;
    /// Bits repeated to a byte k: `k / 255`.
    TEXEL_BYTE = 6;
    /// A channel whose bits are repeated to fill a signed byte k; its value is `2k / 255`.
    TEXEL_SIGNED_BYTE = 7;
    /// Bits repeated to a signed byte k: `2k / 255`, with the smallest value clamped to -1.
    TEXEL_SIGNED_BYTE_CLAMPED = 8;
    /// fp16
    TEXEL_FP16 = 9;
    /// fp24
    TEXEL_FP24 = 10;
    /// fp32
    TEXEL_FP32 = 11;
    /// Level of detail from differences across the quad.
    DETAIL_IMPLICIT = 0;
    /// Level of detail from differences across the quad, plus a bias.
    DETAIL_BIASED = 1;
    /// Level of detail from given derivatives.
    DETAIL_GRADIENTS = 2;
}

/// Maximum number of levels of an image, for 16384 texels per axis.
const MAX_LEVELS: usize = 15;

/// The library's text: constants, then functions.
pub fn library() -> String {
    let mut text = String::new();
    for (name, value) in SHARED {
        text.push_str(&format!("const {name}: u32 = {value}u;\n"));
    }
    for part in [
        include_str!("texture/address.wgsl"),
        include_str!("texture/texel.wgsl"),
        include_str!("texture/place.wgsl"),
        include_str!("texture/sample.wgsl"),
    ] {
        text.push('\n');
        text.push_str(part);
    }
    text
}

/// Encodes a sampler. `first_word` is the offset of its image ([`image_words`]) in `video`; an unbound sampler reads
/// (0, 0, 0, 1).
pub fn sampler_words(
    binding: Option<&SamplerBinding<'_>>,
    rules: &SampleRules,
    first_word: u32,
) -> [u32; SAMPLER_WORDS] {
    let mut words = [0; SAMPLER_WORDS];
    let flag = |value: u32, at: usize| value << at;
    words[SAMPLER_FLAGS] = flag(u32::from(rules.filter_fraction_bits.min(12)), FLAG_FILTER_BITS)
        | flag(u32::from(rules.lod_fraction_bits.min(8)), FLAG_LOD_BITS)
        | flag(u32::from(rules.filter_weight_rounding == WeightRounding::Cut), FLAG_CUT);
    words[SAMPLER_COMPONENTS + 3] = TEXEL_ONE as u32;
    let Some(binding) = binding else {
        words[SAMPLER_FLAGS] |= flag(1, FLAG_TEXEL_WORDS);
        return words;
    };
    let (image, state) = (binding.image, &binding.state);
    let (format, kind) = (image.format(), image.kind());
    let last = image.levels().len().min(MAX_LEVELS) as u32 - 1;
    let mip = match state.mip {
        MipFilter::None => MIP_NONE,
        MipFilter::Nearest => MIP_NEAREST,
        MipFilter::Linear => MIP_LINEAR,
    };
    words[SAMPLER_FLAGS] |= flag(kind_word(kind), FLAG_KIND)
        | flag(mip as u32, FLAG_MIP)
        | flag(address_word(kind, state.address_u), FLAG_ADDRESS)
        | flag(address_word(kind, state.address_v), FLAG_ADDRESS + 2)
        | flag(address_word(kind, state.address_w), FLAG_ADDRESS + 4)
        | flag(texel_words(format) as u32, FLAG_TEXEL_WORDS)
        | flag(axes(kind), FLAG_AXES)
        | flag(u32::from(state.min == Filter::Linear), FLAG_MIN)
        | flag(u32::from(state.mag == Filter::Linear), FLAG_MAG)
        | flag(u32::from(binding.needs_detail()), FLAG_DETAIL)
        | flag(u32::from(format.record().is_float()), FLAG_FLOAT)
        | flag(u32::from(interpolates_bytes(format, rules)), FLAG_BYTES)
        | flag(u32::from(kind != TextureKind::Rectangle), FLAG_NORMALISED);
    words[SAMPLER_LEVEL_RANGE] = u32::from(state.max_mip_level).min(last) | last << 8;
    words[SAMPLER_LOD_BIAS] = state.lod_bias;
    words[SAMPLER_SCALES..][..3].copy_from_slice(&scales(image));
    words[SAMPLER_COMPONENTS..][..4].copy_from_slice(&component_words(format, rules));
    words[SAMPLER_BORDER..][..4].copy_from_slice(&border_words(format, state, rules));
    let size = texel_words(format);
    for (row, level) in words[SAMPLER_LEVELS..].chunks_exact_mut(4).zip(image.levels()) {
        let offset = level.offset / format.bytes() * size;
        row.copy_from_slice(&[first_word.wrapping_add(offset as u32), level.width, level.height, level.slices]);
    }
    words
}

/// Adds the parts of the text that reads through a sampler use.
pub fn parts(sampler: &[u32], parts: &mut Parts) {
    let flag = |at: usize| sampler[SAMPLER_FLAGS] >> at;
    let is_cube = flag(FLAG_KIND) & 7 == KIND_CUBE as u32;
    let floats = flag(FLAG_FLOAT) & 1 == 1;
    let linear = (flag(FLAG_MIN) | flag(FLAG_MAG)) & 1 == 1 || flag(FLAG_MIP) & 3 == MIP_LINEAR as u32;
    parts.add_if(is_cube, "HAS_CUBES");
    parts.add_if(is_cube || flag(FLAG_DETAIL) & 1 == 1, "HAS_TEXTURE_DETAIL");
    let (min, mag, mip) = (flag(FLAG_MIN) & 1, flag(FLAG_MAG) & 1, flag(FLAG_MIP) & 3);
    parts.add_if(min != mag || mip != MIP_NONE as u32, "HAS_LEVELS");
    parts.add_if(linear, "HAS_FILTERS");
    let periodic = |axis: u32| flag(FLAG_ADDRESS + 2 * axis as usize) & 3 <= ADDRESS_MIRROR as u32;
    parts.add_if((0..flag(FLAG_AXES) & 3).any(periodic), "HAS_PERIODS");
    parts.add(if floats { "HAS_FLOAT_TEXELS" } else { "HAS_RATIO_TEXELS" });
    parts.add_if(floats && linear, "HAS_FLOAT_FILTERS");
    let bytes = linear && flag(FLAG_BYTES) & 1 == 1;
    parts.add_if(bytes, "HAS_BYTE_FILTERS");
    parts.add_if(bytes || floats && linear, "HAS_INTERPOLATION");
}

fn kind_word(kind: TextureKind) -> u32 {
    let word = match kind {
        TextureKind::D1 => KIND_D1,
        TextureKind::D2 => KIND_D2,
        TextureKind::Rectangle => KIND_RECTANGLE,
        TextureKind::Cube => KIND_CUBE,
        TextureKind::Volume => KIND_VOLUME,
    };
    word as u32
}

/// Cube face coordinates are always clamped; on a rectangle, wrap and mirror act as clamp.
fn address_word(kind: TextureKind, asked: AddressMode) -> u32 {
    let mode = match (kind, asked) {
        (TextureKind::Cube, _) => ADDRESS_CLAMP,
        (_, AddressMode::Border) => ADDRESS_BORDER,
        (TextureKind::Rectangle, _) | (_, AddressMode::Clamp) => ADDRESS_CLAMP,
        (_, AddressMode::Wrap) => ADDRESS_WRAP,
        (_, AddressMode::Mirror) => ADDRESS_MIRROR,
    };
    mode as u32
}

fn axes(kind: TextureKind) -> u32 {
    match kind {
        TextureKind::D1 => 1,
        TextureKind::D2 | TextureKind::Rectangle | TextureKind::Cube => 2,
        TextureKind::Volume => 3,
    }
}

/// Factors that convert derivatives to texels of level 0.
fn scales(image: &Image) -> [u32; 3] {
    let single = crate::texture::value::from_integer;
    match image.kind() {
        TextureKind::Rectangle => [single(1); 3],
        TextureKind::Cube => [single(i64::from(image.width())); 3],
        _ => [image.width(), image.height(), image.slices()].map(|n| single(i64::from(n))),
    }
}

/// Returns `true` if a component is an interpolated byte.
fn interpolates_bytes(format: TexelFormat, rules: &SampleRules) -> bool {
    let is_byte = |source: &SampledSource| matches!(source.read(rules, |_| 0), SampledComponent::Byte { .. });
    rules.filter_arithmetic == FilterArithmetic::ByteLerps
        && !format.record().is_float()
        && rules.sources(format).iter().any(is_byte)
}

/// Encodes the sources of red, green, blue and alpha in a texel: the words at [`SAMPLER_COMPONENTS`].
pub fn component_words(format: TexelFormat, rules: &SampleRules) -> [u32; 4] {
    rules.sources(format).map(|source| match source {
        SampledSource::Missing(0) => TEXEL_ZERO as u32,
        SampledSource::Missing(_) => TEXEL_ONE as u32,
        SampledSource::Stored(channel) => channel_word(channel, rules),
    })
}

/// Encodes a stored channel: class, shift and width. Fixed-point channels have at most 16 bits, and no channel crosses
/// a word.
fn channel_word(mut channel: Channel, rules: &SampleRules) -> u32 {
    let mut bytes = channel.bits <= 8 && rules.texel_values == TexelValues::Bytes;
    if channel.bits == 16
        && !matches!(channel.class, ChannelClass::Float(_))
        && rules.texel_values == TexelValues::Bytes
    {
        // The upper byte is treated as a channel.
        (channel.shift, channel.bits, bytes) = (channel.shift + 8, 8, true);
    }
    let clamped = rules.signed_texel_minimum == SignedTexelMinimum::Clamp;
    let class = match channel.class {
        ChannelClass::Unorm if bytes => TEXEL_BYTE,
        ChannelClass::Unorm => TEXEL_UNORM,
        ChannelClass::Snorm | ChannelClass::SplitSnorm if bytes && clamped => TEXEL_SIGNED_BYTE_CLAMPED,
        ChannelClass::Snorm | ChannelClass::SplitSnorm if bytes => TEXEL_SIGNED_BYTE,
        ChannelClass::Snorm if clamped => TEXEL_SNORM_CLAMPED,
        ChannelClass::Snorm => TEXEL_SNORM,
        ChannelClass::SplitSnorm => TEXEL_SPLIT,
        ChannelClass::Float(f) if f == Format::FP16 => TEXEL_FP16,
        ChannelClass::Float(f) if f == Format::FP24 => TEXEL_FP24,
        ChannelClass::Float(_) => TEXEL_FP32,
    };
    class as u32 | u32::from(channel.shift) << 8 | u32::from(channel.bits) << 16
}

/// Encodes the border: the results of `texel_code`, or for float texels of `texel_single`, for the border texel.
fn border_words(format: TexelFormat, state: &SamplerState, rules: &SampleRules) -> [u32; 4] {
    let floats = format.record().is_float();
    rules.border(format, state.border).map(|component| match component {
        SampledComponent::Byte { byte, .. } if !floats => byte.cast_unsigned(),
        SampledComponent::Value(ChannelValue::Ratio { numerator, .. }) => (numerator as i32).cast_unsigned(),
        single => single.value(rules).to_format(Format::FP32),
    })
}

/// Words per texel in `video`: 1, 2 or 4.
pub fn texel_words(format: TexelFormat) -> usize {
    format.bytes().div_ceil(4)
}

/// Number of words of an encoded image.
pub fn image_size(image: &Image) -> usize {
    image.bytes().len() / image.format().bytes() * texel_words(image.format())
}

/// Encodes an image: each texel as little-endian words, padded with zeros to whole words; levels, slices and rows in
/// order.
pub fn image_words(image: &Image) -> Vec<u32> {
    let (bytes, words) = (image.format().bytes(), texel_words(image.format()));
    let mut out = Vec::with_capacity(image_size(image));
    if bytes == 4 * words {
        out.extend(image.bytes().chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])));
    } else {
        // One or two bytes per texel.
        let wide = |texel: &[u8]| texel.iter().rev().fold(0, |word, &b| word << 8 | u32::from(b));
        out.extend(image.bytes().chunks_exact(bytes).map(wide));
    }
    out
}

/// Decodes all texels of an image from the words of [`image_words`], possibly modified by a shader.
///
/// # Errors
/// If the number of words is wrong.
pub fn words_to_image(words: &[u32], image: &mut Image) -> Result<(), TextureError> {
    let expected = image_size(image);
    if words.len() != expected {
        return Err(TextureError::DataSize { unit: "words", expected, found: words.len() });
    }
    let step = image.format().bytes().min(4);
    for (bytes, word) in image.bytes_mut().chunks_exact_mut(step).zip(words) {
        bytes.copy_from_slice(&word.to_le_bytes()[..step]);
    }
    Ok(())
}
