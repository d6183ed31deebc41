//! Light for pictures of all-frequency transfer.

use glam::DVec3;

use crate::sphere::ClearSky;

/// Clear sky with a sun a quarter of a degree wide, which casts hard shadows.
pub(super) const HARD_SUN: ClearSky = ClearSky {
    sun: DVec3::new(1.0, -0.6, 1.1),
    sun_radiance: [4e4, 3.7e4, 3.2e4],
    zenith: [0.25, 0.4, 0.7],
    ground: [0.1; 3],
};
