//! Faces of any number of corners, and their triangles.

use super::model_note::ModelNote;
use crate::error::{InputError, input_error};
use crate::geom::polygon::{PolygonFault, triangulate};

/// Faces in the order of a file.
#[derive(Debug)]
pub(super) struct Faces<C> {
    corners: Vec<C>,
    /// For each face the index of its first corner, and its line or index in the file.
    faces: Vec<(usize, usize)>,
}

impl<C> Default for Faces<C> {
    fn default() -> Self {
        Self { corners: Vec::new(), faces: Vec::new() }
    }
}

impl<C: Copy> Faces<C> {
    /// Adds a face without corners; `place` is its line or its index.
    pub(super) fn begin(&mut self, place: usize) {
        self.faces.push((self.corners.len(), place));
    }

    /// Adds a corner to the last face.
    pub(super) fn push(&mut self, corner: C) {
        self.corners.push(corner);
    }

    pub(super) fn corners(&self) -> &[C] {
        &self.corners
    }

    /// The corners of the last face.
    pub(super) fn last(&self) -> &[C] {
        self.faces.last().map_or(&[], |&(start, _)| &self.corners[start..])
    }

    /// The line or index in the file, and the corners, of each face.
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, &[C])> {
        let ends = self.faces.iter().skip(1).map(|&(start, _)| start).chain([self.corners.len()]);
        self.faces.iter().zip(ends).map(|(&(start, place), end)| (place, &self.corners[start..end]))
    }

    /// The triangles of all faces, n - 2 for a face of n corners. Faces with a fault are rejected if `strict`, otherwise
    /// counted in the notes. `named` returns the name of a face for messages.
    pub(super) fn triangles(
        &self,
        position: impl Fn(C) -> [f32; 3],
        named: impl Fn(usize) -> String,
        strict: bool,
    ) -> Result<(Vec<[C; 3]>, Vec<ModelNote>), InputError> {
        let mut triangles = Vec::with_capacity(self.corners.len().saturating_sub(2 * self.faces.len()));
        let (mut notes, mut outline) = (Vec::<(PolygonFault, usize, usize)>::new(), Vec::new());
        for (place, face) in self.iter() {
            outline.clear();
            outline.extend(face.iter().map(|&corner| position(corner)));
            let (cut, fault) = triangulate(&outline);
            triangles.extend(cut.into_iter().map(|triangle| triangle.map(|corner| face[corner])));
            match fault {
                Some(fault) if strict => {
                    return Err(input_error!("crossbar::model::polygon" =>
                            "{}: expected a flat face that does not touch itself, found one {fault}", named(place);
                            help "cut the face into triangles in the program that wrote it"));
                }
                Some(fault) => match notes.iter_mut().find(|(known, ..)| *known == fault) {
                    Some((.., faces)) => *faces += 1,
                    None => notes.push((fault, place, 1)),
                },
                None => {}
            }
        }
        let note = |(fault, place, faces)| ModelNote::Polygons { fault, faces, first: named(place) };
        Ok((triangles, notes.into_iter().map(note).collect()))
    }
}
