//! Arithmetic rules of a device, resolved to plain values for the executors.

use super::storage_formats::StorageFormats;
use crate::isa::Version;
use crate::num::{DotOrder, Format, Rounding, Specials, ops};

/// Value of a rule, as profiles and switches write it.
trait RuleValue: Sized {
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

/// Rounding of products, if not that of sums.
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
    /// The sum of an adder that keeps so many bits below the largest exponent is rounded once ([`ops::sum_aligned`]).
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
        /// The product is cut to the significand, with any exponent; the exact sum is rounded once
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
    /// Treatment of coordinates beyond the register range in `texcrd`.
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
        /// -1, as its neighbour.
        Clamp = "clamp",
        /// Its own value, slightly below -1: -128/127 for 8 bits.
        BelowMinusOne = "below-minus-one",
    }
}

named_choice! {
    /// Values of a sampled texel's channels. Channels of 9 to 15 bits are fractions on every device.
    TexelValues {
        /// The fractions of Direct3D: `k / (2^n - 1)`, signed ones `k / (2^(n-1) - 1)`.
        Fractions = "fractions",
        /// The bits are repeated until they fill a byte; of 16 bits the upper byte counts. An unsigned byte k is
        /// `k / 255`, a signed one `2k / 255`.
        Bytes = "bytes",
    }
}

named_choice! {
    /// Arithmetic of a filter on bytes: 8-bit channels, and narrower ones under [`TexelValues::Bytes`].
    FilterArithmetic {
        /// The exact weighted sum, rounded once into the register format.
        Exact = "exact",
        /// Interpolation along x, y, z and between levels, each result rounded to a byte, halves up.
        ByteLerps = "byte-lerps",
    }
}

named_choice! {
    /// Rounding of the position that gives a linear filter its weights.
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
        /// Four bytes, red to alpha, for all components of unsigned formats that are bytes or not stored.
        Bytes = "bytes",
    }
}

