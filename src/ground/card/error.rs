//! The error type for a system's use of a card.

use std::fmt::Display;

use refsim::machine::MachineError;
use refsim::texture::TextureError;
use thiserror::Error;

use super::KernelError;

/// Reason why a card cannot compute or draw.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CardError {
    /// An input of a wrong size, out of its range, or beyond a limit of the device, with the expected and the found
    /// value.
    #[error("{0}")]
    Input(String),
    /// The device does not run a language, or refuses a program.
    #[error(transparent)]
    Program(#[from] KernelError),
    /// The card refused a resource or a draw, or could not be opened.
    #[error(transparent)]
    Draw(#[from] MachineError),
}

impl CardError {
    /// Returns `true` if the device lacks something: a language, slots of programs, formats, sizes, filters, blending.
    pub fn is_refusal(&self) -> bool {
        use MachineError as M;
        match self {
            Self::Input(_) => false,
            Self::Program(_) => true,
            Self::Draw(error) => matches!(
                error,
                M::TextureFormat { .. }
                    | M::TargetFormat { .. }
                    | M::DepthFormat { .. }
                    | M::TooLarge { .. }
                    | M::VolumeTooLarge { .. }
                    | M::TooManyTargets { .. }
                    | M::FloatFilter { .. }
                    | M::FloatLevels { .. }
                    | M::FloatMipmaps { .. }
                    | M::FloatBlend { .. }
            ),
        }
    }

    /// The error of an input.
    pub fn input(sentence: impl Display) -> Self {
        Self::Input(sentence.to_string())
    }

    /// The error of a number out of its range.
    pub fn figure(what: &str, found: impl Display) -> Self {
        Self::Input(format!("expected {what}, found {found}"))
    }

    /// Returns an error unless two sizes are equal.
    pub fn check_size(what: &str, expected: usize, found: usize) -> Result<(), Self> {
        if expected == found { Ok(()) } else { Err(Self::Input(format!("expected {expected} {what}, found {found}"))) }
    }
}

impl From<TextureError> for CardError {
    fn from(error: TextureError) -> Self {
        Self::Draw(error.into())
    }
}
