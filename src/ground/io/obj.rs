//! Wavefront OBJ.
//!
//! The reader uses `v`, `vt`, `vn` and `f`, so the whole file is one mesh. A face of n corners becomes n - 2 triangles
//! ([`crate::geom::polygon`]). Triangle ids follow the order of the file, from 0; degenerate triangles count. Vertices
//! are numbered by first use; unused vertices are dropped. Texture coordinates that all corners have are kept, and so are
//! normals: each combination with a position becomes a vertex. A word that begins with `#` begins a comment.

use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::error::read_file;
use super::faces::Faces;
use super::lines::{logical_lines, not_utf_16, single, statement};
use super::model_note::ModelNote;
use super::quoted;
use crate::error::{FilePlace, InputError, input_error};
use crate::geom::Mesh;
use crate::io::error::{mesh_error, syntax_error, too_long_error};

/// Largest size of a file that is read, in bytes (256 MiB).
pub const MAX_BYTES: u64 = 256 << 20;

/// The bytes of a model.
pub(super) fn load_model(path: &Path) -> Result<Vec<u8>, InputError> {
    read_file(path, "model", MAX_BYTES)
}

/// Rejects input that is longer than [`load_model`] accepts.
pub(super) fn within_limit(bytes: &[u8], name: &Path) -> Result<(), InputError> {
    let fits = bytes.len() as u64 <= MAX_BYTES;
    if fits { Ok(()) } else { Err(too_long_error("model", name, MAX_BYTES)) }
}

/// Reads a mesh from bytes; `name` is the file's name in messages.
pub fn parse_obj(bytes: &[u8], name: &Path) -> Result<Mesh, InputError> {
    read_obj(bytes, name, true).map(|(mesh, _)| mesh)
}

/// Like [`parse_obj`]; unless `strict`, faces with a fault are accepted and noted.
pub(super) fn read_obj(bytes: &[u8], name: &Path, strict: bool) -> Result<(Mesh, Vec<ModelNote>), InputError> {
    within_limit(bytes, name)?;
    not_utf_16(bytes, name)?;
    let mut reader = ObjReader::new(name);
    for (line, text) in logical_lines(bytes) {
        reader.line(line, &statement(&text), &text)?;
    }
    let (triangles, notes) = reader.triangles(strict)?;
    Ok((reader.mesh(&triangles, true)?, notes))
}

/// Writes a mesh so that reading it gives the same bits for every corner.
pub fn write_obj(mesh: &Mesh, out: &mut dyn Write) -> io::Result<()> {
    // Rust prints the shortest decimal that reads back to the same f32.
    for [x, y, z] in mesh.positions() {
        writeln!(out, "v {x} {y} {z}")?;
    }
    for [u, v] in mesh.texcoords().unwrap_or_default() {
        writeln!(out, "vt {u} {v}")?;
    }
    for [x, y, z] in mesh.normals().unwrap_or_default() {
        writeln!(out, "vn {x} {y} {z}")?;
    }
    let (texcoords, normals) = (mesh.texcoords().is_some(), mesh.normals().is_some());
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|index| corner([u64::from(index) + 1; 3], texcoords, normals));
        writeln!(out, "f {a} {b} {c}")?;
    }
    Ok(())
}

fn corner<T: fmt::Display>([v, vt, vn]: [T; 3], texcoords: bool, normals: bool) -> String {
    match (texcoords, normals) {
        (false, false) => format!("{v}"),
        (true, false) => format!("{v}/{vt}"),
        (false, true) => format!("{v}//{vn}"),
        (true, true) => format!("{v}/{vt}/{vn}"),
    }
}

/// Indices of vertex, texture coordinate and normal, from 1; 0 for none.
pub(super) type ObjCorner = [u32; 3];

/// The elements read so far.
#[derive(Default)]
pub(super) struct ObjReader {
    name: PathBuf,
    positions: Vec<[f32; 3]>,
    texcoords: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    faces: Faces<ObjCorner>,
    /// Indices of elements that had not been read yet: line, target and index.
    forward: Vec<(usize, usize, i64)>,
}

impl ObjReader {
    pub(super) fn new(name: &Path) -> Self {
        Self { name: name.into(), ..Self::default() }
    }

