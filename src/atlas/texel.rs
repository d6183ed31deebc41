//! What a texel knows of the surface under it, and a cluster of texels of the surface under them.

use glam::DVec3;

/// The part of the surface under one texel, in the mesh's units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Texel {
    /// The face that it lies on.
    pub face: u32,
    /// The mean point of the part.
    pub point: DVec3,
    /// The normal at that point, at length 1, interpolated between the normals of the face's corners; zero on a face
    /// that has none.
    pub normal: DVec3,
    /// The area of the part; 0 on a face without area.
    pub area: f64,
}

/// The surface under a texel of any level: 4^level texels of the finest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cluster {
    /// The area of the surface.
    pub area: f64,
    /// Its mean point: that of its texels, weighted by area. Where no texel has an area, their plain mean.
    pub point: DVec3,
    /// The radius of a ball about the point that holds all of it.
    pub radius: f64,
}

impl Cluster {
    /// The area and mean point of four clusters together, without a radius.
    pub(super) fn of_four(parts: [&Self; 4]) -> Self {
        let area = (parts[0].area + parts[1].area) + (parts[2].area + parts[3].area);
        let weighted = |weight: &dyn Fn(&Self) -> f64| {
            let [a, b, c, d] = parts.map(|part| part.point * weight(part));
            (a + b) + (c + d)
        };
        let point = if area > 0.0 { weighted(&|part| part.area / area) } else { weighted(&|_| 0.25) };
        Self { area, point, radius: 0.0 }
    }
}
