//! Scenes of Tables I and II.

use super::{PaperFigure, StudyError, printed};

/// Scene of either table.
pub(super) struct PrintedScene {
    /// Name of the scene in its figures' names.
    pub(super) id: &'static str,
    pub(super) name: &'static str,
    /// Number of local directions per side.
    pub(super) side: usize,
    /// Width and height of the picture that is timed; Table II gives no size.
    pub(super) picture: [u32; 2],
}

impl PrintedScene {
    /// Name of one of the scene's figures.
    pub(super) fn figure(&self, what: &str) -> String {
        format!("bi-scale/{what}-{}", self.id)
    }

    pub(super) fn printed(&self, what: &str) -> Result<&'static PaperFigure, StudyError> {
        printed(&self.figure(what))
    }

    pub(super) fn vertices(&self) -> Result<usize, StudyError> {
        Ok(self.printed("vertices")?.value as usize)
    }

    pub(super) fn rows(&self) -> Result<usize, StudyError> {
        Ok(self.vertices()? * self.side * self.side)
    }
}

const fn scene(id: &'static str, name: &'static str, side: usize, picture: [u32; 2]) -> PrintedScene {
    PrintedScene { id, name, side, picture }
}

pub(super) const SCENES: [PrintedScene; 6] = [
    scene("bunny", "bunny", 8, [640, 480]),
    scene("armor", "armor", 12, [480, 640]),
    scene("chair", "chair", 8, [640, 640]),
    scene("temple", "temple", 8, [640, 480]),
    scene("middle-bunny", "middle bunny", 8, [640, 480]),
    scene("fine-bunny", "fine bunny", 8, [640, 480]),
];
