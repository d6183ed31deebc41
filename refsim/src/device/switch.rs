//! Switches, and the parsing of rule values.

use super::figure::Confidence;
use super::rules::{
    BorderStorage, ColorClamp, ColorIterator, ConstantStorage, FilterArithmetic, LrpMode, MadMode, MissingChannels,
    ResultRange, Rules, SignedTexelMinimum, SubpixelRounding, TargetRounding, TexcrdOverflow, TexdepthDenominator,
    TexelValues, TexkillComponents, WeightRounding,
};
use crate::num::{Denormals, DotOrder, Format, FormatKind, Overflow, Rounding};

/// A switch: an unpublished property of the hardware, with several allowed values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Switch {
    /// Name, as [`super::Profile::set_switch`] takes it.
    pub name: String,
    /// The allowed values.
    pub values: Vec<String>,
    /// The current value.
    pub current: String,
    /// The default, from the profile's file.
    pub default: String,
    /// The reason for the default.
    pub source: String,
    /// Confidence in the default.
    pub confidence: Confidence,
    /// Description of what the switch controls.
    pub meaning: String,
}

/// Names of the rules that every profile must state, in the order in which they are applied: `format` first, then those
/// that modify it.
pub(super) const RULES: [&str; 29] = [
    "format",
    "result-range",
    "partial",
    "vertex-format",
    "iterator-format",
    "color-iterator",
    "constants",
    "mad",
    "dot",
    "lrp",
    "texcrd-overflow",
    "texdepth-denominator",
    "texkill-components",
    "signed-texel-minimum",
    "zero-times-anything",
    "vertex-zero-times-anything",
    "color-clamp",
    "target-rounding",
    "mipmap-rounding",
    "depth-rounding",
    "subpixel-bits",
    "subpixel-rounding",
    "filter-fraction-bits",
    "lod-fraction-bits",
    "filter-weight-rounding",
    "filter-arithmetic",
    "texel-values",
    "missing-channels",
    "border-storage",
];

/// Names of optional rules: they modify `format` (and `partial`).
pub(super) const FORMAT_RULES: [&str; 4] = ["registers", "rounding", "overflow", "denormals"];

/// The unit of fixed-point registers: a power of two, or one less.
pub(super) fn registers_name(format: Format) -> &'static str {
    if format.denominator() == 1 { "256ths" } else { "255ths" }
}

/// The format with 8 fraction bits in the other unit, or in the same; `None` for other formats.
fn counted_in(format: Format, value: &str) -> Option<Format> {
    let (FormatKind::Fixed { int_bits, frac_bits: 8 } | FormatKind::Normalized { int_bits, frac_bits: 8 }) =
        format.kind
    else {
        return None;
    };
    let layout = match value {
        "255ths" => Format::normalized(int_bits, 8),
        "256ths" => Format::fixed(int_bits, 8),
        _ => None,
    }?;
    Some(Format { kind: layout.kind, ..format })
}

/// Format suffix of an overflow rule.
pub(super) fn overflow_name(overflow: Overflow) -> &'static str {
    match overflow {
        Overflow::Saturate => "sat",
        Overflow::Wrap => "wrap",
        Overflow::Infinity => "inf",
        Overflow::Nv30 => "nvovf",
    }
}

/// Format suffix of a denormal rule.
pub(super) fn denormals_name(denormals: Denormals) -> &'static str {
    match denormals {
        Denormals::Keep => "keep",
        Denormals::Flush => "ftz",
    }
}

fn set_format_rule(format: &mut Format, name: &str, value: &str) -> Option<()> {
    match name {
        "registers" => *format = counted_in(*format, value)?,
        "rounding" => {
            format.rounding = Rounding::ALL.iter().find(|(name, _)| *name == value)?.1;
        }
        "overflow" => {
            let all = [Overflow::Saturate, Overflow::Wrap, Overflow::Infinity, Overflow::Nv30];
            let rule = all.into_iter().find(|o| overflow_name(*o) == value)?;
            let legal = match rule {
                Overflow::Saturate => true,
                Overflow::Wrap => format.is_fixed(),
                Overflow::Infinity | Overflow::Nv30 => !format.is_fixed(),
            };
            format.overflow = legal.then_some(rule)?;
        }
        _ => {
            let all = [Denormals::Keep, Denormals::Flush];
            format.denormals = all.into_iter().find(|d| denormals_name(*d) == value)?;
        }
    }
    Some(())
}

