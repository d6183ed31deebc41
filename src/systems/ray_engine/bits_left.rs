//! Triangle normals that are lost because a card's number format has too few bits.

use super::EdgeRule;
use super::units::Units;
use crate::geom::Mesh;

/// Counts of triangles whose normal the format cannot represent. The card receives n = (b - a) x (c - a) in scaled
/// units, and rounds it. If every component of n is below one step of fixed point, n.d is only noise: the triangle is
/// missed, or hit at a meaningless t.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct BitsLeft {
    /// Number of triangles with non-zero area.
    pub triangles: u64,
    /// Number of these triangles whose normal is below one step in every component; 0 for a float format.
    pub below_step: u64,
    /// `true` if the format is fixed-point, and so has a step.
    pub fixed_point: bool,
}

impl BitsLeft {
    /// Counts the triangles of a mesh in the units chosen for some rays.
    pub(super) fn of(mesh: &Mesh, edges: EdgeRule, units: &Units) -> Self {
        let mut found = Self::default();
        for corners in mesh.iter_corners() {
            let (n, step) = units.largest_normal(corners, edges);
            found.fixed_point |= step > 0.0;
            found.triangles += u64::from(n > 0.0);
            found.below_step += u64::from(n > 0.0 && n < step);
        }
        found
    }

    /// [`BitsLeft::below_step`] as a fraction of [`BitsLeft::triangles`], in [0, 1]; 0 without triangles.
    pub fn share(&self) -> f64 {
        if self.triangles == 0 { 0.0 } else { self.below_step as f64 / self.triangles as f64 }
    }
}
