//! The host's side of a card that computes: floats into textures and back, quads over a whole target with coordinates in texels.
//!
//! Textures are rectangles, which is how the cards of 2003 had float textures: coordinates count texels, texel i lies at i + 0.5.

use refsim::num::Format;
use refsim::raster::Vertex;
use refsim::texture::{Image, SignedTexelMinimum, TargetRounding, TexelFormat, TextureError, TextureKind};

/// A rectangle texture of floats, row by row, red to alpha, each rounded once into the format.
///
/// # Errors
/// If the extents are 0 or too large, or the texels do not fill them.
pub fn float_image(
    format: TexelFormat,
    [width, height]: [usize; 2],
    texels: &[[f32; 4]],
) -> Result<Image, TextureError> {
    let extents = [extent(width), extent(height), 1];
    if format == TexelFormat::Rgba32f {
        // The bits are the bytes; large matrices go this way.
        let bytes = texels.as_flattened().iter().flat_map(|value| value.to_le_bytes()).collect();
        return Image::from_bytes(format, TextureKind::Rectangle, extents, 1, bytes);
    }
    let bits: Vec<[u32; 4]> = texels.iter().map(|texel| texel.map(f32::to_bits)).collect();
    Image::from_values(format, TextureKind::Rectangle, extents, Format::FP32, &bits, TargetRounding::Nearest)
}

/// A rectangle of zeros: what a target starts as.
///
/// # Errors
/// If the extents are 0 or too large.
pub fn empty_image(format: TexelFormat, [width, height]: [usize; 2]) -> Result<Image, TextureError> {
    Image::new(format, TextureKind::Rectangle, [extent(width), extent(height), 1], 1)
}

/// The texels of an image of one level, row by row, as single floats.
#[must_use]
pub fn floats(image: &Image) -> Vec<[f32; 4]> {
    if image.format() == TexelFormat::Rgba32f {
        let value = |bytes: &[u8]| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        let texel = |bytes: &[u8]| [0, 4, 8, 12].map(|at| value(&bytes[at..at + 4]));
        return image.bytes().chunks_exact(16).map(texel).collect();
    }
    let places = (0..image.height()).flat_map(|y| (0..image.width()).map(move |x| (x, y)));
    let texel = |(x, y)| image.texel(0, 0, y, x, SignedTexelMinimum::Clamp).to_format(Format::FP32);
    places.map(|place| texel(place).map(f32::from_bits)).collect()
}

/// A quad over the whole target, to be drawn in Direct3D's clip space with pixel centres as in OpenGL. `coordinates` gives the sets of
/// texture coordinates at a corner, of which `u` (0 left, 1 right) and `v` (0 the first row's edge, 1 the last's) say where it is.
pub fn quad<const SETS: usize>(coordinates: impl Fn(f32, f32) -> [[f32; 4]; SETS]) -> [Vertex; 4] {
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[u, v]: [f32; 2]| {
        let position = [2.0 * u - 1.0, 1.0 - 2.0 * v, 0.0, 1.0];
        let mut vertex = Vertex { position: position.map(f32::to_bits), ..Vertex::default() };
        for (slot, set) in vertex.texcoords.iter_mut().zip(coordinates(u, v)) {
            *slot = set.map(f32::to_bits);
        }
        vertex
    })
}

/// An extent that an image can refuse.
fn extent(size: usize) -> u32 {
    u32::try_from(size).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_come_back_as_the_format_holds_them() {
        let texels = [[1.0, -0.0, 1.0 / 3.0, 65504.0], [0.1, 2.0, 3.0, 4.0]];
        let image = float_image(TexelFormat::Rgba32f, [2, 1], &texels).expect("an image");
        assert_eq!(floats(&image), texels);
        let image = float_image(TexelFormat::Rgba16f, [1, 2], &texels).expect("an image");
        assert_eq!(floats(&image)[0], [1.0, -0.0, 0.333_251_95, 65504.0]);
        assert!(float_image(TexelFormat::Rgba32f, [2, 2], &texels).is_err(), "too few texels");
        assert!(empty_image(TexelFormat::Rgba32f, [0, 1]).is_err());
    }
}
