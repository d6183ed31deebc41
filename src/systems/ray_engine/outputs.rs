//! Per-ray read-back formats: equation 11's gamma, in bytes.

use refsim::device::Profile;
use refsim::texture::{Image, TexelFormat};

/// Data read back per ray of a pass (sections 4.2 and 6.1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Outputs {
    /// The triangle: 4 bytes, the paper's gamma of 4. The t-buffer stays on the card; the host recomputes t of the one
    /// triangle, since it has to compare the hits of several cells.
    Id,
    /// The triangle and the t-buffer: 8 bytes.
    #[default]
    IdAndT,
    /// The triangle and three barycentric coordinates as single floats: 16 bytes, the paper's gamma of 16; t as with
    /// [`Outputs::Id`]. Cards without float targets return the triangle alone, and the host computes the rest.
    IdAndBarycentrics,
}

/// Encoding of hits in the color target of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TargetEncoding {
    /// Triangle ids of the mesh: 24 bits and a hit mask.
    Id,
    /// Positions in the pass's list of triangles, counted from 1, in 5 + 6 + 5 bits.
    Place16,
    /// Positions in the pass's list, from 1 to 255, in 8 bits.
    Place8,
    /// u, v, w and the position in the pass's list, as floats.
    Weights,
}

/// Decoded pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PixelResult {
    pub(super) triangle: u32,
    pub(super) uvw: Option<[f32; 3]>,
}

impl TargetEncoding {
    /// Chooses the encoding for a pass over `triangles` triangles; with `small`, the smallest target of the card that
    /// can distinguish them.
    pub(super) fn choose(profile: &Profile, weights: bool, small: bool, triangles: usize) -> Self {
        let has = |code: Self| profile.limits.target_formats.contains(&code.format());
        if weights {
            return Self::Weights;
        }
        let fits = |(code, most): &(Self, usize)| small && triangles <= *most && has(*code);
        let found = [(Self::Place8, 0xff), (Self::Place16, 0xffff)].into_iter().find(fits);
        found.map_or(Self::Id, |(code, _)| code)
    }

    /// Format of the target.
    pub(super) const fn format(self) -> TexelFormat {
        match self {
            Self::Id => TexelFormat::Bgra8,
            Self::Place16 => TexelFormat::Bgr565,
            Self::Place8 => TexelFormat::L8,
            Self::Weights => TexelFormat::Rgba32f,
        }
    }

    /// Color of a triangle's quad.
    pub(super) fn color(self, place: usize, id: u32) -> [u32; 4] {
        let part = |bits: u32, most: u32| ((bits & most) as f32 / most as f32).to_bits();
        let place = (place + 1) as u32;
        match self {
            Self::Id => color_of_id(id),
            Self::Place16 => [part(place, 31), part(place >> 5, 63), part(place >> 11, 31), 1.0_f32.to_bits()],
            Self::Place8 => {
                let level = part(place, 255);
                [level, level, level, 1.0_f32.to_bits()]
            }
            Self::Weights => [1.0_f32.to_bits(); 4],
        }
    }

    /// Decodes a pixel of a target; `None` for a miss.
    pub(super) fn read(self, image: &Image, x: u32, y: u32, triangles: &[u32]) -> Option<PixelResult> {
        let at =
            |place: u32| Some(PixelResult { triangle: *triangles.get(place.checked_sub(1)? as usize)?, uvw: None });
        let texel = image.raw(0, 0, y, x);
        if self == Self::Weights {
            let [u, v, w, place] = [0, 32, 64, 96].map(|shift| f32::from_bits((texel >> shift) as u32));
            return at(place as u32).map(|result| PixelResult { uvw: Some([u, v, w]), ..result });
        }
        let raw = texel as u32;
        match self {
            Self::Id => (raw >> 24 != 0).then(|| PixelResult { triangle: id_of_color(raw), uvw: None }),
            Self::Place16 => at(raw >> 11 & 31 | (raw >> 5 & 63) << 5 | (raw & 31) << 11),
            Self::Place8 | Self::Weights => at(raw & 0xff),
        }
    }
}

/// Encodes an id as a color: the lowest byte in red, alpha 1.
pub(super) fn color_of_id(id: u32) -> [u32; 4] {
    let part = |shift: u32| ((id >> shift & 0xff) as f32 / 255.0).to_bits();
    [part(0), part(8), part(16), 1.0_f32.to_bits()]
}

/// Decodes the id of an `A8R8G8B8` pixel.
pub(super) const fn id_of_color(raw: u32) -> u32 {
    (raw >> 16 & 0xff) | (raw & 0xff00) | (raw & 0xff) << 16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_survive_as_bytes() {
        for id in [0, 1, 255, 256, 0x0012_3456, 0x00ff_ffff] {
            let [r, g, b, _] = color_of_id(id).map(|bits| (f32::from_bits(bits) * 255.0).round() as u32);
            assert_eq!(id_of_color(0xff00_0000 | r << 16 | g << 8 | b), id, "{id:#x}");
        }
    }
}