    /// Reads one line, given as words and as text.
    pub(super) fn line(&mut self, line: usize, words: &[&[u8]], text: &[u8]) -> Result<(), InputError> {
        match words.split_first() {
            Some((&b"v", numbers)) => self.vertex(line, text, numbers),
            Some((&b"vt", numbers)) => self.texcoord(line, text, numbers),
            Some((&b"vn", numbers)) => self.normal(line, text, numbers),
            Some((&b"f", corners)) => self.face(line, text, corners),
            _ => Ok(()),
        }
    }

    fn vertex(&mut self, line: usize, text: &[u8], numbers: &[&[u8]]) -> Result<(), InputError> {
        // x y z, then optionally a weight, or a color of three or four numbers.
        if !matches!(numbers.len(), 3 | 4 | 6 | 7) {
            return Err(self.syntax(line, "a vertex `v x y z`", text));
        }
        let position = self.numbers(line, [numbers[0], numbers[1], numbers[2]])?;
        if let &[_, _, _, weight] = numbers
            && self.number(line, weight)? != 1.0
        {
            return Err(self.syntax(line, "a vertex without a weight, or with weight 1", weight));
        }
        self.positions.push(position);
        Ok(())
    }

    fn texcoord(&mut self, line: usize, text: &[u8], numbers: &[&[u8]]) -> Result<(), InputError> {
        let uv = match numbers {
            // A one-dimensional texture has only u; v is 0 by default.
            &[u] => [self.number(line, u)?, 0.0],
            // A third number is the depth of a volume texture.
            &[u, v] | &[u, v, _] => self.numbers(line, [u, v])?,
            _ => return Err(self.syntax(line, "a texture coordinate `vt u`, `vt u v` or `vt u v w`", text)),
        };
        self.texcoords.push(uv);
        Ok(())
    }

    fn normal(&mut self, line: usize, text: &[u8], numbers: &[&[u8]]) -> Result<(), InputError> {
        let &[x, y, z] = numbers else {
            return Err(self.syntax(line, "a normal `vn x y z`", text));
        };
        self.normals.push(self.numbers(line, [x, y, z])?);
        Ok(())
    }

    fn numbers<const N: usize>(&self, line: usize, words: [&[u8]; N]) -> Result<[f32; N], InputError> {
        let mut numbers = [0.0; N];
        for (number, word) in numbers.iter_mut().zip(words) {
            *number = self.number(line, word)?;
        }
        Ok(numbers)
    }

    fn number(&self, line: usize, word: &[u8]) -> Result<f32, InputError> {
        single(word).map_err(|fault| self.syntax(line, fault.expected(), word))
    }

    fn face(&mut self, line: usize, text: &[u8], corners: &[&[u8]]) -> Result<(), InputError> {
        if corners.len() < 3 {
            return Err(self.syntax(line, "a face of at least three corners `f 1 2 3`", text));
        }
        self.faces.begin(line);
        for &corner in corners {
            let Some(indices) = corner_indices(corner) else {
                return Err(self.syntax(line, "a corner `1`, `1/1`, `1//1` or `1/1/1`", corner));
            };
            let mut places = [0; 3];
            for (target, index) in indices.into_iter().enumerate() {
                if let Some(index) = index {
                    places[target] = self.place(line, target, index)?;
                }
            }
            self.faces.push(places);
        }
        Ok(())
    }

    /// Converts an index of the file to one counted from 1; a negative index counts back from the last element. Indices
    /// of elements that have not been read yet are accepted and remembered.
    fn place(&mut self, line: usize, target: usize, index: i64) -> Result<u32, InputError> {
        let count = self.count(target);
        let place = match index {
            0 => None,
            1.. => usize::try_from(index).ok(),
            _ => usize::try_from(index.unsigned_abs()).ok().and_then(|back| (count + 1).checked_sub(back)),
        };
        let place = place.filter(|&place| place > 0);
        if place.is_some_and(|place| place > count) {
            self.forward.push((line, target, index));
        }
        let place = place.and_then(|place| u32::try_from(place).ok());
        place.ok_or_else(|| self.out_of_range(line, target, index))
    }

