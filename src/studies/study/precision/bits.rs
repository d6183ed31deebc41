//! Formats by their bits: two families, and the formats of cards.

use std::ops::RangeInclusive;

use refsim::num::{Denormals, Encoding, Format, FormatKind, Overflow};

/// Formats of emulated cards and of later GPUs.
pub(super) const NAMED: [(&str, FormatBits); 8] = [
    ("s3.12", FormatBits::fixed(3, 12)),
    ("s0.15", FormatBits::fixed(0, 15)),
    ("e4m3", FormatBits::float(4, 3)),
    ("e5m2", FormatBits::float(5, 2)),
    ("bf16", FormatBits::float(8, 7)),
    ("fp16", FormatBits::float(5, 10)),
    ("fp24", FormatBits::float(7, 16)),
    ("fp32", FormatBits::float(8, 23)),
];

/// Family of formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FormatFamily {
    /// Floats, `eXmY`.
    Float,
    /// Fixed point, `sI.F`.
    Fixed,
}

impl FormatFamily {
    /// Name, as on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Float => "float",
            Self::Fixed => "fixed",
        }
    }

    /// Possible numbers of range bits: exponent bits, or bits of the integer part.
    pub(super) fn range_bits(self) -> RangeInclusive<u8> {
        match self {
            Self::Float => 2..=8,
            Self::Fixed => 0..=31,
        }
    }

    /// Possible numbers of precision bits, with `range` range bits: mantissa bits, or bits of the fraction.
    pub(super) fn digit_bits(self, range: u8) -> RangeInclusive<u8> {
        match self {
            Self::Float => 1..=23,
            Self::Fixed => u8::from(range == 0)..=31 - range.min(31),
        }
    }

    /// Noun for the bits that decide the precision.
    pub(super) fn digits(self) -> &'static str {
        match self {
            Self::Float => "mantissa bits",
            Self::Fixed => "fraction bits",
        }
    }
}

/// Layout of a format of one of the families.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct FormatBits {
    pub(super) family: FormatFamily,
    /// Exponent bits, or integer bits without the sign.
    pub(super) range: u8,
    /// Mantissa bits, or fraction bits.
    pub(super) digits: u8,
}

/// One format per instruction, in the order of the program; `None` is the registers' format.
pub(super) type Assignment = Vec<Option<FormatBits>>;

impl FormatBits {
    pub(super) const fn float(range: u8, digits: u8) -> Self {
        Self { family: FormatFamily::Float, range, digits }
    }

    pub(super) const fn fixed(range: u8, digits: u8) -> Self {
        Self { family: FormatFamily::Fixed, range, digits }
    }

    /// Width in bits, with the sign.
    pub(super) fn width(self) -> u32 {
        1 + u32::from(self.range) + u32::from(self.digits)
    }

    /// Formats with one bit less: first of precision, then of range.
    pub(super) fn narrower(self) -> impl Iterator<Item = Self> {
        let Self { family, range, digits } = self;
        let fewer = [(Some(range), digits.checked_sub(1)), (range.checked_sub(1), Some(digits))];
        fewer.into_iter().filter_map(move |(range, digits)| {
            let bits = Self { family, range: range?, digits: digits? };
            let is_legal =
                family.range_bits().contains(&bits.range) && family.digit_bits(bits.range).contains(&bits.digits);
            is_legal.then_some(bits)
        })
    }

    pub(super) fn narrowest(family: FormatFamily) -> Self {
        let range = *family.range_bits().start();
        Self { family, range, digits: *family.digit_bits(range).start() }
    }

    /// Format of this layout with the rounding of `rules`, and its other rules if `rules` is of the same family.
    pub(super) fn format(self, rules: Format) -> Format {
        let Self { family, range, digits } = self;
        let (kind, overflow) = match family {
            FormatFamily::Float => (FormatKind::Float { exp_bits: range, man_bits: digits }, Overflow::Infinity),
            FormatFamily::Fixed => (FormatKind::Fixed { int_bits: range, frac_bits: digits }, Overflow::Saturate),
        };
        let alike = rules.is_fixed() == (family == FormatFamily::Fixed);
        Format {
            kind,
            encoding: Encoding::Ieee,
            overflow: if alike { rules.overflow } else { overflow },
            denormals: if alike { rules.denormals } else { Denormals::Keep },
            ..rules
        }
    }
}

impl std::fmt::Display for FormatBits {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.family {
            FormatFamily::Float => write!(f, "e{}m{}", self.range, self.digits),
            FormatFamily::Fixed => write!(f, "s{}.{}", self.range, self.digits),
        }
    }
}
