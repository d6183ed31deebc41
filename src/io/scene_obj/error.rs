//! Why a file is no scene.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::MtlError;
use crate::io::{ObjError, PlyError};
use crate::scene::SceneError;

/// Why a file is no scene. Lines count from 1.
#[derive(Debug, Error, miette::Diagnostic)]
pub enum SceneObjError {
    /// Something about its geometry.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Obj(#[from] ObjError),
    /// Something about a PLY file.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Ply(#[from] PlyError),
    /// A material library cannot be read.
    #[error(
        "{}:{line}: cannot read the material library {}; put it beside the model, or take the line out",
        path.display(), library.display()
    )]
    Library {
        /// The model.
        path: PathBuf,
        /// The line that names the library.
        line: usize,
        /// The library.
        library: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Something about a material.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Mtl(#[from] MtlError),
    /// The parts do not make a scene.
    #[error("{}: {reason}", path.display())]
    Scene {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: SceneError,
    },
}
