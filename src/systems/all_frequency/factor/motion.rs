//! Motions of a square of texels under which a product function keeps its values.

/// Motions of both maps that leave f unchanged. Only one row of each orbit must be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProductSymmetry {
    /// None is known.
    None,
    /// Mirrors along tangent and bitangent: anisotropic models.
    Mirrors,
    /// Quarter turns around the normal, and mirrors: isotropic models.
    TurnsAndMirrors,
}

/// A motion: what x and y of a texel become, counted from the middle of the map.
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
    /// The motions, the identity first; with each its inverse.
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

/// The texel (row times side plus column) to which a motion takes `texel`.
pub(super) fn moved(motion: Motion, side: usize, texel: usize) -> usize {
    let last = side.cast_signed() - 1;
    // Twice the distance from the middle.
    let [x, y] = [texel % side, texel / side].map(|at| 2 * at.cast_signed() - last);
    let [column, row] = motion.map(|[a, b]| ((a * x + b * y + last) / 2).cast_unsigned());
    row * side + column
}

/// The texel that a motion takes to `texel`.
pub(super) fn moved_back(motion: Motion, side: usize, texel: usize) -> usize {
    let [[a, b], [c, d]] = motion;
    moved([[a, c], [b, d]], side, texel)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motions_are_groups_of_permutations() {
        use ProductSymmetry::{Mirrors, None, TurnsAndMirrors};
        for (symmetry, count) in [(None, 1), (Mirrors, 4), (TurnsAndMirrors, 8)] {
            let motions = symmetry.motions();
            assert_eq!((motions.len(), motions[0]), (count, SAME));
            for side in [1, 2, 5, 8] {
                for &motion in motions {
                    let mut to: Vec<usize> = (0..side * side).map(|texel| moved(motion, side, texel)).collect();
                    assert!(to.iter().enumerate().all(|(from, &to)| moved_back(motion, side, to) == from));
                    let inverse: Vec<usize> = (0..side * side).map(|texel| moved_back(motion, side, texel)).collect();
                    let is_inverse = |&other: &Motion| (0..side * side).all(|t| moved(other, side, t) == inverse[t]);
                    assert!(motions.iter().any(is_inverse));
                    to.sort_unstable();
                    assert!(to.iter().enumerate().all(|(at, &texel)| at == texel));
                }
            }
        }
        assert_eq!(moved(QUARTER, 4, 1), moved_back(THREE_QUARTERS, 4, 1));
        // The first column of the first row goes to the last column: x to y.
        assert_eq!(moved(QUARTER, 4, 0), 3);
    }
}
