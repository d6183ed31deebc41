//! Formats of texels and depths. A texel format is a record: position and meaning of each channel, and the values of
//! channels that are not stored.

use strum::{Display, IntoStaticStr, VariantArray};

use crate::num::Format;

/// Meaning of the bits of a stored channel.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChannelClass {
    /// `k / (2^n - 1)`
    Unorm,
    /// Two's complement `k / (2^(n-1) - 1)`; [`crate::device::SignedTexelMinimum`] determines the value of the
    /// smallest `k`.
    Snorm,
    /// The signed channels of `L6V5U5`: `k / 15` for k >= 0 and `k / 16` for k < 0, so -15 is not -1.0. All sixteen
    /// probes of Wine's test agree on real cards (docs/numbers.md).
    SplitSnorm,
    /// A floating-point pattern of the given format.
    Float(Format),
}

/// One stored channel of a texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Channel {
    /// Position of the lowest bit in the texel, which is read as a little-endian integer.
    pub shift: u8,
    /// Width in bits, 1 to 32.
    pub bits: u8,
    /// Meaning of the bits.
    pub class: ChannelClass,
    /// Colour component (0 red to 3 alpha) that is stored in the channel.
    pub stored_from: u8,
}

/// Source of a colour component that a sampler returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComponentSource {
    /// The stored channel with this index.
    Channel(u8),
    /// Always 0.
    Zero,
    /// Always 1.
    One,
}

/// Description of a texel format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormatRecord {
    /// Name in profiles and case files, for example `rgba8`.
    pub name: &'static str,
    /// Direct3D name without prefix, in lower case, for example `a8b8g8r8`; empty if there is none.
    pub d3d_name: &'static str,
    /// Bytes per texel, 1 to 16.
    pub bytes: u8,
    /// Number of stored channels.
    pub channel_count: u8,
    /// The stored channels; entries from `channel_count` on are unused.
    pub channels: [Channel; 4],
    /// Sources of the red, green, blue and alpha that a sampler returns in Direct3D.
    pub components: [ComponentSource; 4],
}

impl FormatRecord {
    /// The stored channels.
    pub fn stored(&self) -> &[Channel] {
        &self.channels[..usize::from(self.channel_count)]
    }

    /// Returns `true` if every stored channel is floating-point.
    pub fn is_float(&self) -> bool {
        self.stored().iter().all(|c| matches!(c.class, Float(_)))
    }

    /// Returns `true` if some stored channel can be negative.
    pub fn is_signed(&self) -> bool {
        self.stored().iter().any(|c| c.class != Unorm)
    }

    /// Returns `true` if alpha is stored.
    pub fn has_alpha(&self) -> bool {
        matches!(self.components[3], ComponentSource::Channel(_))
    }
}

const UNUSED: Channel = Channel { shift: 0, bits: 1, class: Unorm, stored_from: 0 };

/// Channels of a class, from `(shift, bits, component)` triples.
const fn channels(class: ChannelClass, list: &[(u8, u8, u8)]) -> [Channel; 4] {
    let mut out = [UNUSED; 4];
    let mut i = 0;
    while i < list.len() {
        out[i] = Channel { shift: list[i].0, bits: list[i].1, class, stored_from: list[i].2 };
        i += 1;
    }
    out
}

const C0: ComponentSource = ComponentSource::Channel(0);
const C1: ComponentSource = ComponentSource::Channel(1);
const C2: ComponentSource = ComponentSource::Channel(2);
const C3: ComponentSource = ComponentSource::Channel(3);
const ZERO: ComponentSource = ComponentSource::Zero;
const ONE: ComponentSource = ComponentSource::One;

