//! Arithmetic rules of a device, resolved to plain values for the executors.

use super::rule_values::{
    AddMode, BorderStorage, ColorClamp, ColorIterator, ConstantStorage, FilterArithmetic, LrpMode, MadMode,
    MissingChannels, ResultRange, RuleValue, SignedTexelMinimum, SubpixelGrid, SubpixelRounding, TargetRounding,
    TexcrdOverflow, TexdepthDenominator, TexelValues, TexkillComponents, WeightRounding,
};
use super::storage_formats::StorageFormats;
use crate::isa::Version;
use crate::num::{DotOrder, Format, Rounding, Specials};

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
                    T::from_text(&text).ok_or_else(|| format!("rules.{name}: no value of this rule is `{text}`"))
                }
                Ok(Self {
                    $($field: value($text, text($text))?,)*
                    $($beside: Default::default(),)*
                })
            }

            /// Sets one rule from its text; `None` if there is no such rule, or the text is not a value of the rule.
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
    /// Arithmetic rules of a device. Executors read no other part of a profile, so devices with equal rules give equal
    /// bits.
    ///
    /// Every field is a figure or a switch of the profile, under `rules.*` (docs/devices.md, "The switches"). Rules are
    /// added as cards are measured, so code outside this crate takes the rules of a [`Profile`](super::Profile) and
    /// changes single fields.
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
        /// Rounding of products of pixel arithmetic, if different from the rounding of sums. It applies to `mul`, to
        /// `mad` with two roundings, and to dot products except exact ones.
        product_rounding: Option<Rounding> = "product-rounding",
        /// Sums of two numbers of pixel arithmetic.
        add: AddMode = "add",
        /// Rounding within `mad` of pixel arithmetic; vertices and addresses have two roundings.
        mad: MadMode = "mad",
        /// Rounding within dot products of pixel arithmetic; dot products of vertices and addresses are sequential.
        dot: DotOrder = "dot",
        /// Rounding within `lrp`.
        lrp: LrpMode = "lrp",
        /// Treatment of coordinates outside the register range in `texcrd`.
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
        /// Storage formats of pixel programs, empty for real cards ([`super::Profile::set_storage_format`]).
        storage: StorageFormats,
        /// Format of the sums of dot products in pixel programs, if different from the operation's; `None` for real
        /// cards ([`super::Profile::set_accumulator`]).
        accumulator: Option<Format>,
    }
}

impl Rules {
    /// Computation of `lrp` by language: OpenGL specifies `t0 * t1 + (1 - t0) * t2` (GL_NV_fragment_program and
    /// GL_ARB_fragment_program, sections on LRP); Direct3D leaves it to the card.
    pub fn lrp_in(&self, version: Version) -> LrpMode {
        if version.is_fragment_program() { LrpMode::TwoProducts } else { self.lrp }
    }

    /// `true` if MIN and MAX are `a > b ? b : a` and `a > b ? a : b`, where no comparison with NaN holds
    /// (GL_ARB_fragment_program 3.11.5.16 and .17). NVIDIA's unit has its own rule in either language.
    pub fn compares_in(version: Version, format: &Format) -> bool {
        version == Version::ArbFp1_0 && format.specials == Specials::Ieee
    }

    /// The result of FRC where `x - floor(x)` rounds to 1; `None` if that is 1. OpenGL's result is below 1
    /// (GL_NV_fragment_program 3.11.5.10, GL_ARB_fragment_program 3.11.5.11), Direct3D's ranges "from 0.0 through 1.0".
    /// Fixed point represents every fraction exactly.
    pub fn frc_instead_of_one(version: Version, format: &Format) -> Option<u32> {
        (version.is_fragment_program() && !format.is_fixed()).then(|| format.one() - 1)
    }
}
