//! Stand-ins for the papers' models and light.

use glam::DVec3;

use crate::sphere::ClearSky;

/// Size of the stand-ins for a paper's models, for entries that have a choice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum ModelSize {
    /// Small models: seconds per entry, for tests.
    Reduced,
    /// As printed: half a minute to three hours of processor time per entry.
    #[default]
    Printed,
}

impl ModelSize {
    /// One of two values: for models as printed, or for reduced models.
    pub(super) fn pick<T>(self, printed: T, reduced: T) -> T {
        match self {
            Self::Printed => printed,
            Self::Reduced => reduced,
        }
    }
}

/// Clear sky with a sun half a degree wide, which casts hard shadows.
pub(super) const HARD_SUN: ClearSky = ClearSky {
    sun: DVec3::new(1.0, -0.6, 1.1),
    sun_radiance: [4e4, 3.7e4, 3.2e4],
    zenith: [0.25, 0.4, 0.7],
    ground: [0.1; 3],
};
