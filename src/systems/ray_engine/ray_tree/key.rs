//! Rays as points in five dimensions, and the planes that split a full bucket.

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

/// Two split planes: one of origins, one of directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Split {
    origin: (usize, f32),
    direction: (usize, f32),
}

impl Split {
    /// Computes the planes at the means, perpendicular to the axes of greatest variance; `None` if they would not
    /// separate any rays.
    pub(super) fn of(rays: &[RayTreeEntry]) -> Option<Self> {
        let origin = widest(rays, |key: &Key, axis| key.origin[axis], 3);
        let direction = widest(rays, |key: &Key, axis| key.direction[axis], 2);
        let split = Self { origin, direction };
        let first = split.child(&rays.first()?.key);
        rays.iter().any(|entry| split.child(&entry.key) != first).then_some(split)
    }

    /// Index of the child that a ray belongs to, 0 to 3.
    pub(super) fn child(&self, key: &Key) -> usize {
        let upper = |value: f32, plane: f32| usize::from(value >= plane);
        2 * upper(key.origin[self.origin.0], self.origin.1) + upper(key.direction[self.direction.0], self.direction.1)
    }
}

/// Returns the axis of greatest variance and the mean along it; sums run in the order of the rays.
fn widest(rays: &[RayTreeEntry], at: impl Fn(&Key, usize) -> f32, axes: usize) -> (usize, f32) {
    let count = rays.len() as f64;
    let moments = |axis| {
        let values = || rays.iter().map(|entry| f64::from(at(&entry.key, axis)));
        let mean = values().sum::<f64>() / count;
        (values().map(|x| (x - mean) * (x - mean)).sum::<f64>(), mean)
    };
    let mut best = (0, moments(0));
    for axis in 1..axes {
        let here = moments(axis);
        if here.0 > best.1.0 {
            best = (axis, here);
        }
    }
    (best.0, best.1.1 as f32)
}
