//! The part of the surface under a rectangle of texels, as polygons.

use glam::DVec3;

use super::place::FacePlace;
use super::surface::combined;
use crate::geom::polygon::clipped_corners;

/// Part of a face under a rectangle of its texels: one or two flat convex polygons, on both sides of the diagonal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TexelPart {
    corners: [[DVec3; 5]; 2],
    counts: [usize; 2],
}

impl TexelPart {
    /// Clips the face with these corners to the rectangle between two points in texel coordinates.
    pub(super) fn new(place: &FacePlace, corners: [DVec3; 3], [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> Self {
        let ring = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|[x, y]| DVec3::new(x, y, 0.0));
        // Scaled distance from the diagonal, in texels squared: positive on the side of corner (x + width, y).
        let [x, y, width, height] = [place.x, place.y, place.width, place.height].map(f64::from);
        let side = |at: DVec3| (at.x - x) * height - (at.y - y) * width;
        let mut part = Self { corners: [[DVec3::ZERO; 5]; 2], counts: [0; 2] };
        for (half, sign) in [1.0, -1.0].into_iter().enumerate() {
            if ring.iter().all(|&at| sign * side(at) <= 0.0) {
                continue;
            }
            for at in clipped_corners(&ring, |at| sign * side(at)) {
                part.corners[half][part.counts[half]] = combined(corners, place.weights(at.x, at.y));
                part.counts[half] += 1;
            }
        }
        part
    }

    /// Iterates over the polygons, each a ring of three to five points.
    pub fn polygons(&self) -> impl Iterator<Item = &[DVec3]> {
        self.corners.iter().zip(self.counts).map(|(ring, count)| &ring[..count]).filter(|ring| !ring.is_empty())
    }

    /// Distance from a point to the farthest corner.
    pub(super) fn farthest(&self, from: DVec3) -> f64 {
        let corners = self.polygons().flatten();
        corners.map(|corner| corner.distance_squared(from)).fold(0.0, f64::max).sqrt()
    }
}
