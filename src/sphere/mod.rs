//! Functions on the sphere, in f64.
//!
//! - [`harmonics`], [`evaluate`]: real spherical harmonics, orthonormal over the sphere; [`HarmonicRotation`];
//! - [`DirectionRule`]: directions and weights, exact for polynomials of a degree.
//!
//! Function y_lm has index l (l + 1) + m. There is no Condon-Shortley sign: for l = 1 the functions are y, z and x times
//! sqrt(3 / (4 pi)). *Order* n means n bands, l = 0 to n - 1, n^2 functions.

mod harmonics;
mod hemisphere;
mod projection;
mod rotation;
mod rule;

pub use harmonics::{
    MAX_ORDER, evaluate, function_band, function_count, function_index, harmonics, order_of, swap_d3dx_signs,
};
pub use hemisphere::{Hemisphere, HemisphereError};
pub use projection::{HemisphereProjection, ProjectionError};
pub use rotation::{HarmonicRotation, MAX_SKEW, RotationError};
pub use rule::{DirectionRule, MAX_DEGREE};