// Components that are not stored (Direct3D 9 sampler page, "default values"): alpha is 1 for colour; blue and alpha are
// 1 for two channels; all but red are 1 for one channel; colour is black for alpha alone; luminance is replicated.
const RGBA: [ComponentSource; 4] = [C0, C1, C2, C3];
const RGB: [ComponentSource; 4] = [C0, C1, C2, ONE];
const RG: [ComponentSource; 4] = [C0, C1, ONE, ONE];
const R: [ComponentSource; 4] = [C0, ONE, ONE, ONE];
const ALPHA: [ComponentSource; 4] = [ZERO, ZERO, ZERO, C0];
const LUMINANCE: [ComponentSource; 4] = [C0, C0, C0, ONE];
const LUMINANCE_ALPHA: [ComponentSource; 4] = [C0, C0, C0, C1];

const ONE8: &[(u8, u8, u8)] = &[(0, 8, 0)];
const TWO8: &[(u8, u8, u8)] = &[(0, 8, 0), (8, 8, 1)];
const FOUR8: &[(u8, u8, u8)] = &[(0, 8, 0), (8, 8, 1), (16, 8, 2), (24, 8, 3)];
const ONE16: &[(u8, u8, u8)] = &[(0, 16, 0)];
const TWO16: &[(u8, u8, u8)] = &[(0, 16, 0), (16, 16, 1)];
const FOUR16: &[(u8, u8, u8)] = &[(0, 16, 0), (16, 16, 1), (32, 16, 2), (48, 16, 3)];
const ONE24: &[(u8, u8, u8)] = &[(0, 24, 0)];
const FOUR24: &[(u8, u8, u8)] = &[(0, 24, 0), (32, 24, 1), (64, 24, 2), (96, 24, 3)];
const ONE32: &[(u8, u8, u8)] = &[(0, 32, 0)];
const TWO32: &[(u8, u8, u8)] = &[(0, 32, 0), (32, 32, 1)];
const FOUR32: &[(u8, u8, u8)] = &[(0, 32, 0), (32, 32, 1), (64, 32, 2), (96, 32, 3)];

use ChannelClass::{Float, Snorm, SplitSnorm, Unorm};

