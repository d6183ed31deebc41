//! Values of rules, and their names in profiles and switches.

use crate::num::{DotOrder, Format, Rounding, ops};

/// Value of a rule, as profiles and switches write it.
pub(super) trait RuleValue: Sized {
    /// Parses a value.
    fn from_text(text: &str) -> Option<Self>;
}

impl RuleValue for bool {
    fn from_text(text: &str) -> Option<Self> {
        text.parse().ok()
    }
}

/// Fraction bits.
impl RuleValue for u8 {
    fn from_text(text: &str) -> Option<Self> {
        text.parse().ok().filter(|bits| *bits <= 8)
    }
}

impl RuleValue for Format {
    fn from_text(text: &str) -> Option<Self> {
        text.parse().ok()
    }
}

impl RuleValue for Option<Format> {
    fn from_text(text: &str) -> Option<Self> {
        if text == "none" { Some(None) } else { Format::from_text(text).map(Some) }
    }
}

impl RuleValue for DotOrder {
    fn from_text(text: &str) -> Option<Self> {
        Self::named(text)
    }
}

/// Rounding of products, if different from the rounding of sums.
impl RuleValue for Option<Rounding> {
    fn from_text(text: &str) -> Option<Self> {
        if text == "as-sums" {
            return Some(None);
        }
        Rounding::ALL.iter().find(|(name, _)| *name == text).map(|(_, rounding)| Some(*rounding))
    }
}

/// Rounding of the sum of two numbers: in `add`, `sub`, and `mad` with two roundings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AddMode {
    /// The exact sum is rounded once.
    Rounded,
    /// An adder sums addends with this many bits below the largest exponent; the sum is rounded once
    /// ([`ops::sum_aligned`]).
    Aligned(u8),
}

impl RuleValue for AddMode {
    fn from_text(text: &str) -> Option<Self> {
        if text == "rounded" { Some(Self::Rounded) } else { ops::aligned_bits(text).map(Self::Aligned) }
    }
}

/// Defines an enumeration whose variants have names in profiles, switches and reports.
macro_rules! named_choice {
    ($(#[$meta:meta])* $name:ident { $($(#[$doc:meta])* $variant:ident = $text:literal),* $(,)? }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $name { $($(#[$doc])* $variant),* }

        impl $name {
            /// Every choice.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// The name in profiles and on the command line.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $text),* }
            }
        }

        impl RuleValue for $name {
            fn from_text(text: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|c| c.name() == text)
            }
        }
    };
}

named_choice! {
    /// Rounding of `a*b + c`.
    MadMode {
        /// The product is rounded, then the sum.
        TwoRoundings = "two-roundings",
        /// The exact sum is rounded once.
        Fused = "fused",
        /// The product is truncated to the significand, with any exponent; the exact sum is rounded once
        /// ([`ops::product_cut_mad`]).
        ProductCut = "product-cut",
    }
}

named_choice! {
    /// Evaluation order of `lrp d, s0, s1, s2`; every step is rounded.
    LrpMode {
        /// `s0 * (s1 - s2) + s2`, the last two steps as one `mad`.
        SubMulAdd = "sub-mul-add",
        /// `s0 * s1 + (1 - s0) * s2`
        TwoProducts = "two-products",
    }
}

named_choice! {
    /// Treatment of coordinates outside the register range in `texcrd`.
    TexcrdOverflow {
        /// Saturates.
        Clamp = "clamp",
        /// Wraps so that the fraction, and with it a wrapped texture address, is preserved.
        PreserveWrap = "wrap-preserving",
    }
}

named_choice! {
    /// Denominator of `texdepth`.
    TexdepthDenominator {
        /// `r5.g`, unclamped
        Raw = "raw",
        /// `min(r5.g, 1)`
        Min1 = "min1",
    }
}

named_choice! {
    /// Components that `texkill` tests in ps_2_x (in ps_1_x always the first three).
    TexkillComponents {
        /// x, y and z
        Three = "3",
        /// x, y, z and w
        Four = "4",
    }
}

named_choice! {
    /// Value of the most negative code of a signed texel.
    SignedTexelMinimum {
        /// -1, like the next code.
        Clamp = "clamp",
        /// Slightly below -1: -128/127 for 8 bits.
        BelowMinusOne = "below-minus-one",
    }
}

named_choice! {
    /// Values of a sampled texel's channels. Channels of 9 to 15 bits are fractions on every device.
    TexelValues {
        /// The fractions of Direct3D: `k / (2^n - 1)`, or `k / (2^(n-1) - 1)` if signed.
        Fractions = "fractions",
        /// The bits are repeated until they fill a byte; of 16 bits only the upper byte is used. An unsigned byte k is
        /// `k / 255`, a signed byte k is `2k / 255`.
        Bytes = "bytes",
    }
}