named_choice! {
    /// Components delivered by a sampler that the format does not store.
    MissingChannels {
        /// The defaults of Direct3D 9: black for alpha alone, 1 elsewhere.
        Direct3d = "direct3d",
        /// As an Xbox reads its formats: white for alpha alone; of two 8-bit channels (r, g, r, g), of two 16-bit
        /// ones (r, g, g, r).
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
    /// Where the vertex colours are clamped to [0, 1] first. Interpolated colours are clamped in any case.
    ColorClamp {
        /// At every vertex, before interpolation. +NaN gives 1, and -NaN 0.
        Vertex = "vertex",
        /// At the vertex if a vertex program wrote them, where NaN gives 0; those of transformed vertices at the pixel.
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
        /// As sign and 8-bit magnitude `k / 255` (nearest, halves away from zero), clamped to [-1, 1], then converted.
        Snorm8 = "snorm8",
        /// As [`Self::Snorm8`], but k is the single-precision product of the magnitude and 255, cut: 0.5 is 127/255.
        Snorm8Cut = "snorm8-cut",
        /// As 8 bits without a sign, expanded by `2x - 1` where they are read: clamped to [-1, 1], `(2k - 255) / 255`
        /// with k the whole part of `127.5 (c + 1)`. It has no zero: 0 is -1/255, and 0.5 is 127/255.
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
    /// `2^bits` lines a pixel. 0 to 8 bits; more count as 8.
    Bits(u8),
    /// 12 lines a pixel.
    Twelfths,
}

impl SubpixelGrid {
    /// Lines a pixel, 1 to 256.
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

/// Defines the rules, each with its field, its type and its name in profiles and switches.
macro_rules! rules {
    ($(#[$meta:meta])* $name:ident { $($(#[$doc:meta])* $field:ident: $type:ty = $text:literal),* $(,)? }
     beside { $($(#[$beside_doc:meta])* $beside:ident: $beside_type:ty),* $(,)? }) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq, Eq)]
        #[non_exhaustive]
        pub struct $name {
            $($(#[$doc])* pub $field: $type,)*
            $($(#[$beside_doc])* pub $beside: $beside_type,)*
        }

        impl $name {
            /// Names of the rules, which every profile must state.
            pub(super) const NAMES: &[&'static str] = &[$($text),*];

            /// Reads all rules; `text` returns the value of a name. Other settings keep their defaults.
            pub(super) fn read(text: impl Fn(&str) -> Option<String>) -> Result<Self, String> {
                fn value<T: RuleValue>(name: &str, text: Option<String>) -> Result<T, String> {
                    let text = text.ok_or_else(|| format!("rules.{name} is missing"))?;
                    T::from_text(&text).ok_or_else(|| format!("rules.{name}: `{text}` means nothing"))
                }
                Ok(Self {
                    $($field: value($text, text($text))?,)*
                    $($beside: Default::default(),)*
                })
            }

            /// Sets one rule from its text; `None` if there is no such rule, or the text is not a value of it.
            pub(super) fn set(&mut self, name: &str, text: &str) -> Option<()> {
                match name {
                    $($text => self.$field = RuleValue::from_text(text)?,)*
                    _ => return None,
                }
                Some(())
            }
        }
    };
}

rules! {
    /// Arithmetic rules of a device. Executors read no other part of a profile; devices with equal rules give equal
    /// bits.
    ///
    /// Every field is a figure or a switch of the profile, under `rules.*`; docs/devices.md has the table. Switches are
    /// added as cards are measured: outside this crate, rules are those of a [`Profile`](super::Profile), changed field
    /// by field.
    Rules {
        /// Pixel registers and pixel arithmetic.
        format: Format = "format",
        /// Clamp of results written to a pixel register.
        result_range: ResultRange = "result-range",
        /// Arithmetic of instructions with `_pp`: sources are converted to this format, the operation is done in it,
        /// and the result is converted to `format`. `None`: the hint is ignored.
        partial: Option<Format> = "partial",
        /// Vertex registers and vertex arithmetic.
        vertex_format: Format = "vertex-format",
        /// Format in which attributes are interpolated over a primitive, before conversion to `format`.
        iterator_format: Format = "iterator-format",
        /// Precision of the colours `v#`.
        color_iterator: ColorIterator = "color-iterator",
        /// Storage of constants `c#` of pixel programs.
        constant_storage: ConstantStorage = "constants",
        /// Rounding of products of pixel arithmetic, if not that of sums: of `mul`, of `mad` with two roundings, and of
        /// dot products but exact ones.
        product_rounding: Option<Rounding> = "product-rounding",
        /// Sums of two numbers of pixel arithmetic.
        add: AddMode = "add",
        /// Rounding within `mad` of pixel arithmetic; vertices and addresses have two roundings.
        mad: MadMode = "mad",
        /// Rounding within dot products of pixel arithmetic; those of vertices and addresses are sequential.
        dot: DotOrder = "dot",
        /// Rounding within `lrp`.
        lrp: LrpMode = "lrp",
        /// Coordinates beyond the register range in `texcrd`.
        texcrd_overflow: TexcrdOverflow = "texcrd-overflow",
        /// The denominator of `texdepth`.
        texdepth_denominator: TexdepthDenominator = "texdepth-denominator",
        /// Components that `texkill` tests in ps_2_x.
        texkill_components: TexkillComponents = "texkill-components",
        /// Value of the most negative signed texel.
        signed_texel_minimum: SignedTexelMinimum = "signed-texel-minimum",
        /// `true` if 0 times anything, including infinity and NaN, is 0 in pixel arithmetic.
        zero_times_anything: bool = "zero-times-anything",
        /// Rounding into unsigned normalised colour targets.
        target_rounding: TargetRounding = "target-rounding",
        /// Rounding of the averages that fill generated mip levels.
        mipmap_rounding: TargetRounding = "mipmap-rounding",
        /// Rounding into integer depth buffers.
        depth_rounding: TargetRounding = "depth-rounding",
        /// `true` if 0 times anything, including infinity and NaN, is 0 in vertex arithmetic.
        vertex_zero_times_anything: bool = "vertex-zero-times-anything",
        /// Clamp of vertex colours.
        color_clamp: ColorClamp = "color-clamp",
        /// Rounding of a window position at set-up.
        subpixel_rounding: SubpixelRounding = "subpixel-rounding",
        /// Grid of window positions at set-up.
        subpixel_grid: SubpixelGrid = "subpixel-bits",
        /// Fraction bits of the weights of a linear filter, 0 to 8.
        filter_fraction_bits: u8 = "filter-fraction-bits",
        /// Fraction bits of a level of detail, 0 to 8.
        lod_fraction_bits: u8 = "lod-fraction-bits",
        /// Rounding of the weights of a linear filter.
        filter_weight_rounding: WeightRounding = "filter-weight-rounding",
        /// Arithmetic of filters on bytes.
        filter_arithmetic: FilterArithmetic = "filter-arithmetic",
        /// Values of narrow channels of texels.
        texel_values: TexelValues = "texel-values",
        /// Components that a texel does not store.
        missing_channels: MissingChannels = "missing-channels",
        /// Storage of border colors.
        border_storage: BorderStorage = "border-storage",
    }
    beside {
        /// Formats of storages of pixel programs; no card has any ([`super::Profile::set_storage_format`]).
        storage: StorageFormats,
        /// Format of the sums of dot products in pixel programs, if not that of the operation; no card has one
        /// ([`super::Profile::set_accumulator`]).
        accumulator: Option<Format>,
    }
}

impl Rules {
    /// How a language computes `lrp`: OpenGL's state `t0 * t1 + (1 - t0) * t2` (GL_NV_fragment_program and
    /// GL_ARB_fragment_program, sections on LRP); Direct3D leaves it to the card.
    pub fn lrp_in(&self, version: Version) -> LrpMode {
        if version.is_fragment_program() { LrpMode::TwoProducts } else { self.lrp }
    }

    /// Whether MIN and MAX of a language are `a > b ? b : a` and `a > b ? a : b` in a format, where NaN is never the
    /// greater one (GL_ARB_fragment_program 3.11.5.16 and .17). NVIDIA's unit has a rule of its own in either language.
    pub fn compares_in(version: Version, format: &Format) -> bool {
        version == Version::ArbFp1_0 && format.specials == Specials::Ieee
    }

    /// The number that FRC of a language gives where `x - floor(x)` rounds to 1, if another: OpenGL's result is below 1
    /// (GL_NV_fragment_program 3.11.5.10, GL_ARB_fragment_program 3.11.5.11), Direct3D's ranges "from 0.0 through 1.0".
    /// Fixed point has every fraction, and never rounds one.
    pub fn frc_instead_of_one(version: Version, format: &Format) -> Option<u32> {
        (version.is_fragment_program() && !format.is_fixed()).then(|| format.one() - 1)
    }
}
