//! Switches, and the parsing of rule values.

use super::figure::Confidence;
use super::rules::Rules;
use crate::num::{Denormals, Format, FormatKind, Overflow, Rounding};

/// A switch: an unpublished property of the hardware, with several allowed values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Switch {
    /// Name, for [`super::Profile::set_switch`].
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

/// Names of optional rules: they modify `format` (and `partial`).
pub(super) const FORMAT_RULES: [&str; 4] = ["registers", "rounding", "overflow", "denormals"];

/// The unit of fixed-point registers, by its denominator: a power of two, or one less.
pub(super) fn registers_name(format: Format) -> &'static str {
    if format.denominator() == 1 { "256ths" } else { "255ths" }
}

/// The format with 8 fraction bits in the unit that `value` names; `None` for other formats.
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

/// Returns `true` if the format has a rule with this name that can have this value.
pub(super) fn sets_rule(mut format: Format, name: &str, value: &str) -> bool {
    set_format_rule(&mut format, name, value).is_some()
}

/// Sets one rule, or a rule of the format, from its text; `None` if the text is not a value of the rule.
pub(super) fn apply(rules: &mut Rules, name: &str, value: &str) -> Option<()> {
    if !FORMAT_RULES.contains(&name) {
        return rules.set(name, value);
    }
    set_format_rule(&mut rules.format, name, value)?;
    if let Some(partial) = &mut rules.partial {
        // fp16 of NV30 keeps its subnormals, independently of fp32.
        if name != "denormals" {
            set_format_rule(partial, name, value)?;
        }
    }
    Some(())
}
