//! Errors of reading files.

use std::borrow::Cow;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::read_limited;
use crate::geom::MeshError;
use crate::geom::polygon::PolygonFault;
use crate::scene::SceneError;

/// Errors of reading a file's bytes.
#[non_exhaustive]
#[derive(Debug, Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("cannot read the {what} {}", path.display())]
    #[diagnostic(code(crossbar::file::unreadable), help("check the path, and that you may read the file"))]
    Unreadable { what: &'static str, path: PathBuf, source: io::Error },
    /// The file is longer than what is read.
    #[error("{}: expected a {what} of at most {limit} bytes, found more", path.display())]
    #[diagnostic(code(crossbar::file::too_long), help("name a smaller file"))]
    TooLong { what: &'static str, path: PathBuf, limit: u64 },
}

/// The whole of a file, which is a `what`, of at most `limit` bytes.
pub(super) fn read(path: &Path, what: &'static str, limit: u64) -> Result<Vec<u8>, ReadError> {
    let read = read_limited(path, limit).map_err(|source| ReadError::Unreadable { what, path: path.into(), source })?;
    read.ok_or_else(|| ReadError::TooLong { what, path: path.into(), limit })
}

/// A file and, where something is wrong in one line of it, the line, from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilePlace {
    /// The file.
    pub path: PathBuf,
    /// The line.
    pub line: Option<usize>,
}

impl FilePlace {
    /// A line of a file.
    pub(super) fn line(path: &Path, line: usize) -> Self {
        Self { path: path.into(), line: Some(line) }
    }
}

impl From<&Path> for FilePlace {
    fn from(path: &Path) -> Self {
        Self { path: path.into(), line: None }
    }
}

impl fmt::Display for FilePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        self.line.map_or(Ok(()), |line| write!(f, ":{line}"))
    }
}

/// Errors of reading a mesh, a scene or a material library.
#[non_exhaustive]
#[derive(Debug, Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum ModelError {
    /// The file is not there, or too long.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Read(#[from] ReadError),
    /// A line, or the whole file, is not what belongs there.
    #[error("{place}: expected {expected}, found {found}")]
    #[diagnostic(
        code(crossbar::model::syntax),
        help("models are Wavefront OBJ, PLY, STL or glTF files: is the file one, and whole?")
    )]
    Syntax { place: FilePlace, expected: Cow<'static, str>, found: String },
    /// A face of an OBJ names a vertex, a texture coordinate or a normal that the file does not have.
    #[error("{place}: {what} {index}, expected 1 to {count} (or -1 to -{count})")]
    #[diagnostic(
        code(crossbar::model::index),
        help("faces count from 1, or from -1 backwards: is a part of the file missing?")
    )]
    IndexOutOfRange { place: FilePlace, what: &'static str, index: i64, count: usize },
    /// An element of a PLY's binary data that differs from its description in the header.
    #[error("{place}: {element} {index} (counted from 0): expected {expected}, found {found}")]
    #[diagnostic(code(crossbar::model::element), help("is the file whole, and written as its header says?"))]
    Element { place: FilePlace, element: String, index: usize, expected: Cow<'static, str>, found: Cow<'static, str> },
    /// A part of a glTF file is not what belongs there. Parts are counted from 0, as the format does.
    #[error("{place}: {part}: expected {expected}, found {found}")]
    #[diagnostic(code(crossbar::model::part), help("docs/scenes.md says what of glTF is read"))]
    Part { place: FilePlace, part: String, expected: Cow<'static, str>, found: String },
    /// A buffer beside a glTF file cannot be read.
    #[error("{place}: buffers[{buffer}]: cannot read {}", path.display())]
    #[diagnostic(code(crossbar::model::buffer), help("put it beside the model"))]
    Buffer { place: FilePlace, buffer: usize, path: PathBuf, source: io::Error },
    /// A material library gives a name twice.
    #[error("{0}: expected each material once, found a second `newmtl {1}`")]
    #[diagnostic(code(crossbar::model::second_material), help("rename one of the two"))]
    SecondMaterial(FilePlace, String),
    /// Parameters of a material that contradict each other. In an MTL file the place is its `newmtl`.
    #[error("{place}: material {name}: expected {expected}, found {found}")]
    #[diagnostic(code(crossbar::model::material), help("docs/scenes.md says which materials a model may have"))]
    Material { place: FilePlace, name: String, expected: &'static str, found: String },
    /// A material library cannot be read.
    #[error("{place}: cannot read the material library {}", library.display())]
    #[diagnostic(code(crossbar::model::library), help("put it beside the model, or take the line out"))]
    Library { place: FilePlace, library: PathBuf, source: io::Error },
    /// A face of four corners or more has no certain interior.
    #[error("{place}: expected a flat face that does not touch itself, found one {fault}")]
    #[diagnostic(
        code(crossbar::model::polygon),
        help("cut the face into triangles in the program that wrote it, or read the model without `--strict`")
    )]
    Polygon { place: String, fault: PolygonFault },
    /// The parts do not make a mesh.
    #[error("{0}: {1}")]
    #[diagnostic(code(crossbar::model::mesh), help("mend the model in the program that wrote it"))]
    Mesh(FilePlace, MeshError),
    /// The parts do not make a scene.
    #[error("{0}: {1}")]
    #[diagnostic(code(crossbar::model::scene), help("mend the model in the program that wrote it"))]
    Scene(FilePlace, SceneError),
}
