//! What a picture's file says of where the picture comes from.

/// Text for the files of a picture, and the camera that it was taken with. There is no date: the same picture gives the
/// same bytes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PictureNotes {
    /// The program that made it, with its version: `Software` in PNG, `software` in EXR.
    pub software: String,
    /// How it was made: `Comment` in PNG, `comments` in EXR.
    pub comments: String,
    /// `worldToCamera` in EXR: a point as a row vector times this matrix, row by row, is to the right, up, and forward
    /// of the camera, so that its third coordinate is the channel `Z`.
    pub world_to_camera: Option<[f32; 16]>,
}
