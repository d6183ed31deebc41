//! Cube maps as Direct3D has them.

use glam::DVec3;

use super::texels::{TexelGrid, rectangle_solid_angle};

/// A face of a cube around the origin, at distance 1: where it stands, and which ways its texels run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceAxes {
    /// Its middle.
    pub center: DVec3,
    /// The direction of growing columns.
    pub right: DVec3,
    /// The direction of growing rows.
    pub down: DVec3,
}

/// Direct3D's faces in the order of their slices: +x, -x, +y, -y, +z, -z.
pub const CUBE_FACES: [FaceAxes; 6] = [
    FaceAxes { center: DVec3::X, right: DVec3::NEG_Z, down: DVec3::NEG_Y },
    FaceAxes { center: DVec3::NEG_X, right: DVec3::Z, down: DVec3::NEG_Y },
    FaceAxes { center: DVec3::Y, right: DVec3::X, down: DVec3::Z },
    FaceAxes { center: DVec3::NEG_Y, right: DVec3::X, down: DVec3::NEG_Z },
    FaceAxes { center: DVec3::Z, right: DVec3::X, down: DVec3::NEG_Y },
    FaceAxes { center: DVec3::NEG_Z, right: DVec3::NEG_X, down: DVec3::NEG_Y },
];

impl FaceAxes {
    /// The point of the face, and its density of solid angle, at the fractions of its width and height.
    pub(super) fn at(&self, [u, v]: [f64; 2]) -> (DVec3, f64) {
        let point = self.center + (2.0 * u - 1.0) * self.right + (2.0 * v - 1.0) * self.down;
        let length = point.length();
        (point / length, 1.0 / (length * length * length))
    }
}

/// The texels of a cube map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CubeMap {
    side: usize,
}

impl CubeMap {
    /// Of so many texels along an edge.
    ///
    /// # Panics
    /// If there are none.
    pub const fn new(side: usize) -> Self {
        assert!(side > 0, "a texel along an edge");
        Self { side }
    }

    /// Texels along an edge.
    pub const fn side(self) -> usize {
        self.side
    }

    /// Texels of all six faces. Their order is face by face as in [`CUBE_FACES`], rows from the top.
    pub const fn len(self) -> usize {
        6 * self.side * self.side
    }

    /// Always false.
    pub const fn is_empty(self) -> bool {
        self.side == 0
    }

    /// The direction of a texel's center, of length 1.
    ///
    /// # Panics
    /// If there is no such face.
    pub fn direction(self, face: usize, column: usize, row: usize) -> DVec3 {
        CUBE_FACES[face].at([column, row].map(|at| (at as f64 + 0.5) / self.side as f64)).0
    }

    /// The solid angle of a texel, the same on all faces.
    pub fn solid_angle(self, column: usize, row: usize) -> f64 {
        face_solid_angle(self.side, column, row)
    }
}

/// The solid angle of a texel of a cube's face.
pub(super) fn face_solid_angle(side: usize, column: usize, row: usize) -> f64 {
    let edge = |at: usize| 2.0 * at as f64 / side as f64 - 1.0;
    rectangle_solid_angle([edge(column), edge(row)], [edge(column + 1), edge(row + 1)])
}

impl TexelGrid for CubeMap {
    fn size(&self) -> [usize; 2] {
        [self.side, 6 * self.side]
    }

    fn solid_angle(&self, column: usize, row: usize) -> f64 {
        face_solid_angle(self.side, column, row % self.side)
    }

    fn at(&self, [column, row]: [usize; 2], u: f64, v: f64) -> (DVec3, f64) {
        let side = self.side as f64;
        CUBE_FACES[row / self.side].at([(column as f64 + u) / side, ((row % self.side) as f64 + v) / side])
    }
}
