//! The result of an operation: bits and exception flags.

use bitflags::bitflags;

bitflags! {
    /// The five IEEE 754 exceptions, in the bit order Berkeley TestFloat prints.
    ///
    /// Flags are returned by value, never kept as state; callers OR them together.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub struct Flags: u8 {
        /// The result differs from the exact real result.
        const INEXACT = 1;
        /// The result is tiny (see [`Tininess`](super::Tininess)) and inexact. Floats only.
        const UNDERFLOW = 2;
        /// The result was too large for the format. Always together with `INEXACT`.
        const OVERFLOW = 4;
        /// A finite operand gave an exactly infinite result (`1/0`, `log2 0`).
        const DIVIDE_BY_ZERO = 8;
        /// There is no real result (`0/0`, `sqrt -1`), or an operand is a signalling NaN.
        const INVALID = 16;
    }
}

/// Result bits (in the low bits of the format's width) and the exceptions raised.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[must_use = "an operation has no effect besides its outcome"]
pub struct Outcome {
    /// The bit pattern, upper bits zero.
    pub bits: u32,
    /// The exceptions.
    pub flags: Flags,
}

impl Outcome {
    /// An outcome without exceptions.
    pub const fn exact(bits: u32) -> Outcome {
        Outcome { bits, flags: Flags::empty() }
    }

    /// An outcome with the given exceptions.
    pub const fn new(bits: u32, flags: Flags) -> Outcome {
        Outcome { bits, flags }
    }

    /// Adds exceptions to the outcome; for operations of several steps.
    pub fn also(self, flags: Flags) -> Outcome {
        Outcome { bits: self.bits, flags: self.flags | flags }
    }
}
