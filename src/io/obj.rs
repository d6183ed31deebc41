//! Wavefront OBJ, triangles only.
//!
//! A first pass of ours checks every `v` and `f` line, so that an error can name the line and nothing reaches tobj that it
//! is not made for; tobj then turns the checked lines into triangles. Read are the positions of vertices and the position
//! indices of faces: groups, objects, materials, normals, texture coordinates, colours, lines and points are passed over, so
//! that the whole file is one mesh. A face of more than three corners becomes a fan around its first corner. Triangle ids are
//! the order of the file, from 0. Vertices are numbered by first use; those that no face uses are dropped. Degenerate
//! triangles are kept, since they hold a place in that order; nothing ever hits them.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::{NumberError, parse_f32, quoted, read_limited};
use crate::geom::{Mesh, MeshError};

/// Longest file that is read, in bytes (256 MiB).
pub const MAX_BYTES: u64 = 256 << 20;

/// Why a file is no mesh. Lines count from 1.
#[derive(Debug, Error, miette::Diagnostic)]
pub enum ObjError {
    /// The file cannot be opened or read.
    #[error("cannot read the model {}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file is longer than [`MAX_BYTES`].
    #[error("{}: expected a model of at most {MAX_BYTES} bytes, found more", path.display())]
    TooLong {
        /// The file.
        path: PathBuf,
    },
    /// A line is not what its first word says.
    #[error("{}:{line}: expected {expected}, found {found}", path.display())]
    Syntax {
        /// The file.
        path: PathBuf,
        /// The line.
        line: usize,
        /// What belongs there.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// A face names a vertex that the file does not have.
    #[error("{}:{line}: a face uses vertex {index}, expected 1 to {vertices} (or -1 to -{vertices})", path.display())]
    IndexOutOfRange {
        /// The file.
        path: PathBuf,
        /// The line.
        line: usize,
        /// The index as written.
        index: i64,
        /// How many vertices could be named there.
        vertices: usize,
    },
    /// There is nothing to hit.
    #[error("{}: expected at least one face (a line `f 1 2 3`), found none", path.display())]
    NoFaces {
        /// The file.
        path: PathBuf,
    },
    /// tobj refuses what our pass has accepted.
    #[error("{}: {reason}", path.display())]
    Loader {
        /// The file.
        path: PathBuf,
        /// What tobj says.
        reason: tobj::LoadError,
    },
    /// The parts do not make a mesh.
    #[error("{}: {reason}", path.display())]
    Mesh {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: MeshError,
    },
}

/// A number of single precision in a line of a file.
pub(super) fn single(word: &[u8]) -> Result<f32, NumberError> {
    std::str::from_utf8(word).map_err(|_| NumberError::NoNumber).and_then(parse_f32)
}

/// Reads a mesh from a file.
///
/// # Errors
/// [`ObjError`], with the path, and the line where there is one.
pub fn load_obj(path: &Path) -> Result<Mesh, ObjError> {
    let read = read_limited(path, MAX_BYTES).map_err(|source| ObjError::Read { path: path.into(), source })?;
    let bytes = read.ok_or_else(|| ObjError::TooLong { path: path.into() })?;
    parse_obj(&bytes, path)
}

/// Reads a mesh from bytes; `name` stands for the file in messages. No input makes it panic.
///
/// # Errors
/// [`ObjError`], with the line where there is one.
pub fn parse_obj(bytes: &[u8], name: &Path) -> Result<Mesh, ObjError> {
    if bytes.len() as u64 > MAX_BYTES {
        return Err(ObjError::TooLong { path: name.into() });
    }
    let mut pass = Pass::new(name);
    for (line, text) in logical_lines(bytes) {
        pass.line(line, &words(&text), &text)?;
    }
    pass.mesh()
}

/// What tobj makes of checked lines.
fn load_clean(clean: &str, name: &Path) -> Result<Mesh, ObjError> {
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let no_materials = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut clean.as_bytes(), &options, no_materials)
        .map_err(|reason| ObjError::Loader { path: name.into(), reason })?;
    // Without group lines there is one model.
    let mesh = models.into_iter().next().map(|model| model.mesh).unwrap_or_default();
    let positions = mesh.positions.chunks_exact(3).map(|at| [at[0], at[1], at[2]]).collect();
    let triangles = mesh.indices.chunks_exact(3).map(|at| [at[0], at[1], at[2]]).collect();
    Mesh::new(positions, triangles).map_err(|reason| ObjError::Mesh { path: name.into(), reason })
}

