//! The numbers that a model file gives its vertices.

use std::path::Path;

use super::lines::{logical_lines, single, statement};
use super::model::{ModelOptions, is_obj, rotation_of_obj};
use super::obj::{ObjReader, load_model};
use crate::error::InputError;
use crate::geom::vector::place_bits;

/// Vertices of a model file, as its faces name them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VertexNumbers {
    /// Place of each vertex, as bits.
    places: Vec<[u32; 3]>,
    /// Vertices of each triangle, counted from 1.
    triangles: Vec<[u32; 3]>,
}

impl VertexNumbers {
    /// Those of an OBJ file's text: its `v` lines, counted from 1 as its faces count them, turned as `rotation` says.
    /// `None` of what is no OBJ file.
    pub(super) fn of_obj(bytes: &[u8], rotation: Option<fn([f32; 3]) -> [f32; 3]>) -> Option<Self> {
        let (mut reader, mut places) = (ObjReader::new(Path::new("")), Vec::new());
        for (line, text) in logical_lines(bytes) {
            let words = statement(&text);
            reader.line(line, &words, &text).ok()?;
            if let [b"v", x, y, z, ..] = words[..] {
                let place = [single(x).ok()?, single(y).ok()?, single(z).ok()?];
                places.push(place_bits(rotation.map_or(place, |rotation| rotation(place))));
            }
        }
        let (triangles, _) = reader.triangles(false).ok()?;
        let vertices = triangles.iter().map(|corners| corners.map(|[vertex, ..]| vertex));
        Some(Self { places, triangles: vertices.collect() })
    }

    /// The number of a triangle's vertex by its place, as several vertices of a file may have the same place. Of two
    /// vertices of the triangle at one place, the first.
    pub fn at(&self, triangle: u32, place: [f32; 3]) -> Option<u32> {
        let is_there = |&vertex: &u32| self.places.get(vertex as usize - 1) == Some(&place_bits(place));
        self.triangles.get(triangle as usize)?.iter().copied().find(is_there)
    }
}

/// The numbers of an OBJ file's vertices, at the places that [`load_mesh_with`](super::load_mesh_with) gives them;
/// `None` for another format, whose vertices have no numbers that their user knows.
///
/// # Errors
/// [`InputError`].
pub fn load_vertex_numbers(path: &Path, options: ModelOptions) -> Result<Option<VertexNumbers>, InputError> {
    let bytes = load_model(path)?;
    Ok(if is_obj(&bytes, path) { VertexNumbers::of_obj(&bytes, rotation_of_obj(options)) } else { None })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_are_numbered_as_faces_name_them() {
        let text = b"# a comment\nv 1 2 3\nvn 0 0 1\nv -0 0 0 1\nv 1 2 3\nv 4 5 6 0.1 0.2 0.3\nf 1 2 4\nf 4 2 3 1\n";
        let numbers = VertexNumbers::of_obj(text, None).expect("a model");
        let at = |triangle| [[1.0, 2.0, 3.0], [0.0; 3], [4.0, 5.0, 6.0]].map(|place| numbers.at(triangle, place));
        assert_eq!(at(0), [Some(1), Some(2), Some(4)]);
        assert_eq!(at(1), [Some(3), Some(2), Some(4)]);
        assert_eq!(at(2), [Some(3), None, Some(4)]);
        assert_eq!((numbers.at(0, [0.0, 0.0, 1.0]), numbers.at(3, [0.0; 3])), (None, None), "a normal, no triangle");
        let turned = VertexNumbers::of_obj(text, Some(|[x, y, z]| [x, -z, y])).expect("a model");
        assert_eq!((turned.at(0, [4.0, -6.0, 5.0]), turned.at(0, [4.0, 5.0, 6.0])), (Some(4), None));
        assert_eq!(VertexNumbers::of_obj(b"v 1 2\n", None), None);
    }
}
