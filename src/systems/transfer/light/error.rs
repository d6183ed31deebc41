//! Errors of making a light.

use glam::DVec3;
use thiserror::Error;

use crate::sphere::{EnvironmentError, LightError, RotationError};
use crate::transfer::grid::LIGHT_TEXELS;

/// Errors of making a light.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum CubeLightError {
    /// The number of texels.
    #[error("expected {LIGHT_TEXELS} texels, six faces of 32x32, found {found}")]
    Texels { found: usize },
    /// A texel with an invalid radiance.
    #[error(
        "expected a finite radiance of at least 0, found {found} in channel {channel} of face {face}, row {row}, \
         column {column} (counted from 0)"
    )]
    Radiance { found: f64, channel: &'static str, face: usize, row: usize, column: usize },
    /// A small source without a direction.
    #[error("source {number}: expected a direction of finite length above 0, found {found}")]
    Direction { number: usize, found: DVec3 },
    /// A small source's radius.
    #[error("source {number}: expected an angular radius above 0 and up to pi radians, found {found}")]
    Radius { number: usize, found: f64 },
    /// A small source's color.
    #[error("source {number}: expected finite radiances of at least 0, found {found:?}")]
    Color { number: usize, found: [f64; 3] },
    /// The number of priorities.
    #[error("expected {LIGHT_TEXELS} responses, one per coefficient of the light, found {found}")]
    Responses { found: usize },
    /// A matrix that is no rotation.
    #[error(transparent)]
    Rotation(#[from] RotationError),
    /// A generated light.
    #[error(transparent)]
    Light(#[from] LightError),
    /// A picture that makes no environment.
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}
