//! The displayed object: a mesh with bidirectional textures.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::bi_scale::paper;
use crate::bi_scale::shade::ShadedPixel;
use crate::bi_scale::texture::BidirectionalTexture;
use crate::card::{CardError, SeenPixel};
use crate::geom::Mesh;
use crate::geom::vector::wide;
use crate::transfer::Vertices;

/// A mesh covered by bidirectional textures.
#[derive(Clone, Copy, Debug)]
pub struct TexturedMesh<'a> {
    /// The mesh, with local frames.
    pub vertices: &'a Vertices,
    /// Texture coordinates of each corner, triangle by triangle; a patch has length 1.
    pub coordinates: &'a [[[f32; 2]; 3]],
    /// The textures, all with the same directions of light.
    pub textures: &'a [BidirectionalTexture],
    /// The index of each triangle's texture.
    pub texture_of: &'a [u32],
}

/// Texture coordinates of triangle corners, in units of a patch that repeats `repeat` times. Fails with
/// [`CardError::Input`] for a mesh without texture coordinates.
pub fn corner_coordinates(mesh: &Mesh, repeat: [f32; 2]) -> Result<Vec<[[f32; 2]; 3]>, CardError> {
    let none = "the mesh has no texture coordinates, which place a bidirectional texture";
    let of = mesh.texcoords().ok_or_else(|| CardError::input(none))?;
    let corner = |corner: u32| {
        let [u, v] = of[corner as usize];
        [repeat[0] * u, repeat[1] * v]
    };
    Ok(mesh.triangles().iter().map(|corners| corners.map(corner)).collect())
}

/// A mesh's corners as vertices of a card; corners with equal vertex and texture coordinates become one.
#[derive(Clone, Debug, Default)]
pub(super) struct CardVertices {
    /// The mesh's vertex for each vertex of the card.
    pub(super) vertices: Vec<u32>,
    /// The texture coordinates of each vertex of the card.
    pub(super) coordinates: Vec<[f32; 2]>,
    pub(super) indices: Vec<u32>,
}

impl CardVertices {
    pub(super) fn new(mesh: &TexturedMesh<'_>) -> Self {
        let mut known: BTreeMap<(u32, [u32; 2]), u32> = BTreeMap::new();
        let mut all = Self::default();
        let corners = mesh.vertices.triangles().as_flattened().iter();
        for (&vertex, &coordinates) in corners.zip(mesh.coordinates.as_flattened()) {
            let next = all.vertices.len() as u32;
            let index = *known.entry((vertex, coordinates.map(f32::to_bits))).or_insert(next);
            if index == next {
                all.vertices.push(vertex);
                all.coordinates.push(coordinates);
            }
            all.indices.push(index);
        }
        all
    }
}

impl TexturedMesh<'_> {
    /// The number M of directions of light.
    pub(super) fn directions(&self) -> usize {
        self.textures.first().map_or(0, |texture| texture.light().directions().len())
    }

    /// Equation 3 in f64 at a pixel of a triangle, by plain loops: texture coordinates, local view and local light are
    /// interpolated between its vertices.
    pub fn pixel(&self, local: &[[f64; 3]], eye: [f32; 3], seen: &SeenPixel) -> [f64; 3] {
        let (mut place, mut view) = ([0.0; 2], DVec3::ZERO);
        let coordinates = self.coordinates[seen.triangle as usize];
        for ((corner, weight), coordinates) in seen.corners.into_iter().zip(seen.weights).zip(coordinates) {
            let towards = wide(eye) - wide(self.vertices.positions()[corner as usize]);
            view += weight * self.vertices.frames()[corner as usize].to_local(towards);
            (0..2).for_each(|axis| place[axis] += weight * f64::from(coordinates[axis]));
        }
        let view = view.normalize_or_zero();
        let texture = &self.textures[self.texture_of[seen.triangle as usize] as usize];
        paper::radiance(texture, local, &ShadedPixel { corners: seen.corners, weights: seen.weights, place, view })
    }

    pub(super) fn check(&self) -> Result<(), CardError> {
        let triangles = self.vertices.triangles().len();
        CardError::check_size("triangles with texture coordinates", triangles, self.coordinates.len())?;
        CardError::check_size("triangles with a texture", triangles, self.texture_of.len())?;
        let named = self.texture_of.iter().max().map_or(0, |&most| most as usize + 1);
        let found = self.textures.len();
        CardError::check_size("textures, which triangles name", named.max(found), found)?;
        for texture in self.textures {
            let found = texture.light().directions().len();
            CardError::check_size("directions of light in each texture", self.directions(), found)?;
        }
        let mut numbers = self.coordinates.as_flattened().as_flattened().iter();
        match numbers.find(|value| !value.is_finite()) {
            Some(&found) => Err(CardError::figure("finite texture coordinates", f64::from(found))),
            None => Ok(()),
        }
    }
}
