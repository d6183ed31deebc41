//! A format together with the one choice that touches flags only.

use super::Format;

/// When a result counts as tiny, which decides `UNDERFLOW` and nothing else (IEEE 754-2019, 7.5).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Tininess {
    /// The exact result is nonzero and below the smallest normal number.
    Before,
    /// It still is when rounded to the format's precision as if the exponent had no lower end. The default, because
    /// it is that of TestFloat 3e's `testfloat_gen`.
    #[default]
    After,
}

/// What an operation needs to know. Every operation takes `impl Into<Env>`: pass a [`Format`], a `&Format`, or
/// `format.tininess(Tininess::Before)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Env {
    /// The format of operands and result.
    pub format: Format,
    /// When a result counts as tiny.
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
    /// The format with a stated rule for the `UNDERFLOW` flag.
    pub const fn tininess(self, tininess: Tininess) -> Env {
        Env { format: self, tininess }
    }
}
