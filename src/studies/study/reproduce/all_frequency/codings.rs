//! Codings of Table 1's representatives: the readings of "16 bits", and fewer bits.

use super::{HOST, StudyError, failed};
use crate::all_frequency::code::{CodeOptions, CodedSegment, ScaleOf};
use crate::all_frequency::compressed::CompressedSegment;
use crate::elementary::pow;

/// Codings of representatives: the first as in the paper, then other readings of its 16 bits, then fewer bits.
pub(super) const CODINGS: [Coding; 14] = [
    Coding { name: "16_bits", bits: 16, steps: CodingSteps::Filled(ScaleOf::Representative) },
    Coding { name: "16_bits_step_per_segment", bits: 16, steps: CodingSteps::Filled(ScaleOf::Segment) },
    Coding::absolute("step_2^-15", 30),
    Coding::absolute("step_2^-15.5", 31),
    Coding::absolute("step_2^-16", 32),
    Coding::absolute("step_2^-16.5", 33),
    Coding::absolute("step_2^-17", 34),
    Coding::absolute("step_2^-17.5", 35),
    Coding::absolute("step_2^-18", 36),
    Coding::absolute("step_2^-18.5", 37),
    Coding::absolute("step_2^-19", 38),
    Coding { name: "steps_of_12_bits", bits: 12, steps: CodingSteps::Filled(ScaleOf::Representative) },
    Coding { name: "steps_of_10_bits", bits: 10, steps: CodingSteps::Filled(ScaleOf::Representative) },
    Coding { name: "steps_of_8_bits", bits: 8, steps: CodingSteps::Filled(ScaleOf::Representative) },
];

/// Coding of representatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coding {
    pub(super) name: &'static str,
    /// Bits of a number.
    pub(super) bits: u8,
    steps: CodingSteps,
}

/// Range of which the bits are.
#[derive(Clone, Copy, Debug)]
enum CodingSteps {
    /// The largest number of a representative or segment fills the bits.
    Filled(ScaleOf),
    /// An absolute step, given by its number of halvings of 1 times two, where weights are about 1.
    Absolute(u8),
}

impl Coding {
    /// 16 bits of a fixed range in steps of 2^-(halves / 2).
    const fn absolute(name: &'static str, halves: u8) -> Self {
        Self { name, bits: 16, steps: CodingSteps::Absolute(halves) }
    }

    /// Returns `true` if the step does not depend on the numbers.
    pub(super) const fn is_absolute(&self) -> bool {
        matches!(self.steps, CodingSteps::Absolute(_))
    }

    /// Codes a compressed segment.
    pub(super) fn code(&self, part: &CompressedSegment) -> Result<CodedSegment, StudyError> {
        let options = CodeOptions { representative_bits: self.bits, ..CodeOptions::default() };
        let coded = match self.steps {
            CodingSteps::Filled(scale) => CodedSegment::code(part, CodeOptions { scale, ..options }),
            CodingSteps::Absolute(halves) => {
                CodedSegment::code_in_steps(part, pow(2.0, -0.5 * f64::from(halves)), options)
            }
        };
        coded.map_err(|e| failed(HOST)(&e))
    }

    /// Options by which the coded numbers are counted: all take 16 bits.
    pub(super) fn counted(&self) -> CodeOptions {
        let default = CodeOptions { representative_bits: 16, ..CodeOptions::default() };
        match self.steps {
            CodingSteps::Filled(scale) => CodeOptions { scale, ..default },
            CodingSteps::Absolute(_) => default,
        }
    }
}
