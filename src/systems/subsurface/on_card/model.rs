//! A model with its atlas for the card, in units of the model's size, so that the unit of length does not matter.

use glam::DVec3;

use crate::atlas::{Atlas, DrawnFace, FacePlace};
use crate::card::Texels;
use crate::geom::UnitFrame;

/// A model with its atlas, in a frame of the model's size.
#[derive(Clone, Debug)]
pub struct CardModel {
    side: u32,
    frame: UnitFrame,
    pub(super) positions: Texels,
    pub(super) normals: Texels,
    pub(super) faces: Vec<CardFace>,
}

/// A face: its rectangle in the atlas for pass 1, and its triangle on the surface for pass 3.
#[derive(Clone, Copy, Debug)]
pub(super) struct CardFace {
    /// The rectangle's corners: the face's corners a, b and c, and the middle m of b and c.
    pub(super) rectangle: [CardVertex<[f32; 2]>; 4],
    /// The face's corners with two places each; the component-wise minimum of interpolated places is a point's place in
    /// the atlas.
    pub(super) whole: [CardVertex<[f32; 4]>; 3],
    /// Bounds of reads that stay on the face: half a texel inside the rectangle.
    pub(super) bounds: [f32; 4],
    /// The area of the face's texels divided by the mean texel area.
    pub(super) area: f32,
}

/// A vertex in the card's units, with its place in the atlas in texels.
#[derive(Clone, Copy, Debug)]
pub(super) struct CardVertex<P> {
    pub(super) position: [f32; 3],
    pub(super) normal: [f32; 3],
    pub(super) at: P,
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
        let vertex = |position: DVec3, normal: DVec3| (narrowed(frame.of_scene(position)), narrowed(normal));
        let face = |(face, (drawn, place)): (u32, (&DrawnFace, &FacePlace))| {
            let [[a, b, m], [_, _, c]] = drawn.triangles;
            let rectangle = [a, b, c, m].map(|corner| {
                let (position, normal) = vertex(corner.position, corner.normal);
                CardVertex { position, normal, at: corner.at.map(|at| at as f32) }
            });
            let whole = atlas.drawn_whole(face).vertices.map(|corner| {
                let (position, normal) = vertex(corner.position, corner.normal);
                let [[x0, y0], [x1, y1]] = corner.at.map(|pair| pair.map(|at| at as f32));
                CardVertex { position, normal, at: [x0, y0, x1, y1] }
            });
            let bounds = drawn.bounds.map(|bound| bound as f32);
            let area = factor(texel(place.x as usize, place.y as usize).area);
            CardFace { rectangle, whole, bounds, area }
        };
        let faces = (0..).zip(drawn.iter().zip(atlas.places())).map(face).collect();
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
}

impl CardFace {
    /// The two triangles in the atlas, a b m and a m c, as indices into [`Self::rectangle`].
    pub(super) const TRIANGLES: [usize; 6] = [0, 1, 3, 0, 3, 2];
}

fn narrowed(vector: DVec3) -> [f32; 3] {
    vector.to_array().map(|value| value as f32)
}