    fn count(&self, target: usize) -> usize {
        [self.positions.len(), self.texcoords.len(), self.normals.len()][target]
    }

    pub(super) fn faces(&self) -> &Faces<ObjCorner> {
        &self.faces
    }

    /// The `vn` lines.
    pub(super) fn normals(&self) -> &[[f32; 3]] {
        &self.normals
    }

    /// The triangles of all faces, after the forward indices have been checked; unless `strict`, with notes on faces.
    pub(super) fn triangles(&self, strict: bool) -> Result<(Vec<[ObjCorner; 3]>, Vec<ModelNote>), InputError> {
        for &(line, target, index) in &self.forward {
            let count = self.count(target);
            // Some exporters omit the coordinates but keep their indices.
            if target == 1 && count == 0 {
                continue;
            }
            if usize::try_from(index).map_or(true, |index| index > count) {
                return Err(self.out_of_range(line, target, index));
            }
        }
        if self.faces.corners().is_empty() {
            return Err(syntax_error(self.name.as_path(), "at least one face (a line `f 1 2 3`)", "none"));
        }
        let named = |line: usize| FilePlace::line(&self.name, line).to_string();
        self.faces.triangles(|corner| self.positions[corner[0] as usize - 1], named, strict)
    }

    /// The mesh of these triangles; if `attributes`, with texture coordinates and normals that all corners have;
    /// otherwise with positions alone.
    pub(super) fn mesh(&self, triangles: &[[ObjCorner; 3]], attributes: bool) -> Result<Mesh, InputError> {
        let all = |target: usize| attributes && self.faces.corners().iter().all(|corner| corner[target] > 0);
        let (texcoords, normals) = (!self.texcoords.is_empty() && all(1), all(2));
        let (mut vertices, mut index_of) = (Vec::<ObjCorner>::new(), BTreeMap::<ObjCorner, u32>::new());
        let mut index = |[v, vt, vn]: ObjCorner| {
            let used = [v, if texcoords { vt } else { 0 }, if normals { vn } else { 0 }];
            *index_of.entry(used).or_insert_with(|| {
                vertices.push(used);
                vertices.len() as u32 - 1
            })
        };
        let triangles = triangles.iter().map(|corners| corners.map(&mut index)).collect();
        fn of<T: Copy>(list: &[T], vertices: &[ObjCorner], target: usize) -> Vec<T> {
            vertices.iter().map(|vertex| list[vertex[target] as usize - 1]).collect()
        }
        let normals = normals.then(|| of(&self.normals, &vertices, 2));
        let texcoords = texcoords.then(|| of(&self.texcoords, &vertices, 1));
        let mesh = Mesh::new(of(&self.positions, &vertices, 0), triangles);
        mesh.and_then(|mesh| mesh.with_attributes(normals, texcoords)).map_err(|reason| mesh_error(&self.name, reason))
    }

    pub(super) fn syntax(&self, line: usize, expected: &'static str, found: &[u8]) -> InputError {
        let place = FilePlace::line(&self.name, line);
        syntax_error(place, expected, quoted(found))
    }

    fn out_of_range(&self, line: usize, target: usize, index: i64) -> InputError {
        let (place, count) = (FilePlace::line(&self.name, line), self.count(target));
        input_error!("crossbar::model::index" =>
            "{} {index}, expected 1 to {count} (or -1 to -{count})", TARGETS[target];
            help "faces count from 1, or backwards from -1: is a part of the file missing?")
        .at(place)
    }
}

/// The elements that a corner's indices refer to, in their order in the file.
const TARGETS: [&str; 3] = ["a face uses vertex", "a corner uses texture coordinate", "a corner uses normal"];

fn corner_indices(corner: &[u8]) -> Option<[Option<i64>; 3]> {
    let mut parts = std::str::from_utf8(corner).ok()?.split('/');
    let mut indices = [Some(parts.next()?.parse().ok()?), None, None];
    for index in &mut indices[1..] {
        match parts.next() {
            None | Some("") => {}
            Some(part) => *index = Some(part.parse().ok()?),
        }
    }
    parts.next().is_none().then_some(indices)
}
