//! Provenance notes in picture files.

/// Text for a picture's files, and the picture's camera. Notes have no date, so that equal pictures give equal bytes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PictureNotes {
    /// Program with its version: `Software` in PNG, `software` in EXR.
    pub software: String,
    /// Description of how the picture was made: `Comment` in PNG, `comments` in EXR.
    pub comments: String,
    /// `worldToCamera` in EXR, row by row: a point, as a row vector, times this matrix has the components right, up and
    /// forward in the camera's frame, so that the third is the channel `Z`.
    pub world_to_camera: Option<[f32; 16]>,
}
