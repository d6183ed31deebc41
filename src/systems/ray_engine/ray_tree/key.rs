//! Rays as points in five dimensions.

use crate::geom::Ray;

/// Number of faces of the unit cube.
pub(super) const FACES: usize = 6;

/// Origin of a ray, and the point at which its direction meets a face of the cube, both coordinates in [-1, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Key {
    pub(super) origin: [f32; 3],
    pub(super) direction: [f32; 2],
}

/// Ray of the tree: the caller's index, and its five-dimensional key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RayTreeEntry {
    pub(super) ray: u32,
    pub(super) key: Key,
}

impl Key {
    /// Returns the face through which a ray points (0 to 5: +x -x +y -y +z -z; the first of equal components) and its
    /// key.
    pub(super) fn of(ray: &Ray) -> (u32, Self) {
        let d = ray.direction();
        let longest = (1..3).fold(0, |best: usize, axis| if d[axis].abs() > d[best].abs() { axis } else { best });
        let (u, v) = ((longest + 1) % 3, (longest + 2) % 3);
        let face = 2 * longest as u32 + u32::from(d[longest] < 0.0);
        let length = d[longest].abs();
        (face, Self { origin: ray.origin(), direction: [d[u] / length, d[v] / length] })
    }
}
