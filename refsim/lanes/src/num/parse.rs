//! Parsing and printing of format strings: `s3.12`, `n3.8:rna`, `e5m10:rtz`, `fp24:rne:ftz`, `e4m3fn:sat`, `e8m0`.

use std::fmt;
use std::str::FromStr;

use super::format::{Format, FormatKind};
use super::rules::{Denormals, Encoding, Overflow, Rounding, Specials, Unit};

/// Aliases of layouts, and `e8m0`, whose name does not follow the pattern of the other layouts.
const ALIASES: [(&str, Format); 7] = [
    ("ps14", Format::S3_12),
    ("fx12", Format::FX12),
    ("fp16", Format::FP16),
    ("fp24", Format::FP24),
    ("fp32", Format::FP32),
    ("bf16", Format::BF16),
    ("e8m0", Format::E8M0),
];

/// Suffixes of the layout's name for encodings of floats; the longer suffix first.
const ENCODINGS: [(&str, Encoding); 2] = [("fnuz", Encoding::UnsignedZero), ("fn", Encoding::Finite)];

/// Error of parsing a number format. Each message contains the whole string and what to write instead.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
pub enum FormatError {
    /// The part before the first colon is not a layout.
    #[error(
        "number format `{text}`: expected a layout `sI.F`, `nI.F`, `eXmY`, `eXmYfn`, `eXmYfnuz` or one of ps14, fx12, fp16, fp24, fp32, bf16, e8m0, found `{found}`"
    )]
    #[diagnostic(
        code(num::format_layout),
        help(
            "write for example `s3.12` (fixed point), `n3.8` (normalized integers), `e5m10` (float) or `e4m3fn` (float without infinity)"
        )
    )]
    Layout {
        /// The whole string.
        text: String,
        /// The part at fault.
        found: String,
    },
    /// A layout whose bit counts are out of range.
    #[error("number format `{text}`: expected {expected}, found `{found}`")]
    #[diagnostic(
        code(num::format_range),
        help(
            "fixed point has up to 32 bits, normalized integers up to 16; floats are `e2m1` to `e8m23`, or up to `e7m23fn` without infinity"
        )
    )]
    Range {
        /// The whole string.
        text: String,
        /// The part at fault.
        found: String,
        /// The allowed range, in words.
        expected: &'static str,
    },
    /// An unknown suffix.
    #[error(
        "number format `{text}`: expected a suffix :rne :rna :rtz :rdn :rup :rod :rst, :sat :wrap :inf :nvovf, :keep :ftz, :ieee :nv or a card's unit :nv2x :nv3x-legacy :nv3x :gt200 :gt200-zero-wins, found `:{found}` at character {at}"
    )]
    #[diagnostic(
        code(num::format_suffix),
        help("remove the suffix to get the default (fixed: rne, sat; float: rne, inf, keep, ieee)")
    )]
    Suffix {
        /// The whole string.
        text: String,
        /// The suffix without its colon.
        found: String,
        /// Where the suffix starts, in characters from 0.
        at: usize,
    },
    /// A suffix that doesn't apply to the kind of layout.
    #[error("number format `{text}`: `:{found}` at character {at} is for {kind} only")]
    #[diagnostic(
        code(num::format_kind),
        help(
            "fixed point allows :sat and :wrap; floats allow :inf, :sat, :nvovf, :keep, :ftz, :ieee, :nv and, in e8m23, the units of cards"
        )
    )]
    WrongKind {
        /// The whole string.
        text: String,
        /// The suffix without its colon.
        found: String,
        /// Where the suffix starts, in characters from 0.
        at: usize,
        /// `fixed point` or `floats`.
        kind: &'static str,
    },
    /// Two suffixes that set the same rule.
    #[error("number format `{text}`: expected one {rule} rule, found a second, `:{found}`, at character {at}")]
    #[diagnostic(code(num::format_twice), help("keep one of the two suffixes"))]
    Twice {
        /// The whole string.
        text: String,
        /// The second suffix without its colon.
        found: String,
        /// Where the suffix starts, in characters from 0.
        at: usize,
        /// The rule that is set twice.
        rule: &'static str,
    },
    /// A card's unit, combined with a format in which it does not compute.
    #[error(
        "number format `{text}`: expected `e8m23:{found}`, with no other suffix than :rtz (GT200), found another layout or more suffixes"
    )]
    #[diagnostic(
        code(num::format_unit),
        help("units of cards compute in single precision, by their own rules; remove the other suffixes")
    )]
    Unit {
        /// The whole string.
        text: String,
        /// The suffix without its colon.
        found: &'static str,
    },
    /// A format that registers cannot have.
    #[error("number format `{text}`: registers and instructions cannot have this format, because {reason}")]
    #[diagnostic(
        code(num::format_registers),
        help(
            "devices allow every layout but `e8m0`, every rounding but `:rst`, and `:rod` only for floats; `crossbar alu` \
             computes with all of them"
        )
    )]
    Registers {
        /// The format.
        text: String,
        /// The reason, a clause.
        reason: &'static str,
    },
}