/// Writes a mesh so that it reads back with the same bits in every corner.
///
/// # Errors
/// Those of the writer.
pub fn write_obj(mesh: &Mesh, out: &mut dyn Write) -> io::Result<()> {
    for [x, y, z] in mesh.positions() {
        // Rust prints the shortest decimal that reads back to the same f32.
        writeln!(out, "v {x} {y} {z}")?;
    }
    for [a, b, c] in mesh.triangles() {
        writeln!(out, "f {} {} {}", u64::from(*a) + 1, u64::from(*b) + 1, u64::from(*c) + 1)?;
    }
    Ok(())
}

/// Lines with their numbers, without comments; a line that ends in `\` goes on in the next.
pub(super) fn logical_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Vec<u8>)> + '_ {
    // Some editors mark UTF-8 with three bytes; left there, they would hide the first vertex.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut lines = (1..).zip(bytes.split(|&byte| byte == b'\n'));
    std::iter::from_fn(move || {
        let (number, first) = lines.next()?;
        let mut text = strip(first).to_vec();
        while text.last() == Some(&b'\\') {
            text.pop();
            text.push(b' ');
            let Some((_, next)) = lines.next() else { break };
            text.extend_from_slice(strip(next));
        }
        Some((number, text))
    })
}

/// A line without its comment and the white space around it.
fn strip(line: &[u8]) -> &[u8] {
    let end = line.iter().position(|&byte| byte == b'#').unwrap_or(line.len());
    line[..end].trim_ascii()
}

/// The words of a line.
pub(super) fn words(text: &[u8]) -> Vec<&[u8]> {
    text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).collect()
}

/// The first pass: what it has seen, and the checked lines for tobj.
pub(super) struct Pass<'a> {
    name: &'a Path,
    clean: String,
    vertices: usize,
    faces: usize,
    /// Indices that named a vertex not yet seen, with their lines.
    forward: Vec<(usize, i64)>,
}

impl<'a> Pass<'a> {
    pub(super) fn new(name: &'a Path) -> Self {
        Self { name, clean: String::new(), vertices: 0, faces: 0, forward: Vec::new() }
    }

    /// Checks one line, given as words and as it stands.
    pub(super) fn line(&mut self, line: usize, words: &[&[u8]], text: &[u8]) -> Result<(), ObjError> {
        match words.split_first() {
            Some((&b"v", numbers)) => self.vertex(line, text, numbers),
            Some((&b"f", corners)) => self.face(line, text, corners),
            _ => Ok(()),
        }
    }

    fn vertex(&mut self, line: usize, text: &[u8], numbers: &[&[u8]]) -> Result<(), ObjError> {
        // x y z, then nothing, a weight, or a colour of three or four.
        if !matches!(numbers.len(), 3 | 4 | 6 | 7) {
            return Err(self.syntax(line, "a vertex `v x y z`", text));
        }
        self.clean.push('v');
        for (place, word) in numbers.iter().take(4.min(numbers.len())).enumerate() {
            match single(word) {
                Ok(weight) if place == 3 && numbers.len() == 4 => {
                    if weight != 1.0 {
                        return Err(self.syntax(line, "a vertex without a weight other than 1", word));
                    }
                }
                _ if place == 3 => {}
                Ok(_) => {
                    self.clean.push(' ');
                    // A number is ASCII.
                    self.clean.push_str(&String::from_utf8_lossy(word));
                }
                Err(fault) => return Err(self.syntax(line, fault.expected(), word)),
            }
        }
        self.clean.push('\n');
        self.vertices += 1;
        Ok(())
    }

    fn face(&mut self, line: usize, text: &[u8], corners: &[&[u8]]) -> Result<(), ObjError> {
        if corners.len() < 3 {
            return Err(self.syntax(line, "a face of at least three corners `f 1 2 3`", text));
        }
        self.clean.push('f');
        for &corner in corners {
            let Some(index) = position_index(corner) else {
                return Err(self.syntax(line, "a corner `1`, `1/1`, `1//1` or `1/1/1`", corner));
            };
            let vertices = self.vertices;
            let place = match index {
                0 => None,
                1.. => usize::try_from(index).ok(),
                _ => usize::try_from(index.unsigned_abs())
                    .ok()
                    .and_then(|back| (vertices + 1).checked_sub(back))
                    .filter(|&at| at > 0),
            };
            let Some(place) = place else {
                return Err(ObjError::IndexOutOfRange { path: self.name.into(), line, index, vertices });
            };
            if place > vertices {
                self.forward.push((line, index));
            }
            self.clean.push_str(&format!(" {place}"));
        }
        self.clean.push('\n');
        self.faces += 1;
        Ok(())
    }

