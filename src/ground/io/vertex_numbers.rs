//! The numbers that a model file gives its vertices.

use std::collections::BTreeMap;
use std::path::Path;

use super::error::ReadError;
use super::lines::{logical_lines, single, statement};
use super::model::{ModelOptions, is_obj, rotation_of_obj};
use super::obj::load_model;
use crate::geom::vector::place_bits;

/// Vertices of a model file by their places. Of several vertices at one place the first counts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VertexNumbers {
    of_place: BTreeMap<[u32; 3], u32>,
}

impl VertexNumbers {
    /// Those of an OBJ file's text: its `v` lines, counted from 1 as its faces count them, turned as `rotation` says.
    pub(super) fn of_obj(bytes: &[u8], rotation: Option<fn([f32; 3]) -> [f32; 3]>) -> Self {
        let mut of_place = BTreeMap::new();
        let mut next = 1_u32;
        for (_, text) in logical_lines(bytes) {
            let [b"v", x, y, z, ..] = statement(&text)[..] else { continue };
            if let (Ok(x), Ok(y), Ok(z)) = (single(x), single(y), single(z)) {
                let place = rotation.map_or([x, y, z], |rotation| rotation([x, y, z]));
                of_place.entry(place_bits(place)).or_insert(next);
            }
            next = next.saturating_add(1);
        }
        Self { of_place }
    }

    /// The number of the vertex at a place, if the file has one there.
    pub fn at(&self, place: [f32; 3]) -> Option<u32> {
        self.of_place.get(&place_bits(place)).copied()
    }
}

/// The numbers of an OBJ file's vertices, at the places that [`load_mesh_with`](super::load_mesh_with) gives them;
/// `None` for another format, whose vertices have no numbers that their user knows.
///
/// # Errors
/// [`ReadError`].
pub fn load_vertex_numbers(path: &Path, options: ModelOptions) -> Result<Option<VertexNumbers>, ReadError> {
    let bytes = load_model(path)?;
    Ok(is_obj(&bytes, path).then(|| VertexNumbers::of_obj(&bytes, rotation_of_obj(options))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_are_counted_as_faces_count_them() {
        let text = b"# a comment\nv 1 2 3\nvn 0 0 1\nv -0 0 0 1\nv 1 2 3\nv 4 5 6 0.1 0.2 0.3\nf 1 2 4\n";
        let numbers = VertexNumbers::of_obj(text, None);
        assert_eq!([[1.0, 2.0, 3.0], [0.0; 3], [4.0, 5.0, 6.0]].map(|at| numbers.at(at)), [Some(1), Some(2), Some(4)]);
        assert_eq!(numbers.at([0.0, 0.0, 1.0]), None, "a normal is no vertex");
        let turned = VertexNumbers::of_obj(text, Some(|[x, y, z]| [x, -z, y]));
        assert_eq!((turned.at([4.0, -6.0, 5.0]), turned.at([4.0, 5.0, 6.0])), (Some(4), None));
    }
}