/// Returns `true` if the format's rule of this name has this value among its own.
pub(super) fn sets_rule(mut format: Format, name: &str, value: &str) -> bool {
    set_format_rule(&mut format, name, value).is_some()
}

fn parse_bool(value: &str) -> Option<bool> {
    match value {
        "true" => Some(true),
        "false" => Some(false),
        _ => None,
    }
}

fn parse_bits(value: &str) -> Option<u8> {
    value.parse().ok().filter(|b| *b <= 8)
}

/// Sets one rule from its text; `None` if the text is not a value of the rule.
pub(super) fn apply(rules: &mut Rules, name: &str, value: &str) -> Option<()> {
    match name {
        "format" => rules.format = value.parse().ok()?,
        "result-range" => rules.result_range = ResultRange::from_name(value)?,
        "partial" if value == "none" => rules.partial = None,
        "partial" => rules.partial = Some(value.parse().ok()?),
        "vertex-format" => rules.vertex_format = value.parse().ok()?,
        "iterator-format" => rules.iterator_format = value.parse().ok()?,
        "color-iterator" => rules.color_iterator = ColorIterator::from_name(value)?,
        "constants" => rules.constant_storage = ConstantStorage::from_name(value)?,
        "mad" => rules.mad = MadMode::from_name(value)?,
        "dot" => {
            rules.dot = match value {
                "sequential" => DotOrder::Sequential,
                "tree" => DotOrder::Tree,
                "exact" => DotOrder::Exact,
                _ => return None,
            }
        }
        "lrp" => rules.lrp = LrpMode::from_name(value)?,
        "texcrd-overflow" => rules.texcrd_overflow = TexcrdOverflow::from_name(value)?,
        "texdepth-denominator" => rules.texdepth_denominator = TexdepthDenominator::from_name(value)?,
        "texkill-components" => rules.texkill_components = TexkillComponents::from_name(value)?,
        "signed-texel-minimum" => rules.signed_texel_minimum = SignedTexelMinimum::from_name(value)?,
        "zero-times-anything" => rules.zero_times_anything = parse_bool(value)?,
        "vertex-zero-times-anything" => rules.vertex_zero_times_anything = parse_bool(value)?,
        "color-clamp" => rules.color_clamp = ColorClamp::from_name(value)?,
        "target-rounding" => rules.target_rounding = TargetRounding::from_name(value)?,
        "mipmap-rounding" => rules.mipmap_rounding = TargetRounding::from_name(value)?,
        "depth-rounding" => rules.depth_rounding = TargetRounding::from_name(value)?,
        "subpixel-bits" => rules.subpixel_bits = parse_bits(value)?,
        "subpixel-rounding" => rules.subpixel_rounding = SubpixelRounding::from_name(value)?,
        "filter-fraction-bits" => rules.filter_fraction_bits = parse_bits(value)?,
        "lod-fraction-bits" => rules.lod_fraction_bits = parse_bits(value)?,
        "filter-weight-rounding" => rules.filter_weight_rounding = WeightRounding::from_name(value)?,
        "filter-arithmetic" => rules.filter_arithmetic = FilterArithmetic::from_name(value)?,
        "texel-values" => rules.texel_values = TexelValues::from_name(value)?,
        "missing-channels" => rules.missing_channels = MissingChannels::from_name(value)?,
        "border-storage" => rules.border_storage = BorderStorage::from_name(value)?,
        "registers" | "rounding" | "overflow" | "denormals" => {
            set_format_rule(&mut rules.format, name, value)?;
            if let Some(partial) = &mut rules.partial {
                // fp16 of NV30 keeps its subnormals whatever fp32 does.
                if name != "denormals" {
                    set_format_rule(partial, name, value)?;
                }
            }
        }
        _ => return None,
    }
    Some(())
}
