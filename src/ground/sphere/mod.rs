//! Functions on the sphere, in f64.
//!
//! Function y_lm has index l (l + 1) + m. There is no Condon-Shortley sign: for l = 1 the functions are y, z and x
//! times sqrt(3 / (4 pi)). *Order* n means n bands, l = 0 to n - 1, n^2 functions.

mod cube;
mod environment;
mod extremes;
mod harmonics;
mod hemisphere;
mod layout;
mod light;
mod parabolic;
mod projection;
mod rotation;
mod rule;
mod singular;
mod sky;

pub use cube::{CUBE_FACES, CubeMap, FaceAxes};
pub use environment::EnvironmentPicture;
pub use extremes::least;
pub use harmonics::{
    MAX_ORDER, evaluate, function_band, function_count, function_index, harmonics, order_of, order_with,
};
pub use hemisphere::Hemisphere;
pub use layout::EnvironmentLayout;
pub use light::HarmonicLight;
pub use parabolic::ParabolicMap;
pub use projection::{HemisphereProjection, ProjectionErrors};
pub use rotation::{HarmonicRotation, MAX_SKEW, check_rotation, turn_around_z};
pub use rule::{DirectionRule, MAX_DEGREE};
pub use sky::{ClearSky, SUN_RADIUS};
