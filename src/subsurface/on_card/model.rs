//! A model with its atlas as the card gets it: in units of its own size, so that the unit of length does not matter.

use glam::DVec3;

use crate::atlas::{Atlas, DrawnFace};
use crate::card::Texels;

/// A model with its atlas. Positions are relative to the middle of its bounds, in units of a power of two that is
/// larger than its radius.
#[derive(Clone, Debug)]
pub struct CardModel {
    side: u32,
    center: DVec3,
    unit: f64,
    pub(super) positions: Texels,
    pub(super) normals: Texels,
    pub(super) faces: Vec<CardFace>,
}

/// A face in the atlas: its corners a, b and c, and the middle m of b and c.
#[derive(Clone, Copy, Debug)]
pub(super) struct CardFace {
    pub(super) positions: [[f32; 3]; 4],
    pub(super) normals: [[f32; 3]; 4],
    /// Corners of its rectangle, in texels.
    pub(super) at: [[f32; 2]; 4],
    pub(super) bounds: [f32; 4],
    /// The area of its texels over their mean area.
    pub(super) area: f32,
}

/// Corners a, b, m, c in the order of [`CardFace`].
const A: usize = 0;
const B: usize = 1;
const C: usize = 2;
const M: usize = 3;

impl CardModel {
    /// Of a mesh's atlas.
    pub fn new(atlas: &Atlas) -> Self {
        let drawn: Vec<DrawnFace> = (0..atlas.places().len() as u32).map(|face| atlas.drawn(face)).collect();
        let corners = drawn.iter().flat_map(|face| face.triangles.iter().flatten().map(|vertex| vertex.position));
        let (low, high) =
            corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let center = low / 2.0 + high / 2.0;
        let unit = power_of_two_above((high / 2.0 - low / 2.0).length());
        let side = atlas.side();
        let mean = atlas.mean_texel_area();
        let factor = |area: f64| if mean > 0.0 { (area / mean) as f32 } else { 0.0 };
        let size = [side as usize; 2];
        let texel = |x: usize, y: usize| &atlas.texels()[y * side as usize + x];
        let positions = Texels::from_fn(size, |x, y| {
            let [px, py, pz] = narrowed((texel(x, y).point - center) / unit);
            [px, py, pz, factor(texel(x, y).area)]
        });
        let normals = Texels::from_fn(size, |x, y| {
            let [nx, ny, nz] = narrowed(texel(x, y).normal);
            [nx, ny, nz, 0.0]
        });
        let face = |(face, place): (&DrawnFace, &crate::atlas::FacePlace)| {
            let [[a, b, m], [_, _, c]] = face.triangles;
            let vertices = [a, b, c, m];
            CardFace {
                positions: vertices.map(|vertex| narrowed((vertex.position - center) / unit)),
                normals: vertices.map(|vertex| narrowed(vertex.normal)),
                at: vertices.map(|vertex| vertex.at.map(|at| at as f32)),
                bounds: face.bounds.map(|bound| bound as f32),
                area: factor(texel(place.x as usize, place.y as usize).area),
            }
        };
        let faces = drawn.iter().zip(atlas.places()).map(face).collect();
        Self { side, center, unit, positions, normals, faces }
    }

    /// Texels along a side of the atlas.
    pub fn side(&self) -> u32 {
        self.side
    }

    /// The number of faces.
    pub fn faces(&self) -> usize {
        self.faces.len()
    }

    /// A point of the scene in the card's units.
    pub(super) fn to_card(&self, point: DVec3) -> DVec3 {
        (point - self.center) / self.unit
    }

    /// The length of the card's unit.
    pub(super) fn unit(&self) -> f64 {
        self.unit
    }
}

impl CardFace {
    /// The two triangles in the atlas: places in [`Self::positions`].
    pub(super) const TRIANGLES: [usize; 6] = [A, B, M, A, M, C];

    /// Where a corner (0 to 2) lies in the atlas by each half's affine map, carried on over the whole face: that of
    /// a, b, m, then that of a, m, c.
    pub(super) fn by_halves(&self, corner: usize) -> [f32; 4] {
        let beyond = |other: usize| [0, 1].map(|axis| 2.0 * self.at[M][axis] - self.at[other][axis]);
        let own = self.at[corner];
        let [[x0, y0], [x1, y1]] = match corner {
            B => [own, beyond(C)],
            C => [beyond(B), own],
            _ => [own, own],
        };
        [x0, y0, x1, y1]
    }
}

fn narrowed(vector: DVec3) -> [f32; 3] {
    vector.to_array().map(|value| value as f32)
}

/// The power of two above a length; 1 for 0.
fn power_of_two_above(length: f64) -> f64 {
    if length.is_normal() { f64::from_bits(((length.to_bits() >> 52) + 1) << 52) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_is_a_power_of_two_above() {
        assert_eq!([0.0, 1.0, 1.5, 2.0, 0.3].map(power_of_two_above), [1.0, 2.0, 2.0, 4.0, 0.5]);
    }

    /// A face in a rectangle of 4 x 2 texels at (8, 6), corner b along x.
    #[test]
    fn both_halves_meet_at_the_diagonal() {
        let at = [[8.0, 6.0], [12.0, 6.0], [8.0, 8.0], [12.0, 8.0]];
        let face = CardFace { positions: [[0.0; 3]; 4], normals: [[0.0; 3]; 4], at, bounds: [0.0; 4], area: 1.0 };
        let [a, b, c] = [A, B, C].map(|corner| face.by_halves(corner));
        assert_eq!((a, b, c), ([8.0, 6.0, 8.0, 6.0], [12.0, 6.0, 16.0, 8.0], [12.0, 10.0, 8.0, 8.0]));
        // At the middle of b and c both maps give m; at a both give a.
        let middle = [0, 1, 2, 3].map(|k| (b[k] + c[k]) / 2.0);
        assert_eq!(middle, [12.0, 8.0, 12.0, 8.0]);
    }
}
