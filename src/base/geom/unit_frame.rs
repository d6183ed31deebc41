//! Coordinates relative to a body's size, so that errors in single precision do not depend on the unit of length.

use glam::DVec3;

/// Coordinate frame of a body: relative to the centre of its bounds, in units of a power of two that exceeds half their
/// diagonal, so that the body lies within distance 1 of the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitFrame {
    center: DVec3,
    unit: f64,
}

impl UnitFrame {
    /// Creates the frame of a body's points; if there are no points, its coordinates equal the scene's.
    pub fn new(points: impl IntoIterator<Item = DVec3>) -> Self {
        let bounds = points.into_iter().fold(None, |bounds: Option<[DVec3; 2]>, p| {
            Some(bounds.map_or([p, p], |[low, high]| [low.min(p), high.max(p)]))
        });
        let [low, high] = bounds.unwrap_or_default();
        Self { center: low / 2.0 + high / 2.0, unit: power_of_two_above((high / 2.0 - low / 2.0).length()) }
    }

    /// Converts a point of the scene to the frame's coordinates.
    pub fn of_scene(&self, point: DVec3) -> DVec3 {
        (point - self.center) / self.unit
    }

    /// Length of the unit, in scene units.
    pub fn unit(&self) -> f64 {
        self.unit
    }
}

fn power_of_two_above(length: f64) -> f64 {
    if length.is_normal() { f64::from_bits(((length.to_bits() >> 52) + 1) << 52) } else { 1.0 }
}