impl Format {
    /// Returns the format if registers and instructions of a device can have it. They cannot have [`Format::E8M0`],
    /// [`Rounding::Stochastic`] and, in fixed point and normalized integers, [`Rounding::Odd`].
    ///
    /// # Errors
    /// [`FormatError::Registers`].
    pub fn for_registers(self) -> Result<Format, FormatError> {
        let reason = match self.rounding {
            Rounding::Stochastic(_) => "it needs numbered operations, and executors compute many pixels at once",
            Rounding::Odd if !matches!(self.kind, FormatKind::Float { .. }) => {
                "rounding to odd is for intermediate results, which are floats"
            }
            _ if !self.is_signed() => "scales have neither zero nor negative numbers",
            _ => return Ok(self),
        };
        Err(FormatError::Registers { text: self.to_string(), reason })
    }
}

impl FromStr for Format {
    type Err = FormatError;

    fn from_str(text: &str) -> Result<Format, FormatError> {
        let mut parts = text.split(':');
        let layout = parts.next().unwrap_or_default();
        let mut format = parse_layout(text, layout)?;
        let mut at = layout.chars().count();
        let mut set = [false; 5];
        for suffix in parts {
            apply(&mut format, &mut set, text, suffix, at)?;
            at += 1 + suffix.chars().count();
        }
        let Some(found) = format.unit.name() else { return Ok(format) };
        let nearest = format.with_rounding(Rounding::NearestEven);
        let rounds = format == nearest
            || format.rounding == Rounding::TowardZero && matches!(format.unit, Unit::Gt200 | Unit::Gt200ZeroWins);
        if nearest == Self::FP32.with_unit(format.unit) && rounds {
            Ok(format)
        } else {
            Err(FormatError::Unit { text: text.to_owned(), found })
        }
    }
}

/// Parses `sI.F`, `nI.F`, `eXmY` with or without an encoding, or an alias.
fn parse_layout(text: &str, layout: &str) -> Result<Format, FormatError> {
    if let Some((_, format)) = ALIASES.iter().find(|(name, _)| *name == layout) {
        return Ok(*format);
    }
    let range = |expected| FormatError::Range { text: text.to_owned(), found: layout.to_owned(), expected };
    if let Some((i, f)) = split_counts(layout, 's', '.') {
        return Format::fixed(i, f).ok_or_else(|| range("1 to 31 integer and fraction bits together"));
    }
    if let Some((i, f)) = split_counts(layout, 'n', '.') {
        return Format::normalized(i, f)
            .ok_or_else(|| range("2 to 8 fraction bits, and 15 integer and fraction bits together"));
    }
    for (name, encoding) in ENCODINGS {
        if let Some((x, m)) = layout.strip_suffix(name).and_then(|counts| split_counts(counts, 'e', 'm')) {
            return Format::float(x, m)
                .filter(|_| x < 8)
                .map(|format| format.with_encoding(encoding))
                .ok_or_else(|| range("2 to 7 exponent and 1 to 23 mantissa bits in floats without infinity"));
        }
    }
    if let Some((x, m)) = split_counts(layout, 'e', 'm') {
        return Format::float(x, m).ok_or_else(|| range("2 to 8 exponent and 1 to 23 mantissa bits"));
    }
    Err(FormatError::Layout { text: text.to_owned(), found: layout.to_owned() })
}

