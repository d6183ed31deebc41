//! A model with its atlas for the card, in units of the model's size, so that the unit of length does not matter.

use glam::DVec3;

use crate::atlas::{Atlas, DrawnFace, DrawnVertex};
use crate::card::Texels;
use crate::geom::UnitFrame;

/// A model with its atlas, in a frame of the model's size.
#[derive(Clone, Debug)]
pub struct CardModel {
    side: u32,
    frame: UnitFrame,
    pub(super) positions: Texels,
    pub(super) normals: Texels,
    /// Faces, each with the area of its texels divided by the mean texel area.
    pub(super) faces: Vec<(DrawnFace, f32)>,
}

impl CardModel {
    /// Creates the model of a mesh's atlas.
    pub fn new(atlas: &Atlas) -> Self {
        let drawn: Vec<DrawnFace> = (0..atlas.places().len() as u32).map(|face| atlas.drawn(face)).collect();
        let corners = drawn.iter().flat_map(|face| face.triangles.iter().flatten().map(|vertex| vertex.position));
        let frame = UnitFrame::new(corners);
        let side = atlas.side();
        let mean = atlas.mean_texel_area();
        let factor = |area: f64| if mean > 0.0 { (area / mean) as f32 } else { 0.0 };
        let size = [side as usize; 2];
        let texel = |x: usize, y: usize| &atlas.texels()[y * side as usize + x];
        let positions = Texels::from_fn(size, |x, y| {
            let [px, py, pz] = narrowed(frame.of_scene(texel(x, y).point));
            [px, py, pz, factor(texel(x, y).area)]
        });
        let normals = Texels::from_fn(size, |x, y| {
            let [nx, ny, nz] = narrowed(texel(x, y).normal);
            [nx, ny, nz, 0.0]
        });
        let areas = atlas.places().iter().map(|place| factor(texel(place.x as usize, place.y as usize).area));
        let faces = drawn.into_iter().zip(areas).collect();
        Self { side, frame, positions, normals, faces }
    }

    /// Texels along a side of the atlas.
    pub fn side(&self) -> u32 {
        self.side
    }

    /// The frame of positions on the card.
    pub(super) fn frame(&self) -> &UnitFrame {
        &self.frame
    }

    /// Position and normal of a vertex in the card's units, as bits.
    pub(super) fn attributes<P>(&self, vertex: &DrawnVertex<P>) -> [[u32; 4]; 2] {
        let [x, y, z] = narrowed(self.frame.of_scene(vertex.position));
        let [nx, ny, nz] = narrowed(vertex.normal);
        [[x, y, z, 1.0], [nx, ny, nz, 0.0]].map(|vector| vector.map(f32::to_bits))
    }
}

fn narrowed(vector: DVec3) -> [f32; 3] {
    vector.to_array().map(|value| value as f32)
}
