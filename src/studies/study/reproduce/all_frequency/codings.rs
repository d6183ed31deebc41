//! Codings of Table 1's representatives: possible meanings of "16 bits".

use super::{HOST, RunResult, StudyError};
use crate::all_frequency::code::{CodeOptions, CodedSegment, ScaleOf};
use crate::all_frequency::compressed::CompressedSegment;
use crate::elementary::pow;

/// Scale of the numbers of a representative, which 16 bits divide into steps.
#[derive(Clone, Copy, Debug)]
pub(super) enum Coding {
    /// The largest number of a representative or segment gets the largest code.
    Filled(ScaleOf),
    /// An absolute step, 2^-(halves / 2), for weights of about 1.
    Absolute(u8),
}

/// Codings of representatives; the first is the paper's.
pub(super) const CODINGS: [Coding; 11] = [
    Coding::Filled(ScaleOf::Representative),
    Coding::Filled(ScaleOf::Segment),
    Coding::Absolute(30),
    Coding::Absolute(31),
    Coding::Absolute(32),
    Coding::Absolute(33),
    Coding::Absolute(34),
    Coding::Absolute(35),
    Coding::Absolute(36),
    Coding::Absolute(37),
    Coding::Absolute(38),
];

/// "16 bits rather than 8".
pub(super) const BITS: u8 = 16;

impl Coding {
    /// Returns `true` if the step does not depend on the numbers.
    pub(super) const fn is_absolute(&self) -> bool {
        matches!(self, Self::Absolute(_))
    }

    pub(super) fn code(&self, part: &CompressedSegment) -> Result<CodedSegment, StudyError> {
        let options = self.options();
        let coded = match self {
            Self::Filled(_) => CodedSegment::code(part, options),
            Self::Absolute(halves) => CodedSegment::code_in_steps(part, pow(2.0, -0.5 * f64::from(*halves)), options),
        };
        coded.on(HOST)
    }

    pub(super) fn options(&self) -> CodeOptions {
        let default = CodeOptions { representative_bits: BITS, ..CodeOptions::default() };
        match self {
            Self::Filled(scale) => CodeOptions { scale: *scale, ..default },
            Self::Absolute(_) => default,
        }
    }
}
