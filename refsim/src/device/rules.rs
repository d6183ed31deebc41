//! The rules of a device for executors, resolved to plain values.

use crate::num::{DotOrder, Format};

/// An enumeration whose variants have names in profiles, switches and reports.
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

            /// The choice of this name.
            pub fn from_name(text: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|c| c.name() == text)
            }
        }
    };
}

named_choice! {
    /// How `a*b + c` is rounded.
    MadMode {
        /// The product is rounded, then the sum.
        TwoRoundings = "two-roundings",
        /// The exact sum is rounded once.
        Fused = "fused",
    }
}

named_choice! {
    /// How `lrp d, s0, s1, s2` is computed; every step is rounded.
    LrpMode {
        /// `s0 * (s1 - s2) + s2`, the last two steps as one `mad`.
        SubMulAdd = "sub-mul-add",
        /// `s0 * s1 + (1 - s0) * s2`
        TwoProducts = "two-products",
    }
}

named_choice! {
    /// What `texcrd` does with a coordinate beyond the range of the register.
    TexcrdOverflow {
        /// Saturates.
        Clamp = "clamp",
        /// Wraps so that the fraction, and with it a wrapped texture address, is preserved.
        PreserveWrap = "wrap-preserving",
    }
}

named_choice! {
    /// What `texdepth` divides by.
    TexdepthDenominator {
        /// `r5.g` as it is.
        Raw = "raw",
        /// `min(r5.g, 1)`
        Min1 = "min1",
    }
}

named_choice! {
    /// Which components `texkill` looks at in ps_2_x (in ps_1_x it is always the first three).
    TexkillComponents {
        /// x, y and z
        Three = "3",
        /// x, y, z and w
        Four = "4",
    }
}

named_choice! {
    /// What the most negative code of a signed texel means.
    SignedTexelMinimum {
        /// -1, as its neighbour.
        Clamp = "clamp",
        /// Its own value, slightly below -1: -128/127 for 8 bits.
        BelowMinusOne = "below-minus-one",
    }
}

named_choice! {
    /// How a value is rounded into a target, a generated mip level or a depth buffer of fractions.
    TargetRounding {
        /// To the nearest step, halves away from zero.
        Nearest = "nearest",
        /// To the next step towards zero.
        Truncate = "truncate",
    }
}

named_choice! {
    /// How a constant is stored on its way to the register.
    ConstantStorage {
        /// Converted to the register format, once.
        Register = "register",
        /// As sign and 8-bit magnitude `k / 255` (nearest, halves away from zero), clamped to [-1, 1], then converted.
        Snorm8 = "snorm8",
    }
}

named_choice! {
    /// What every result of a pixel program is clamped to when it is written into a register, after shift and
    /// saturation.
    ResultRange {
        /// Nothing but the range of the register format.
        Format = "format",
        /// [-1, 1]: sums and products within an instruction go beyond it, registers do not.
        One = "one",
    }
}

/// In what precision the colours `v#` reach the pixel program. They are clamped to [0, 1] first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColorIterator {
    /// Rounded to the nearest `k / (2^bits - 1)`, then converted to the register format. 1 to 16 bits.
    Unorm(u8),
    /// Converted to the register format without a step between.
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

    /// The choice of this name.
    pub fn from_name(text: &str) -> Option<Self> {
        if text == "full" {
            return Some(Self::Full);
        }
        let bits = text.parse().ok()?;
        (1..=16).contains(&bits).then_some(Self::Unorm(bits))
    }
}

/// How a device computes. Executors read nothing else of a profile; two devices with equal rules give equal bits.
///
/// Every field is a figure or a switch of the profile, under `rules.*`; docs/devices.md has the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rules {
    /// Pixel registers and pixel arithmetic.
    pub format: Format,
    /// The clamp of results on their way into a pixel register.
    pub result_range: ResultRange,
    /// Arithmetic of instructions with `_pp`: the sources are converted into it, the operation is done in it, and the
    /// result is converted to `format`. `None`: the hint is ignored.
    pub partial: Option<Format>,
    /// Vertex registers and vertex arithmetic.
    pub vertex_format: Format,
    /// The format in which attributes are interpolated over a primitive, before delivery in `format`.
    pub iterator_format: Format,
    /// Precision of the colours `v#`.
    pub color_iterator: ColorIterator,
    /// How constants `c#` of pixel programs are stored.
    pub constant_storage: ConstantStorage,
    /// Rounding within `mad`.
    pub mad: MadMode,
    /// Rounding within dot products.
    pub dot: DotOrder,
    /// Rounding within `lrp`.
    pub lrp: LrpMode,
    /// Coordinates beyond the register range.
    pub texcrd_overflow: TexcrdOverflow,
    /// The denominator of `texdepth`.
    pub texdepth_denominator: TexdepthDenominator,
    /// What `texkill` tests in ps_2_x.
    pub texkill_components: TexkillComponents,
    /// The most negative signed texel.
    pub signed_texel_minimum: SignedTexelMinimum,
    /// Whether 0 times anything, infinity and NaN too, is 0 in pixel arithmetic.
    pub zero_times_anything: bool,
    /// Rounding into colour targets of unsigned fractions.
    pub target_rounding: TargetRounding,
    /// Rounding of the means that fill generated mip levels.
    pub mipmap_rounding: TargetRounding,
    /// Rounding into integer depth buffers.
    pub depth_rounding: TargetRounding,
    /// Fraction bits of a window position at set-up, 0 to 8.
    pub subpixel_bits: u8,
    /// Fraction bits of the weights of a linear filter, 0 to 8.
    pub filter_fraction_bits: u8,
    /// Fraction bits of a level of detail, 0 to 8.
    pub lod_fraction_bits: u8,
}
