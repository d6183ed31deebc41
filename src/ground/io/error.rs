//! Errors of reading files.

use std::fmt::Display;
use std::path::Path;

use super::read_limited;
use crate::error::{FilePlace, InputError, input_error};

/// The contents of a file of at most `limit` bytes; `what` is the kind of file in messages.
pub fn read_file(path: &Path, what: &str, limit: u64) -> Result<Vec<u8>, InputError> {
    let read = read_limited(path, limit).map_err(|source| {
        input_error!("crossbar::file::unreadable" =>
            "cannot read the {what} {}", path.display(); help "check the path, and that you may read the file")
        .with_source(source)
    })?;
    read.ok_or_else(|| too_long_error(what, path, limit))
}

pub(super) fn too_long_error(what: &str, path: &Path, limit: u64) -> InputError {
    input_error!("crossbar::file::too_long" =>
        "expected a {what} of at most {limit} bytes, found more"; help "use a smaller file")
    .at(path)
}

pub(super) fn syntax_error(place: impl Into<FilePlace>, expected: impl Display, found: impl Display) -> InputError {
    input_error!("crossbar::model::syntax" =>
        "expected {expected}, found {found}";
        help "models are Wavefront OBJ, PLY, STL or glTF files: is this one of them, and is it complete?")
    .at(place)
}

pub(super) fn element_error(
    place: impl Into<FilePlace>,
    element: &str,
    index: usize,
    expected: impl Display,
    found: impl Display,
) -> InputError {
    input_error!("crossbar::model::element" =>
        "{element} {index} (counted from 0): expected {expected}, found {found}";
        help "is the file complete, and written as its header says?")
    .at(place)
}

pub(super) fn part_error(name: &Path, part: impl Display, expected: impl Display, found: impl Display) -> InputError {
    input_error!("crossbar::model::part" =>
        "{part}: expected {expected}, found {found}"; help "docs/scenes.md lists the parts of glTF that are read")
    .at(name)
}

pub(super) fn material_error(
    place: impl Into<FilePlace>,
    name: impl Display,
    expected: &str,
    found: impl Display,
) -> InputError {
    input_error!("crossbar::model::material" =>
        "material {name}: expected {expected}, found {found}";
        help "docs/scenes.md says which materials a model may have")
    .at(place)
}

pub(super) fn mesh_error(name: &Path, reason: InputError) -> InputError {
    reason.coded("crossbar::model::mesh").with_help("correct the model in the program that wrote it").at(name)
}

pub(super) fn scene_error(name: &Path, reason: InputError) -> InputError {
    reason.coded("crossbar::model::scene").with_help("correct the model in the program that wrote it").at(name)
}
