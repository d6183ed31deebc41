//! Equation 3 by plain loops, in f64.

use super::pixel::{ShadedPixel, TexelSamples};
use crate::bi_scale::texture::{BidirectionalTexture, ViewSamples};

/// B(x, e) = sum over d of b(u, e, d) L~(x, d). `local` is L~ of all vertices: row M p + j is local direction j of
/// vertex p.
///
/// Sums begin with 0 and run over: directions of light; for each, the four views, for each the four texels; the three
/// corners of the triangle.
pub fn radiance(texture: &BidirectionalTexture, local: &[[f64; 3]], pixel: &ShadedPixel) -> [f64; 3] {
    let lights = texture.light().directions().len();
    let views = ViewSamples::around(texture.view(), pixel.view);
    let texels = TexelSamples::around(texture.size(), pixel.place);
    let mut radiance = [0.0; 3];
    for light in 0..lights {
        for (channel, radiance) in radiance.iter_mut().enumerate() {
            let mut b = 0.0;
            for (view, of_view) in views.numbers.into_iter().zip(views.weights) {
                let patch = texture.patch(view, light);
                for (texel, of_texel) in texels.numbers.into_iter().zip(texels.weights) {
                    b += of_view * of_texel * f64::from(patch[texel][channel]);
                }
            }
            let mut arriving = 0.0;
            for (corner, weight) in pixel.corners.into_iter().zip(pixel.weights) {
                arriving += weight * local[corner as usize * lights + light][channel];
            }
            *radiance += b * arriving;
        }
    }
    radiance
}
