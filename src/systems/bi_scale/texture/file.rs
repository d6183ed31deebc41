//! Bidirectional textures as NumPy arrays: f4 or f8 in C order, with shape (views, lights, size, size, 3).
//!
//! Views and lights are the directions of k x k cells, so their numbers are squares. Rows of texels run along v,
//! columns along u; the last axis is red, green, blue. `BidirectionalTexture` defines the samples.

use std::io::{self, Write};
use std::path::Path;

use super::response::{BidirectionalTexture, MAX_BYTES};
use crate::bi_scale::directions::LocalDirections;
use crate::error::{InputError, input_error};
use crate::io::{NumberArray, load_npy_array, write_npy_array};

fn shape_error(path: &Path, found: Vec<usize>) -> InputError {
    input_error!("crossbar::bidirectional_texture::shape" =>
        "expected an array of the shape (views, lights, size, size, 3), found {found:?}";
        help "`crossbar bi-scale texture` writes such files")
    .at(path)
}

/// Reads a texture from a file.
pub fn load_bidirectional_texture(path: &Path) -> Result<BidirectionalTexture, InputError> {
    let NumberArray { shape, values } = load_npy_array(path, "bidirectional texture", MAX_BYTES)?;
    let &[views, lights, size, columns, 3] = &shape[..] else {
        return Err(shape_error(path, shape));
    };
    if size != columns {
        return Err(shape_error(path, shape));
    }
    let directions = |what, found: usize| {
        let side = (1..=LocalDirections::MOST).find(|side| side * side == found).unwrap_or(0);
        let refused = |_| {
            input_error!("crossbar::bidirectional_texture::directions" =>
                "expected {what} of a square of k x k cells, k from 1 to {}, found {found}", LocalDirections::MOST;
                help "sample the patch in all directions that docs/papers/bi_scale.md lists")
            .at(path)
        };
        LocalDirections::new(side).map_err(refused)
    };
    let (view, light) = (directions("views", views)?, directions("directions of light", lights)?);
    let samples = values.as_chunks().0.to_vec();
    BidirectionalTexture::new(size, view, light, samples)
        .map_err(|reason| input_error!("crossbar::bidirectional_texture::samples" => "{reason}").at(path))
}

/// Writes a texture. Fails with errors of `out`.
pub fn write_bidirectional_texture(texture: &BidirectionalTexture, out: &mut dyn Write) -> io::Result<()> {
    let [views, lights] = [texture.view(), texture.light()].map(|directions| directions.directions().len());
    let shape = [views, lights, texture.size(), texture.size(), 3];
    write_npy_array(&shape, texture.samples().as_flattened(), out)
}
