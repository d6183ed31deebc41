//! Bidirectional textures as NumPy arrays: f4 or f8 in C order, with shape (views, lights, size, size, 3).
//!
//! Views and lights are those of squares of k x k cells, so their numbers are squares. Rows of texels run along v,
//! columns along u; the last axis is red, green, blue. `BidirectionalTexture` defines the numbers.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::response::{BidirectionalTexture, BidirectionalTextureError};
use crate::bi_scale::directions::LocalDirections;
use crate::io::{NumberArray, NumbersError, load_npy_array, write_npy_array};

/// Largest size of a file that is read, in bytes (8 GiB).
const MAX_BYTES: u64 = 1 << 33;

/// Errors of reading a bidirectional texture.
#[non_exhaustive]
#[derive(Debug, Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum BidirectionalTextureFileError {
    /// The file is not there, too long, or no array.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Numbers(#[from] NumbersError),
    /// An array of another shape.
    #[error("{}: expected an array of the shape (views, lights, size, size, 3), found {found:?}", path.display())]
    #[diagnostic(code(crossbar::bidirectional_texture::shape), help("`crossbar bi-scale texture` writes such files"))]
    Shape { path: PathBuf, found: Vec<usize> },
    /// Directions are lacking, or too many.
    #[error("{}: expected {what} of a square of k x k cells, k from 1 to {}, found {found}", path.display(),
        LocalDirections::MOST)]
    #[diagnostic(
        code(crossbar::bidirectional_texture::directions),
        help("sample the patch in the directions that docs/papers/bi_scale.md names, all of them")
    )]
    Directions { path: PathBuf, what: &'static str, found: usize },
    /// Its samples are none.
    #[error("{}: {reason}", path.display())]
    #[diagnostic(code(crossbar::bidirectional_texture::samples))]
    Samples { path: PathBuf, reason: BidirectionalTextureError },
}

/// Reads a texture from a file.
///
/// # Errors
/// [`BidirectionalTextureFileError`].
pub fn load_bidirectional_texture(path: &Path) -> Result<BidirectionalTexture, BidirectionalTextureFileError> {
    let NumberArray { shape, values } = load_npy_array(path, "bidirectional texture", MAX_BYTES)?;
    let &[views, lights, size, columns, 3] = &shape[..] else {
        return Err(BidirectionalTextureFileError::Shape { path: path.into(), found: shape });
    };
    if size != columns {
        return Err(BidirectionalTextureFileError::Shape { path: path.into(), found: shape });
    }
    let directions = |what, found: usize| {
        let side = (1..=LocalDirections::MOST).find(|side| side * side == found).unwrap_or(0);
        let refused = |_| BidirectionalTextureFileError::Directions { path: path.into(), what, found };
        LocalDirections::new(side).map_err(refused)
    };
    let (view, light) = (directions("views", views)?, directions("directions of light", lights)?);
    let samples = values.as_chunks().0.to_vec();
    BidirectionalTexture::new(size, view, light, samples)
        .map_err(|reason| BidirectionalTextureFileError::Samples { path: path.into(), reason })
}

/// Writes a texture.
///
/// # Errors
/// Those of `out`.
pub fn write_bidirectional_texture(texture: &BidirectionalTexture, out: &mut dyn Write) -> io::Result<()> {
    let [views, lights] = [texture.view(), texture.light()].map(|directions| directions.directions().len());
    let shape = [views, lights, texture.size(), texture.size(), 3];
    write_npy_array(&shape, texture.samples().as_flattened(), out)
}
