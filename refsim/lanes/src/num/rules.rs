//! The rules of a format: the meaning of patterns, and the rounding of exact results.

/// Encoding of infinities, NaN and zeros in a float.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Encoding {
    /// IEEE 754: the largest exponent field encodes infinity and NaN, and the bias is `2^(X-1) - 1`. Fixed point also
    /// has this value.
    Ieee,
    /// `eXmYfn`, "finite": the largest field encodes numbers like any other, and there is no infinity. The pattern of
    /// all ones is NaN, of either sign; in formats of at most 6 bits it is a number too, and there is no NaN.
    Finite,
    /// `eXmYfnuz`, "finite, unsigned zero": numbers in the largest field, and no infinity. The pattern of -0 is the
    /// only NaN. The bias is larger by one, `2^(X-1)`.
    UnsignedZero,
    /// `e8m0`: powers of two from `2^-127` to `2^127`, without sign and without zero; all ones is NaN. Used for scales
    /// of blocks ([`super::block`]).
    Scale,
}

/// Direction in which inexact results are rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rounding {
    /// To the nearest, ties to the even pattern (`:rne`).
    NearestEven,
    /// To the nearest, ties away from zero (`:rna`).
    NearestAway,
    /// Truncation of the magnitude (`:rtz`).
    TowardZero,
    /// Toward minus infinity (`:rdn`): the effect of dropping low bits of a two's complement product.
    Down,
    /// Toward plus infinity (`:rup`).
    Up,
    /// To odd (`:rod`): of the two neighbours of an inexact result, the one whose last bit is 1. Such a result can be
    /// rounded again to a format with at least two bits less, in any direction, as if it were exact.
    Odd,
    /// Stochastic (`:rst`, with the word 0): the magnitude is rounded up if the sum of two integers, the first 32 bits
    /// of the discarded fraction and this word, is at least `2^32`. A fraction of 1/4 is rounded up for 1/4 of all
    /// words. Each operation has a word ([`super::random_word`]), which all its roundings use. Devices reject it
    /// ([`super::Format::for_registers`]).
    Stochastic(u32),
}

impl Rounding {
    /// Every rounding except stochastic rounding, by its name in format strings.
    pub const ALL: [(&'static str, Self); 6] = [
        ("rne", Self::NearestEven),
        ("rna", Self::NearestAway),
        ("rtz", Self::TowardZero),
        ("rdn", Self::Down),
        ("rup", Self::Up),
        ("rod", Self::Odd),
    ];

    /// The name in format strings and switches, without colon.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, rounding)| *rounding == self).map_or("rst", |(name, _)| name)
    }

    /// Returns `true` if every inexact magnitude with this sign is rounded away from zero.
    pub(crate) const fn is_outward(self, negative: bool) -> bool {
        matches!((self, negative), (Self::Down, true) | (Self::Up, false))
    }
}

/// Treatment of results out of range.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Overflow {
    /// The nearest end of the range (`:sat`). A float with this rule never makes an infinity from finite operands:
    /// division by zero and `log2 0` also give the largest finite number (Direct3D's `log(0) = -FLT_MAX`).
    Saturate,
    /// Modulo the width (`:wrap`), fixed point only. Exactly infinite results, and overflowing exponentials, have no
    /// residue and saturate.
    Wrap,
    /// IEEE 754 (`:inf`): infinity or the largest finite number, according to the rounding direction. Encodings without
    /// infinity give NaN in its place, and encodings without both the largest finite number. Floats only.
    Infinity,
    /// `NV_fragment_program` (`:nvovf`): exact magnitudes of `2^(emax+1)` and more become infinity, smaller magnitudes
    /// at most the largest finite number, in every rounding direction. Floats only.
    Nv30,
}

/// Treatment of subnormal numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Denormals {
    /// Gradual underflow (`:keep`).
    Keep,
    /// Subnormal operands count as zero, and a result whose rounded value is subnormal becomes zero (`:ftz`). The
    /// sign is kept. A flushed result raises `UNDERFLOW` and `INEXACT`; a flushed operand raises nothing.
    Flush,
}

/// Conventions for NaN and zeros in operations that choose a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Specials {
    /// Direct3D 9 on IEEE 754 values (`:ieee`): `min` is `a < b ? a : b` and `max` is `a >= b ? a : b`, so a NaN as
    /// either operand gives `b`; saturation turns NaN into 0.
    Ieee,
    /// `NV_fragment_program` (`:nv`): `min`/`max` with a NaN give NaN, and treat -0 as less than +0; saturation keeps
    /// NaN.
    Nv,
}

/// The arithmetic unit that computes: an ideal unit, or a card's unit as measured ([`super::unit`]). Units of cards
/// require `e8m23`; they have their own rounding, overflow, subnormal numbers and special values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unit {
    /// Every result is the exact one, rounded once by the rules of the format.
    Ideal,
    /// The vertex unit of NV20 and NV25 (`:nv2x`).
    Nv2x,
    /// The vertex unit of NV30 and NV35 as programs of GL_NV_vertex_program see it (`:nv3x-legacy`).
    Nv3xLegacy,
    /// The vertex unit of NV30 and NV35 as programs of GL_NV_vertex_program2 see it (`:nv3x`).
    Nv3x,
    /// The unit of GT200 (`:gt200`); it rounds to nearest, or toward zero if the format does.
    Gt200,
    /// The unit of GT200 in the state in which 0 times anything is 0 (`:gt200-zero-wins`).
    Gt200ZeroWins,
}

impl Unit {
    /// Every unit of a card, by its name in format strings.
    pub const CARDS: [(&'static str, Self); 5] = [
        ("nv2x", Self::Nv2x),
        ("nv3x-legacy", Self::Nv3xLegacy),
        ("nv3x", Self::Nv3x),
        ("gt200", Self::Gt200),
        ("gt200-zero-wins", Self::Gt200ZeroWins),
    ];

    /// Returns `true` for units of cards.
    #[inline]
    pub const fn is_card(self) -> bool {
        !matches!(self, Self::Ideal)
    }

    /// Returns `true` for vertex units, whose instructions combine several steps of other units.
    pub const fn is_vertex_unit(self) -> bool {
        matches!(self, Self::Nv2x | Self::Nv3xLegacy | Self::Nv3x)
    }

    /// The name in format strings, without colon; `None` for the ideal unit.
    pub fn name(self) -> Option<&'static str> {
        Self::CARDS.iter().find(|(_, unit)| *unit == self).map(|(name, _)| *name)
    }
}
