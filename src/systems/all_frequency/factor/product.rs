//! The product of reflectance and cosine, and the symmetries of a square of texels that leave it unchanged.

use glam::DVec3;

use crate::transfer::brdf::Brdf;

/// Symmetries of both maps that leave f unchanged. Only one row per orbit needs to be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProductSymmetry {
    /// No symmetry is known.
    None,
    /// Mirrors along tangent and bitangent: anisotropic models.
    Mirrors,
    /// Quarter turns around the normal, and mirrors: isotropic models.
    TurnsAndMirrors,
}

/// A symmetry of the map: the images of a texel's x and y, counted from the middle of the map.
pub(super) type Motion = [[isize; 2]; 2];

const SAME: Motion = [[1, 0], [0, 1]];
const MIRROR_X: Motion = [[-1, 0], [0, 1]];
const MIRROR_Y: Motion = [[1, 0], [0, -1]];
const HALF: Motion = [[-1, 0], [0, -1]];
const QUARTER: Motion = [[0, -1], [1, 0]];
const THREE_QUARTERS: Motion = [[0, 1], [-1, 0]];
const DIAGONAL: Motion = [[0, 1], [1, 0]];
const OTHER_DIAGONAL: Motion = [[0, -1], [-1, 0]];

impl ProductSymmetry {
    /// The motions, a group; the identity is first.
    pub(super) const fn motions(self) -> &'static [Motion] {
        match self {
            Self::None => &[SAME],
            Self::Mirrors => &[SAME, MIRROR_X, MIRROR_Y, HALF],
            Self::TurnsAndMirrors => {
                &[SAME, QUARTER, HALF, THREE_QUARTERS, MIRROR_X, MIRROR_Y, DIAGONAL, OTHER_DIAGONAL]
            }
        }
    }
}

/// The texel (row times side plus column) to which a motion moves `texel`.
pub(super) fn moved(motion: Motion, side: usize, texel: usize) -> usize {
    let last = side.cast_signed() - 1;
    // Coordinates are twice the distance from the middle.
    let [x, y] = [texel % side, texel / side].map(|at| 2 * at.cast_signed() - last);
    let [column, row] = motion.map(|[a, b]| ((a * x + b * y + last) / 2).cast_unsigned());
    row * side + column
}

/// The texel that a motion moves to `texel`.
pub(super) fn moved_back(motion: Motion, side: usize, texel: usize) -> usize {
    let [[a, b], [c, d]] = motion;
    moved([[a, c], [b, d]], side, texel)
}

/// The BRDF product function f(v, s) = b(v, s) s_z (section 2), per steradian, in local coordinates.
pub trait ProductFunction: Sync {
    /// f for two directions of length 1 above the horizon.
    fn value(&self, view: DVec3, light: DVec3) -> f64;

    /// Rotations and mirrorings that leave f unchanged.
    fn symmetry(&self) -> ProductSymmetry;
}

impl ProductFunction for Brdf {
    fn value(&self, view: DVec3, light: DVec3) -> f64 {
        Self::value(self, view, light) * light.z
    }

    fn symmetry(&self) -> ProductSymmetry {
        if self.is_isotropic() { ProductSymmetry::TurnsAndMirrors } else { ProductSymmetry::Mirrors }
    }
}
