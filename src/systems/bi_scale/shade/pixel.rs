//! Inputs of equation 3 for a pixel.

use glam::DVec3;

use crate::transfer::{LocalFrame, Vertices};

/// A pixel that shows a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadedPixel {
    /// The vertices of the triangle.
    pub corners: [u32; 3],
    /// Their barycentric weights, which sum to 1.
    pub weights: [f64; 3],
    /// u: texture coordinates; the patch has length 1.
    pub place: [f64; 2],
    /// e: the direction to the eye in the pixel's local frame, of length 1.
    pub view: DVec3,
}

/// The local frame of a pixel: normals and tangents of the vertices, interpolated and orthonormalised. If they cancel,
/// the frame of the vertex with the largest weight.
pub fn pixel_frame(vertices: &Vertices, corners: [u32; 3], weights: [f64; 3]) -> LocalFrame {
    let frames = corners.map(|corner| vertices.frames()[corner as usize]);
    let mix = |axis: fn(&LocalFrame) -> DVec3| -> DVec3 {
        frames.iter().zip(weights).fold(DVec3::ZERO, |sum, (frame, weight)| sum + weight * axis(frame))
    };
    let (normal, tangent) = (mix(LocalFrame::normal), mix(LocalFrame::tangent));
    let heaviest = (1..3).fold(0, |most, at| if weights[at] > weights[most] { at } else { most });
    let frame = crate::geom::vector::unit(normal).and_then(|normal| LocalFrame::new(normal, tangent));
    frame.unwrap_or(frames[heaviest])
}

/// The four texels around texture coordinates of a repeating patch, and their weights, which sum to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexelSamples {
    /// Texel numbers, row by row.
    pub numbers: [usize; 4],
    /// Bilinear weights.
    pub weights: [f64; 4],
}

impl TexelSamples {
    /// For a patch of `size` x `size` texels, whose centers are at (texel + 1/2) / `size`.
    pub fn around(size: usize, place: [f64; 2]) -> Self {
        let along = |at: f64| {
            let texels = (at - at.floor()) * size as f64 - 0.5;
            let low = texels.floor();
            // -1 is the last texel of the previous repetition.
            let index = (low as isize).rem_euclid(size.cast_signed()).cast_unsigned();
            (index, (index + 1) % size, texels - low)
        };
        let [(u0, u1, fu), (v0, v1, fv)] = place.map(along);
        Self {
            numbers: [v0 * size + u0, v0 * size + u1, v1 * size + u0, v1 * size + u1],
            weights: [(1.0 - fu) * (1.0 - fv), fu * (1.0 - fv), (1.0 - fu) * fv, fu * fv],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_repeat() {
        let at = |place| TexelSamples::around(4, place);
        assert_eq!(at([0.375, 0.625]), TexelSamples { numbers: [9, 10, 13, 14], weights: [1.0, 0.0, 0.0, 0.0] });
        assert_eq!(at([0.0, 0.125]).numbers, [3, 0, 7, 4]);
        assert_eq!(at([0.0, 0.125]).weights, [0.5, 0.5, 0.0, 0.0]);
        assert_eq!(at([2.25, -0.75]), at([0.25, 0.25]));
        assert_eq!(TexelSamples::around(1, [0.9, 0.1]).numbers, [0; 4]);
    }
}
