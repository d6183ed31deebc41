//! Why factors cannot be computed.

use thiserror::Error;

use super::{MAX_MM_PER_UNIT, MAX_TOLERANCE, MIN_MM_PER_UNIT, MIN_TOLERANCE};

/// Why factors cannot be computed.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum FactorError {
    /// The scale is out of range.
    #[error("expected {MIN_MM_PER_UNIT:e} to {MAX_MM_PER_UNIT:e} millimeters per unit of the model, found {found:e}")]
    Scale { found: f64 },
    /// The tolerance is out of range.
    #[error("expected a tolerance of factors from {MIN_TOLERANCE} to {MAX_TOLERANCE}, found {found}")]
    Tolerance { found: f64 },
    /// There is no such cluster.
    #[error("expected a level below {levels}, found {found}")]
    Level { found: u32, levels: u32 },
    /// An adaptive choice needs at least one link.
    #[error("expected at least one link per texel")]
    NoLinks,
    /// The factors would not fit.
    #[error(
        "{links} links of {channels} channels per texel at {side} x {side} texels are {} numbers, expected at most {limit}",
        u128::from(*side) * u128::from(*side) * *links as u128 * *channels as u128
    )]
    TooMany { side: u32, links: usize, channels: usize, limit: usize },
    /// As many dipoles as channels: one, or red, green and blue.
    #[error("expected one dipole, or three, found {found}")]
    Channels { found: usize },
    /// One value per texel is needed.
    #[error("expected a value for each of {texels} texels, found {found}")]
    Values { found: usize, texels: usize },
}
