//! Triangle meshes with shared vertices.

use std::collections::BTreeMap;

use glam::DVec3;

use super::vector::{area_vector, place_bits, unit, wide};
use crate::error::{InputError, ensure, input_error};

/// Triangles that share vertices. [`Mesh::new`] guarantees that every index is in range and every coordinate finite.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    /// Normal of each vertex; empty if there are none.
    normals: Vec<[f32; 3]>,
    /// Texture coordinates of each vertex; empty if there are none.
    texcoords: Vec<[f32; 2]>,
}

/// Contact of two triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Contact {
    /// No common corner.
    None,
    /// One common corner.
    Vertex,
    /// Two common corners, or all three.
    Edge,
}

impl Mesh {
    /// Creates a mesh from positions and corner indices (counted from 0). Triangles keep their order: the id of a
    /// triangle is its index. Degenerate triangles are accepted (nothing ever hits them); count them with
    /// [`Mesh::degenerate_count`].
    ///
    /// ```
    /// # extern crate crossbar_base as crossbar;
    /// use crossbar::geom::Mesh;
    ///
    /// # fn main() -> Result<(), crossbar::error::InputError> {
    /// let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    /// let square = Mesh::new(corners.clone(), vec![[0, 1, 2], [0, 2, 3]])?;
    /// assert_eq!((square.len(), square.boundary_edge_count()), (2, 4));
    ///
    /// let wrong = Mesh::new(corners, vec![[0, 1, 4]]).expect_err("there are four vertices");
    /// assert_eq!(wrong.to_string(), "triangle 0 uses vertex 4, expected an index below 4 (counted from 0)");
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`InputError`] names the first index out of range, or the first coordinate that is not finite.
    pub fn new(positions: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self, InputError> {
        ensure!(
            triangles.len() <= i32::MAX as usize,
            "found {} triangles, expected at most {}",
            triangles.len(),
            i32::MAX
        );
        if let Some((vertex, value)) = not_finite(&positions) {
            return Err(input_error!(
                "vertex {vertex} (counted from 0) has the coordinate {value}, expected a finite number"
            ));
        }
        let vertices = positions.len();
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|&&index| index as usize >= vertices) {
                return Err(input_error!(
                    "triangle {triangle} uses vertex {index}, expected an index below {vertices} (counted from 0)"
                ));
            }
        }
        Ok(Self { positions, triangles, ..Self::default() })
    }

    /// Adds a normal per vertex, of any length; the zero vector means that the normal is unknown.
    pub fn with_normals(mut self, normals: Vec<[f32; 3]>) -> Result<Self, InputError> {
        self.check_attribute("normals", &normals)?;
        self.normals = normals;
        Ok(self)
    }

    /// Adds texture coordinates per vertex.
    pub fn with_texcoords(mut self, texcoords: Vec<[f32; 2]>) -> Result<Self, InputError> {
        self.check_attribute("texture coordinates", &texcoords)?;
        self.texcoords = texcoords;
        Ok(self)
    }

    /// Adds normals and texture coordinates, where there are any.
    pub fn with_attributes(
        self,
        normals: Option<Vec<[f32; 3]>>,
        texcoords: Option<Vec<[f32; 2]>>,
    ) -> Result<Self, InputError> {
        let mesh = if let Some(normals) = normals { self.with_normals(normals)? } else { self };
        if let Some(texcoords) = texcoords { mesh.with_texcoords(texcoords) } else { Ok(mesh) }
    }

    /// Rotates every position and normal.
    pub fn rotated(mut self, rotation: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        self.positions.iter_mut().chain(&mut self.normals).for_each(|vector| *vector = rotation(*vector));
        self
    }

    /// Keeps the triangles with these ids, which must exist.
    pub(super) fn keep(&mut self, ids: &[u32]) {
        self.triangles = ids.iter().map(|&id| self.triangles[id as usize]).collect();
    }

    /// Flips triangles: exchanges their second and third corners. Ids that do not exist are ignored.
    pub fn turned_round(mut self, triangles: &[u32]) -> Self {
        for &triangle in triangles {
            if let Some([_, b, c]) = self.triangles.get_mut(triangle as usize) {
                std::mem::swap(b, c);
            }
        }
        self
    }

    fn check_attribute<const N: usize>(&self, what: &'static str, values: &[[f32; N]]) -> Result<(), InputError> {
        let vertices = self.positions.len();
        ensure!(values.len() == vertices, "found {} {what}, expected one per vertex: {vertices}", values.len());
        match not_finite(values) {
            None => Ok(()),
            Some((vertex, value)) => Err(input_error!(
                "among the {what} of vertex {vertex} (counted from 0) is {value}, expected finite numbers"
            )),
        }
    }

    /// Vertex positions.
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.positions
    }

    /// Normals per vertex as given; `None` if the mesh has none. [`Mesh::vertex_normals`] computes missing normals.
    pub fn normals(&self) -> Option<&[[f32; 3]]> {
        (!self.normals.is_empty()).then_some(&self.normals)
    }

    /// Texture coordinates per vertex; `None` for a mesh without texture coordinates.
    pub fn texcoords(&self) -> Option<&[[f32; 2]]> {
        (!self.texcoords.is_empty()).then_some(&self.texcoords)
    }

    /// Corner indices of each triangle; the front is the side from which they run counter-clockwise.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Number of triangles.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Returns `true` if there are no triangles.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Returns the three corners of a triangle, or `None` for an id that does not exist.
    pub fn corners(&self, triangle: u32) -> Option<[[f32; 3]; 3]> {
        let indices = self.triangles.get(triangle as usize)?;
        Some(indices.map(|index| self.positions[index as usize]))
    }

    /// Iterates over the corners of all triangles, in the order of ids.
    pub fn iter_corners(&self) -> impl ExactSizeIterator<Item = [[f32; 3]; 3]> + '_ {
        self.triangles.iter().map(|indices| indices.map(|index| self.positions[index as usize]))
    }

    /// Smallest and largest coordinates of the vertices that triangles use; `None` if there are no triangles.
    pub fn bounds(&self) -> Option<[[f32; 3]; 2]> {
        let mut corners = self.iter_corners().flatten();
        let first = corners.next()?;
        Some(corners.fold([first, first], |[low, high], at| {
            let lower = |axis: usize| if at[axis] < low[axis] { at[axis] } else { low[axis] };
            let higher = |axis: usize| if at[axis] > high[axis] { at[axis] } else { high[axis] };
            [[0, 1, 2].map(lower), [0, 1, 2].map(higher)]
        }))
    }

    /// Area of a triangle; 0 for an id that does not exist.
    pub fn area(&self, triangle: u32) -> f64 {
        self.corners(triangle).map_or(0.0, |corners| area_vector(corners.map(wide)).length() / 2.0)
    }

    /// Computes normals per vertex: the normalised area-weighted mean of the adjoining triangles' normals; zero if the
    /// mean is zero.
    pub fn vertex_normals(&self) -> Vec<DVec3> {
        let mut normals = vec![DVec3::ZERO; self.positions.len()];
        for (corners, indices) in self.iter_corners().zip(&self.triangles) {
            let normal = area_vector(corners.map(wide));
            indices.iter().for_each(|&index| normals[index as usize] += normal);
        }
        normals.into_iter().map(|sum| unit(sum).unwrap_or(DVec3::ZERO)).collect()
    }

    /// Returns the same triangles without attributes, and merges vertices at the same position. Files repeat vertices
    /// where normals or texture coordinates jump, which would disconnect [`Mesh::adjacency`].
    pub fn welded(&self) -> Self {
        let mut welder = Welder::default();
        let triangles = self.iter_corners().map(|corners| corners.map(|position| welder.vertex(position))).collect();
        Self { positions: welder.into_positions(), triangles, ..Self::default() }
    }

    /// Contact of two triangles. Corners are compared by position, so repeated vertices count as shared. Returns
    /// [`Contact::None`] for an id that does not exist.
    pub fn contact(&self, a: u32, b: u32) -> Contact {
        let (Some(a), Some(b)) = (self.corners(a), self.corners(b)) else {
            return Contact::None;
        };
        match a.iter().filter(|corner| b.contains(corner)).count() {
            0 => Contact::None,
            1 => Contact::Vertex,
            _ => Contact::Edge,
        }
    }
}