named_choice! {
    /// Arithmetic of a filter on bytes: on 8-bit channels, and on narrower channels under [`TexelValues::Bytes`].
    FilterArithmetic {
        /// The exact weighted sum, rounded once into the register format.
        Exact = "exact",
        /// Interpolation along x, y, z and between levels, each result rounded to a byte, halves up.
        ByteLerps = "byte-lerps",
    }
}

named_choice! {
    /// Rounding of the texel position from which a linear filter derives its weights.
    WeightRounding {
        /// To the nearest step, halves up.
        Nearest = "nearest",
        /// Down to a step.
        Cut = "cut",
    }
}

named_choice! {
    /// Storage of a sampler's border color.
    BorderStorage {
        /// A texel of the image's format.
        Texel = "texel",
        /// Four bytes, red to alpha, for components of unsigned formats that are stored as bytes or not stored.
        Bytes = "bytes",
    }
}

named_choice! {
    /// Components that a sampler returns for channels that the format does not store.
    MissingChannels {
        /// The defaults of Direct3D 9: black for alpha alone, 1 elsewhere.
        Direct3d = "direct3d",
        /// As on the Xbox: white for alpha alone; (r, g, r, g) for two 8-bit channels, (r, g, g, r) for two 16-bit
        /// channels.
        Xbox = "xbox",
    }
}

named_choice! {
    /// Rounding into a fixed-point target, generated mip level or depth buffer.
    TargetRounding {
        /// To the nearest step, halves away from zero.
        Nearest = "nearest",
        /// To the next step towards zero.
        Truncate = "truncate",
    }
}

named_choice! {
    /// Rounding of window positions to the grid of `subpixel_grid`.
    SubpixelRounding {
        /// To the nearest grid line, halves toward larger columns and rows.
        Nearest = "nearest",
        /// Toward the corner of the first pixel: (0, 0) where pixel centres lie at one half, (-1/2, -1/2) where they
        /// lie at integers.
        Cut = "cut",
    }
}

named_choice! {
    /// The stage that first clamps vertex colours to [0, 1]. Interpolated colours are clamped in any case.
    ColorClamp {
        /// At every vertex, before interpolation. +NaN gives 1, -NaN gives 0.
        Vertex = "vertex",
        /// Colours that a vertex program wrote are clamped at the vertex, colours of transformed vertices at the pixel.
        /// NaN gives 0.
        Program = "program",
        /// At the pixel, where NaN gives 0.
        Pixel = "pixel",
    }
}

named_choice! {
    /// Storage format of constants before they are read into registers.
    ConstantStorage {
        /// Converted to the register format directly.
        Register = "register",
        /// Stored as sign and 8-bit magnitude `k / 255` (nearest, halves away from zero), clamped to [-1, 1], then
        /// converted.
        Snorm8 = "snorm8",
        /// As [`Self::Snorm8`], but k is the truncated single-precision product of the magnitude and 255: 0.5 is
        /// 127/255.
        Snorm8Cut = "snorm8-cut",
        /// Stored as 8 unsigned bits, expanded by `2x - 1` when read: c, clamped to [-1, 1], becomes `(2k - 255) / 255`
        /// with k the integer part of `127.5 (c + 1)`. Zero does not exist: 0 becomes -1/255, and 0.5 becomes 127/255.
        Unorm8Expanded = "unorm8-expanded",
    }
}

named_choice! {
    /// Clamp of the results of a pixel program when they are written to a register, after shift and saturation.
    ResultRange {
        /// To the range of the register format only.
        Format = "format",
        /// [-1, 1]: intermediate sums and products may exceed it, registers may not.
        One = "one",
    }
}

/// Grid of window positions at set-up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SubpixelGrid {
    /// `2^bits` lines per pixel; 0 to 8 bits, more count as 8.
    Bits(u8),
    /// 12 lines per pixel.
    Twelfths,
}

impl SubpixelGrid {
    /// Lines per pixel, 1 to 256.
    pub fn lines(self) -> u32 {
        match self {
            Self::Bits(bits) => 1 << bits.min(8),
            Self::Twelfths => 12,
        }
    }
}

impl RuleValue for SubpixelGrid {
    fn from_text(text: &str) -> Option<Self> {
        if text == "twelfths" { Some(Self::Twelfths) } else { u8::from_text(text).map(Self::Bits) }
    }
}

/// Precision of the interpolated colours `v#`, which are first clamped to [0, 1].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColorIterator {
    /// Rounded to the nearest `k / (2^bits - 1)`, then converted to the register format. 1 to 16 bits.
    Unorm(u8),
    /// Converted to the register format directly.
    Full,
}

impl ColorIterator {
    /// The name in profiles: the number of bits, or `full`.
    pub fn name(self) -> String {
        match self {
            Self::Unorm(bits) => bits.to_string(),
            Self::Full => "full".to_owned(),
        }
    }
}

impl RuleValue for ColorIterator {
    fn from_text(text: &str) -> Option<Self> {
        if text == "full" {
            return Some(Self::Full);
        }
        let bits = text.parse().ok()?;
        (1..=16).contains(&bits).then_some(Self::Unorm(bits))
    }
}