macro_rules! texel_formats {
    ($($(#[$doc:meta])* $variant:ident $name:literal $d3d:literal $bytes:literal $count:literal $channels:expr, $components:expr;)*) => {
        /// The texel formats of textures and render targets. Texels are little-endian; channel names are listed from
        /// the lowest bits up.
        #[non_exhaustive]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum TexelFormat { $($(#[$doc])* $variant,)* }

        impl TexelFormat {
            /// Every format.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];

            /// The record of this format.
            pub const fn record(self) -> &'static FormatRecord {
                match self { $(Self::$variant => {
                    const RECORD: FormatRecord = FormatRecord {
                        name: $name, d3d_name: $d3d, bytes: $bytes, channel_count: $count,
                        channels: $channels, components: $components,
                    };
                    &RECORD
                })* }
            }
        }
    };
}

texel_formats! {
    /// 8-bit alpha; the colour is black.
    A8 "a8" "a8" 1 1 channels(Unorm, &[(0, 8, 3)]), ALPHA;
    /// 8-bit luminance, in red, green and blue.
    L8 "l8" "l8" 1 1 channels(Unorm, ONE8), LUMINANCE;
    /// 8-bit luminance and alpha.
    La8 "la8" "a8l8" 2 2 channels(Unorm, &[(0, 8, 0), (8, 8, 3)]), LUMINANCE_ALPHA;
    /// 16-bit luminance.
    L16 "l16" "l16" 2 1 channels(Unorm, ONE16), LUMINANCE;
    /// 3, 3 and 2 bits.
    Bgr233 "bgr233" "r3g3b2" 1 3 channels(Unorm, &[(5, 3, 0), (2, 3, 1), (0, 2, 2)]), RGB;
    /// 5, 6 and 5 bits, red highest.
    Bgr565 "bgr565" "r5g6b5" 2 3 channels(Unorm, &[(11, 5, 0), (5, 6, 1), (0, 5, 2)]), RGB;
    /// 5 bits per colour channel, one unused bit.
    Bgrx5551 "bgrx5551" "x1r5g5b5" 2 3 channels(Unorm, &[(10, 5, 0), (5, 5, 1), (0, 5, 2)]), RGB;
    /// 5 bits per colour channel, 1 bit alpha.
    Bgra5551 "bgra5551" "a1r5g5b5" 2 4 channels(Unorm, &[(10, 5, 0), (5, 5, 1), (0, 5, 2), (15, 1, 3)]), RGBA;
    /// 4 bits per channel.
    Bgra4444 "bgra4444" "a4r4g4b4" 2 4 channels(Unorm, &[(8, 4, 0), (4, 4, 1), (0, 4, 2), (12, 4, 3)]), RGBA;
    /// 8-bit red.
    R8 "r8" "" 1 1 channels(Unorm, ONE8), R;
    /// 8-bit red and green.
    Rg8 "rg8" "" 2 2 channels(Unorm, TWO8), RG;
    /// 8 bits per channel in the byte order red, green, blue, alpha.
    Rgba8 "rgba8" "a8b8g8r8" 4 4 channels(Unorm, FOUR8), RGBA;
    /// 8 bits per channel in the byte order blue, green, red, alpha.
    Bgra8 "bgra8" "a8r8g8b8" 4 4 channels(Unorm, &[(16, 8, 0), (8, 8, 1), (0, 8, 2), (24, 8, 3)]), RGBA;
    /// 8 bits per colour channel in the byte order blue, green, red, unused.
    Bgrx8 "bgrx8" "x8r8g8b8" 4 3 channels(Unorm, &[(16, 8, 0), (8, 8, 1), (0, 8, 2)]), RGB;
    /// 11, 11 and 10 bits.
    Rgb111110 "rgb111110" "b10g11r11" 4 3 channels(Unorm, &[(0, 11, 0), (11, 11, 1), (22, 10, 2)]), RGB;
    /// 10 bits per colour channel, 2 bits alpha.
    Rgb10a2 "rgb10a2" "a2b10g10r10" 4 4 channels(Unorm, &[(0, 10, 0), (10, 10, 1), (20, 10, 2), (30, 2, 3)]), RGBA;
    /// 16-bit red.
    R16 "r16" "" 2 1 channels(Unorm, ONE16), R;
    /// 16-bit red and green.
    Rg16 "rg16" "g16r16" 4 2 channels(Unorm, TWO16), RG;
    /// 16 bits per channel.
    Rgba16 "rgba16" "a16b16g16r16" 8 4 channels(Unorm, FOUR16), RGBA;
    /// Signed 8-bit red.
    R8Snorm "r8s" "" 1 1 channels(Snorm, ONE8), R;
    /// Signed 8-bit red and green.
    Rg8Snorm "rg8s" "v8u8" 2 2 channels(Snorm, TWO8), RG;
    /// Signed 8 bits per channel.
    Rgba8Snorm "rgba8s" "q8w8v8u8" 4 4 channels(Snorm, FOUR8), RGBA;
    /// Signed 16-bit red.
    R16Snorm "r16s" "" 2 1 channels(Snorm, ONE16), R;
    /// Signed 16-bit red and green; the low half is red.
    Rg16Snorm "rg16s" "v16u16" 4 2 channels(Snorm, TWO16), RG;
    /// Signed 16 bits per channel.
    Rgba16Snorm "rgba16s" "q16w16v16u16" 8 4 channels(Snorm, FOUR16), RGBA;
    /// Signed 5-bit red and green, unsigned 6-bit blue.
    L6v5u5 "l6v5u5" "l6v5u5" 2 3 [
        Channel { shift: 0, bits: 5, class: SplitSnorm, stored_from: 0 },
        Channel { shift: 5, bits: 5, class: SplitSnorm, stored_from: 1 },
        Channel { shift: 10, bits: 6, class: Unorm, stored_from: 2 },
        UNUSED,
    ], RGB;
    /// Signed 8-bit red and green, unsigned 8-bit blue, 8 unused bits.
    X8l8v8u8 "x8l8v8u8" "x8l8v8u8" 4 3 [
        Channel { shift: 0, bits: 8, class: Snorm, stored_from: 0 },
        Channel { shift: 8, bits: 8, class: Snorm, stored_from: 1 },
        Channel { shift: 16, bits: 8, class: Unorm, stored_from: 2 },
        UNUSED,
    ], RGB;
    /// fp16 red.
    R16f "r16f" "r16f" 2 1 channels(Float(Format::FP16), ONE16), R;
    /// fp16 red and green.
    Rg16f "rg16f" "g16r16f" 4 2 channels(Float(Format::FP16), TWO16), RG;
    /// fp16, four channels.
    Rgba16f "rgba16f" "a16b16g16r16f" 8 4 channels(Float(Format::FP16), FOUR16), RGBA;
    /// fp24 red, in the low 24 bits of a 32-bit word.
    R24f "r24f" "" 4 1 channels(Float(Format::FP24), ONE24), R;
    /// fp24, four channels, each in the low 24 bits of a 32-bit word.
    Rgba24f "rgba24f" "" 16 4 channels(Float(Format::FP24), FOUR24), RGBA;
    /// fp32 red.
    R32f "r32f" "r32f" 4 1 channels(Float(Format::FP32), ONE32), R;
    /// fp32 red and green.
    Rg32f "rg32f" "g32r32f" 8 2 channels(Float(Format::FP32), TWO32), RG;
    /// fp32, four channels.
    Rgba32f "rgba32f" "a32b32g32r32f" 16 4 channels(Float(Format::FP32), FOUR32), RGBA;
}

impl TexelFormat {
    /// The name in profiles and case files.
    pub fn name(self) -> &'static str {
        self.record().name
    }

    /// Bytes per texel.
    pub fn bytes(self) -> usize {
        usize::from(self.record().bytes)
    }

    /// The format with this project's name or Direct3D's (`D3DFMT_` allowed), in any case.
    pub fn named(text: &str) -> Option<Self> {
        let lower = text.trim().to_ascii_lowercase();
        let key = lower.strip_prefix("d3dfmt_").unwrap_or(&lower);
        let is_named = |f: &Self| !key.is_empty() && (f.record().name == key || f.record().d3d_name == key);
        Self::ALL.iter().copied().find(is_named)
    }

    /// Sources of the red, green, blue and alpha that a sampler of an Xbox returns.
    pub(crate) fn xbox_components(self) -> [ComponentSource; 4] {
        let record = self.record();
        match record.components {
            components if record.is_float() => components,
            ALPHA => [ONE, ONE, ONE, C0],
            RG if record.channels[0].bits == 8 => [C0, C1, C0, C1],
            RG => [C0, C1, C1, C0],
            components => components,
        }
    }
}

impl std::fmt::Display for TexelFormat {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// Storage format of depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, VariantArray, IntoStaticStr, Display)]
pub enum DepthFormat {
    /// `k / (2^16 - 1)`
    #[strum(serialize = "d16")]
    Unorm16,
    /// `k / (2^24 - 1)`
    #[strum(serialize = "d24")]
    Unorm24,
    /// `k / (2^32 - 1)`
    #[strum(serialize = "d32")]
    Unorm32,
    /// FP32
    #[strum(serialize = "d32f")]
    Float32,
    /// 24 bits without a sign: 4 exponent, 20 mantissa bits (`D24FS8`, "20e4"). guess: the bias, which no source
    /// states, is 15, so 1.0 has the largest exponent; exponent 0 is subnormal; rounding is to nearest even.
    #[strum(serialize = "d24f")]
    Float24,
}

impl DepthFormat {
    /// Every format.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// The name in profiles and case files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Bytes per pixel in the card's memory.
    pub const fn bytes(self) -> u64 {
        match self {
            Self::Unorm16 => 2,
            Self::Unorm24 | Self::Unorm32 | Self::Float32 | Self::Float24 => 4,
        }
    }
}