/// The first vertex with a number that is not finite, and that number.
fn not_finite<const N: usize>(values: &[[f32; N]]) -> Option<(usize, f32)> {
    let odd = |value: &[f32; N]| value.iter().copied().find(|number| !number.is_finite());
    values.iter().enumerate().find_map(|(vertex, value)| Some((vertex, odd(value)?)))
}

/// Builder that merges vertices with bit-identical positions.
#[derive(Debug, Default)]
pub struct Welder {
    positions: Vec<[f32; 3]>,
    index: BTreeMap<[u32; 3], u32>,
}

impl Welder {
    /// Returns the index of the vertex at a position, and adds the vertex if it is new. -0 and +0 are equal.
    pub fn vertex(&mut self, position: [f32; 3]) -> u32 {
        let next = self.positions.len() as u32;
        let index = *self.index.entry(place_bits(position)).or_insert(next);
        if index == next {
            self.positions.push(position.map(|value| value + 0.0));
        }
        index
    }

    /// Position of a vertex with an index returned by [`Welder::vertex`].
    pub fn position(&self, index: u32) -> [f32; 3] {
        self.positions[index as usize]
    }

    /// Vertex positions in the order of their first use.
    pub fn into_positions(self) -> Vec<[f32; 3]> {
        self.positions
    }
}
