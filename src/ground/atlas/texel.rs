//! Attributes of texels and of clusters of texels.

use glam::DVec3;

/// Surface under one texel, in the mesh's units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Texel {
    /// Face under the texel.
    pub face: u32,
    /// Mean point of the surface under the texel.
    pub point: DVec3,
    /// Unit normal at that point, interpolated between the normals of the face's corners; zero if the face has none.
    pub normal: DVec3,
    /// Area of the surface under the texel; 0 on a face without area.
    pub area: f64,
}

/// Surface under a texel of any level: 4^level texels of the finest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cluster {
    /// Area of the surface.
    pub area: f64,
    /// Mean point of the texels, weighted by area; unweighted if no texel has an area.
    pub point: DVec3,
    /// Radius of a ball about the mean point that contains the surface.
    pub radius: f64,
}

impl Cluster {
    /// Combines the area and mean point of four clusters, without a radius.
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
