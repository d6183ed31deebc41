//! The part of the surface under a rectangle of texels, as polygons.

use glam::DVec3;

use super::place::FacePlace;

/// Part of a face under a rectangle of its texels: one or two flat convex polygons, because the diagonal of the face's
/// rectangle may divide it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TexelPart {
    corners: [[DVec3; 5]; 2],
    counts: [u8; 2],
}

impl TexelPart {
    /// Clips the face with these corners to the rectangle between two points in texel coordinates.
    pub(super) fn new(place: &FacePlace, corners: [DVec3; 3], low: [f64; 2], high: [f64; 2]) -> Self {
        let ring = [low, [high[0], low[1]], high, [low[0], high[1]]];
        // Scaled distance from the diagonal, in texels squared: positive on the side of corner (x + width, y).
        let [x, y, width, height] = [place.x, place.y, place.width, place.height].map(f64::from);
        let side = |at: [f64; 2]| (at[0] - x) * height - (at[1] - y) * width;
        let mut part = Self { corners: [[DVec3::ZERO; 5]; 2], counts: [0; 2] };
        for (half, sign) in [1.0, -1.0].into_iter().enumerate() {
            if ring.iter().all(|at| sign * side(*at) <= 0.0) {
                continue;
            }
            let mut push = |at: [f64; 2]| {
                let weights = place.weights(at[0], at[1]);
                part.corners[half][usize::from(part.counts[half])] = super::surface::combined(corners, weights);
                part.counts[half] += 1;
            };
            for (corner, &from) in ring.iter().enumerate() {
                let to = ring[(corner + 1) % 4];
                let [here, there] = [sign * side(from), sign * side(to)];
                if here >= 0.0 {
                    push(from);
                }
                if here * there < 0.0 {
                    let t = here / (here - there);
                    push([from[0] + (to[0] - from[0]) * t, from[1] + (to[1] - from[1]) * t]);
                }
            }
        }
        part
    }

    /// Iterates over the polygons, each a ring of three to five points.
    pub fn polygons(&self) -> impl Iterator<Item = &[DVec3]> {
        let rings = self.corners.iter().zip(self.counts).map(|(ring, count)| &ring[..usize::from(count)]);
        rings.filter(|ring| !ring.is_empty())
    }

    /// Distance from a point to the farthest corner.
    pub(super) fn farthest(&self, from: DVec3) -> f64 {
        let corners = self.polygons().flatten();
        corners.map(|corner| corner.distance_squared(from)).fold(0.0, f64::max).sqrt()
    }
}
