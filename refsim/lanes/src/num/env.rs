//! A format together with the rule that determines the `UNDERFLOW` flag.

use super::Format;

/// Detection of tininess, which affects `UNDERFLOW` only (IEEE 754-2019, 7.5).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Tininess {
    /// Before rounding: the exact result is nonzero and below the smallest normal number.
    Before,
    /// After rounding: the result, rounded to the format's precision with an unbounded exponent, is nonzero and below
    /// the smallest normal number. The default, as in TestFloat 3e's `testfloat_gen`.
    #[default]
    After,
}

/// Parameters of an operation. Every operation takes `impl Into<Env>`: pass a [`Format`], a `&Format`, or
/// `format.tininess(Tininess::Before)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Env {
    /// The format of operands and result.
    pub format: Format,
    /// Detection of tininess.
    pub tininess: Tininess,
}

impl From<Format> for Env {
    fn from(format: Format) -> Env {
        Env { format, tininess: Tininess::default() }
    }
}

impl From<&Format> for Env {
    fn from(format: &Format) -> Env {
        Env::from(*format)
    }
}

impl Format {
    /// Returns the format with the given tininess rule.
    pub const fn tininess(self, tininess: Tininess) -> Env {
        Env { format: self, tininess }
    }
}