    /// The mesh of the checked lines, once it is known how many vertices there are.
    pub(super) fn mesh(self) -> Result<Mesh, ObjError> {
        let beyond = |&&(_, index): &&(usize, i64)| usize::try_from(index).map_or(true, |index| index > self.vertices);
        if let Some(&(line, index)) = self.forward.iter().find(beyond) {
            return Err(ObjError::IndexOutOfRange { path: self.name.into(), line, index, vertices: self.vertices });
        }
        if self.faces == 0 {
            return Err(ObjError::NoFaces { path: self.name.into() });
        }
        load_clean(&self.clean, self.name)
    }

    pub(super) fn syntax(&self, line: usize, expected: &'static str, found: &[u8]) -> ObjError {
        ObjError::Syntax { path: self.name.into(), line, expected, found: quoted(found) }
    }
}

/// The position index of a corner `v`, `v/vt`, `v//vn` or `v/vt/vn`.
fn position_index(corner: &[u8]) -> Option<i64> {
    let mut parts = std::str::from_utf8(corner).ok()?.split('/');
    let index = parts.next()?.parse().ok()?;
    let others: Vec<&str> = parts.collect();
    let fine = others.len() <= 2 && others.iter().all(|part| part.is_empty() || part.parse::<i64>().is_ok());
    fine.then_some(index)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Mesh, ObjError> {
        parse_obj(text.as_bytes(), Path::new("m.obj"))
    }

    fn message(text: &str) -> String {
        parse(text).unwrap_err().to_string()
    }

    #[test]
    fn reads_faces_in_file_order_across_groups() {
        let text = "mtllib none.mtl\no a\nv 0 0 0\nv 1 0 0 # a comment\r\nv 1 1 0 1\nv 0 1 0 1 0 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n\
                    g b\nusemtl x\nv 0 0 1\nf -1 -2 \\\n -3\nl 1 2\nf 2 3 5";
        let mesh = parse(text).expect("a mesh");
        assert_eq!(mesh.len(), 4);
        assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3], [4, 3, 2], [1, 2, 4]]);
        assert_eq!(mesh.positions()[4], [0.0, 0.0, 1.0]);
    }

    #[test]
    fn a_byte_order_mark_hides_no_vertex() {
        let mesh = parse("\u{feff}v 5 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3").expect("a mesh");
        assert_eq!(mesh.positions()[0], [5.0, 0.0, 0.0]);
    }

    #[test]
    fn errors_say_where_and_what() {
        let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        assert_eq!(message("v 0 0 0"), "m.obj: expected at least one face (a line `f 1 2 3`), found none");
        assert_eq!(message("v 0 nan 0\nf 1 1 1"), "m.obj:1: expected a finite number, found `nan`");
        let large = "a number that is not too large for a 32-bit float: at most 3.4028235e38";
        assert_eq!(message("\nv 0 1e39 0"), format!("m.obj:2: expected {large}, found `1e39`"));
        assert_eq!(message("v 0 0"), "m.obj:1: expected a vertex `v x y z`, found `v 0 0`");
        assert_eq!(message("v 0 0 0 2"), "m.obj:1: expected a vertex without a weight other than 1, found `2`");
        assert_eq!(
            message(&format!("{triangle}f 1 2")),
            "m.obj:4: expected a face of at least three corners `f 1 2 3`, found `f 1 2`"
        );
        assert_eq!(
            message(&format!("{triangle}f 1 2 4")),
            "m.obj:4: a face uses vertex 4, expected 1 to 3 (or -1 to -3)"
        );
        assert_eq!(
            message(&format!("{triangle}f 1 2 -4")),
            "m.obj:4: a face uses vertex -4, expected 1 to 3 (or -1 to -3)"
        );
        assert_eq!(
            message(&format!("{triangle}f 0 1 2")),
            "m.obj:4: a face uses vertex 0, expected 1 to 3 (or -1 to -3)"
        );
        let far = message(&format!("{triangle}f 1 2 9223372036854775807"));
        assert!(far.starts_with("m.obj:4: a face uses vertex 9223372036854775807"), "{far}");
        assert!(
            message(&format!("{triangle}f 1 2 -9223372036854775808")).starts_with("m.obj:4: a face uses vertex -9")
        );
        assert_eq!(
            message(&format!("{triangle}f 1 2 x")),
            "m.obj:4: expected a corner `1`, `1/1`, `1//1` or `1/1/1`, found `x`"
        );
        assert!(
            load_obj(Path::new("/no/such/file.obj"))
                .unwrap_err()
                .to_string()
                .eq("cannot read the model /no/such/file.obj")
        );
    }

    #[test]
    fn a_face_may_come_before_its_vertices() {
        assert_eq!(parse("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0").expect("a mesh").len(), 1);
    }

    #[test]
    fn degenerate_triangles_keep_their_place() {
        let mesh = parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2\nf 1 2 3").expect("a mesh");
        assert_eq!((mesh.len(), mesh.degenerate_count()), (2, 1));
    }
}