/// Parses the bit counts of `<lead>A<mid>B`; counts that don't fit a byte become 255, which is out of every range.
fn split_counts(layout: &str, lead: char, mid: char) -> Option<(u8, u8)> {
    let (a, b) = layout.strip_prefix(lead)?.split_once(mid)?;
    let digits = |s: &str| !s.is_empty() && s.bytes().all(|c| c.is_ascii_digit());
    (digits(a) && digits(b)).then(|| (a.parse().unwrap_or(255), b.parse().unwrap_or(255)))
}

fn rounding(suffix: &str) -> Option<Rounding> {
    let all = Rounding::ALL.into_iter().chain([("rst", Rounding::Stochastic(0))]);
    all.into_iter().find(|(name, _)| *name == suffix).map(|(_, rounding)| rounding)
}

fn apply(format: &mut Format, set: &mut [bool; 5], text: &str, suffix: &str, at: usize) -> Result<(), FormatError> {
    let fixed = format.is_fixed();
    let unit = Unit::CARDS.into_iter().find(|(name, _)| *name == suffix);
    // Rule index, and the kind of layout that the suffix applies to.
    let (rule, only) = match suffix {
        name if rounding(name).is_some() => (0, None),
        "sat" => (1, None),
        "wrap" => (1, Some(true)),
        "inf" | "nvovf" => (1, Some(false)),
        "keep" | "ftz" => (2, Some(false)),
        "ieee" | "nv" => (3, Some(false)),
        _ if unit.is_some() => (4, Some(false)),
        _ => return Err(FormatError::Suffix { text: text.to_owned(), found: suffix.to_owned(), at }),
    };
    if let Some(for_fixed) = only.filter(|k| *k != fixed) {
        let kind = if for_fixed { "fixed point" } else { "floats" };
        return Err(FormatError::WrongKind { text: text.to_owned(), found: suffix.to_owned(), at, kind });
    }
    if std::mem::replace(&mut set[rule], true) {
        let rule = ["rounding", "overflow", "denormal", "special-value", "unit"][rule];
        return Err(FormatError::Twice { text: text.to_owned(), found: suffix.to_owned(), at, rule });
    }
    if let Some(rounding) = rounding(suffix) {
        format.rounding = rounding;
        return Ok(());
    }
    if let Some((_, unit)) = unit {
        *format = format.with_unit(unit);
        return Ok(());
    }
    match suffix {
        "sat" => format.overflow = Overflow::Saturate,
        "wrap" => format.overflow = Overflow::Wrap,
        "inf" => format.overflow = Overflow::Infinity,
        "nvovf" => format.overflow = Overflow::Nv30,
        "keep" => format.denormals = Denormals::Keep,
        "ftz" => format.denormals = Denormals::Flush,
        "ieee" => format.specials = Specials::Ieee,
        _ => format.specials = Specials::Nv,
    }
    Ok(())
}

/// The canonical string: the layout spelled out, then the rules that differ from the defaults.
impl fmt::Display for Format {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = match self.kind {
            FormatKind::Fixed { int_bits, frac_bits } => format!("s{int_bits}.{frac_bits}"),
            FormatKind::Normalized { int_bits, frac_bits } => format!("n{int_bits}.{frac_bits}"),
            FormatKind::Float { exp_bits, man_bits } => {
                let encoding = ENCODINGS.iter().find(|(_, encoding)| *encoding == self.encoding);
                format!("e{exp_bits}m{man_bits}{}", encoding.map_or("", |(name, _)| name))
            }
        };
        if self.rounding != Rounding::NearestEven {
            text.push(':');
            text.push_str(self.rounding.name());
        }
        text.push_str(match (self.is_fixed(), self.overflow) {
            (true, Overflow::Wrap) => ":wrap",
            (false, Overflow::Saturate) => ":sat",
            (false, Overflow::Nv30) => ":nvovf",
            _ => "",
        });
        if !self.is_fixed() && self.denormals == Denormals::Flush && !self.unit.is_card() {
            text.push_str(":ftz");
        }
        if !self.is_fixed() && self.specials == Specials::Nv {
            text.push_str(":nv");
        }
        if let Some(name) = self.unit.name() {
            text.push(':');
            text.push_str(name);
        }
        out.pad(&text)
    }
}

impl TryFrom<String> for Format {
    type Error = FormatError;

    fn try_from(text: String) -> Result<Format, FormatError> {
        text.parse()
    }
}

impl From<Format> for String {
    fn from(format: Format) -> String {
        format.to_string()
    }
}
