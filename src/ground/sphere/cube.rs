//! Cube maps with Direct3D's conventions.

use glam::DVec3;

use crate::elementary::atan2;

/// Face of a cube around the origin, at distance 1, with the axes of its texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceAxes {
    /// Center.
    pub center: DVec3,
    /// Direction of increasing columns.
    pub right: DVec3,
    /// Direction of increasing rows.
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
    /// Returns the point at fractions of the face's width and height, and the density of solid angle there.
    pub(super) fn at(&self, [u, v]: [f64; 2]) -> (DVec3, f64) {
        let point = self.center + (2.0 * u - 1.0) * self.right + (2.0 * v - 1.0) * self.down;
        let length = point.length();
        (point / length, 1.0 / (length * length * length))
    }
}

/// Cube map with a number of texels per edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CubeMap {
    side: usize,
}

impl CubeMap {
    /// Creates a cube map with `side` texels along an edge. Panics if there are none.
    pub const fn new(side: usize) -> Self {
        assert!(side > 0, "a texel along an edge");
        Self { side }
    }

    /// Texels along an edge.
    pub const fn side(self) -> usize {
        self.side
    }

    /// Number of texels of all six faces. They are ordered face by face as in [`CUBE_FACES`], rows from the top.
    pub const fn len(self) -> usize {
        6 * self.side * self.side
    }

    /// Returns `false`: there is at least one texel.
    pub const fn is_empty(self) -> bool {
        self.side == 0
    }

    /// Returns the unit direction of a texel's center. Panics if there is no such face.
    pub fn direction(self, face: usize, column: usize, row: usize) -> DVec3 {
        CUBE_FACES[face].at([column, row].map(|at| (at as f64 + 0.5) / self.side as f64)).0
    }

    /// Returns the face, column and row of the texel that a direction falls into; on ties, the lowest face. The
    /// direction must not be zero.
    pub fn texel_of(self, direction: DVec3) -> [usize; 3] {
        let along = |face: usize| direction.dot(CUBE_FACES[face].center);
        let face = (1..6).fold(0, |best, face| if along(face) > along(best) { face } else { best });
        let axes = CUBE_FACES[face];
        let [column, row] = [axes.right, axes.down].map(|axis| {
            let at = 0.5 * self.side as f64 * (1.0 + direction.dot(axis) / along(face));
            (at as usize).min(self.side - 1)
        });
        [face, column, row]
    }

    /// Solid angle of a texel in steradians, equal on all faces.
    pub fn solid_angle(self, column: usize, row: usize) -> f64 {
        face_solid_angle(self.side, column, row)
    }
}

/// Solid angle of a texel of a cube's face, in steradians.
pub(super) fn face_solid_angle(side: usize, column: usize, row: usize) -> f64 {
    let edge = |at: usize| 2.0 * at as f64 / side as f64 - 1.0;
    rectangle_solid_angle([edge(column), edge(row)], [edge(column + 1), edge(row + 1)])
}

/// Solid angle of the rectangle from x0, y0 to x1, y1 in the plane at distance 1 from the eye, relative to (0, 0), as
/// two triangles (van Oosterom and Strackee, 1983). Their triple product is the rectangle's area, so nothing cancels.
fn rectangle_solid_angle([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> f64 {
    let corner = |x, y| DVec3::new(x, y, 1.0);
    let [a, b, c, d] = [corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1)];
    let area = (x1 - x0) * (y1 - y0);
    let triangle = |p: DVec3, q: DVec3, r: DVec3| {
        let [lp, lq, lr] = [p.length(), q.length(), r.length()];
        2.0 * atan2(area, lp * lq * lr + p.dot(q) * lr + q.dot(r) * lp + r.dot(p) * lq)
    };
    triangle(a, b, c) + triangle(a, c, d)
}
