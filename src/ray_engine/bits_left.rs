//! What a card's number format leaves of a scene.

use super::units::Units;
use crate::geom::Mesh;

/// Triangles whose normal the format cannot hold: the card gets each in its own units, n = (b - a) x (c - a) times
/// their scale, and rounds. Of a triangle whose n is below one step of fixed point in every component n.d is no more
/// than noise: it is missed, or hit at a t of no meaning.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct BitsLeft {
    /// Triangles with an area.
    pub triangles: u64,
    /// Of these, those whose n is below one step. None in a float format.
    pub below_step: u64,
    /// Whether the format has a step: fixed point.
    pub fixed_point: bool,
}

impl BitsLeft {
    /// Of a mesh in the units of some rays.
    pub(super) fn of(mesh: &Mesh, units: &Units) -> Self {
        let mut found = Self::default();
        for corners in mesh.iter_corners() {
            let (n, step) = units.largest_normal(corners);
            found.fixed_point |= step > 0.0;
            found.triangles += u64::from(n > 0.0);
            found.below_step += u64::from(n > 0.0 && n < step);
        }
        found
    }

    /// [`BitsLeft::below_step`] as a share of all; 0 without a triangle.
    pub fn share(&self) -> f64 {
        if self.triangles == 0 { 0.0 } else { self.below_step as f64 / self.triangles as f64 }
    }
}
