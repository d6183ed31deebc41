//! Scenes of Tables I and II.

use super::{PaperFigure, StudyError, printed};

/// Name of the host on which biclusters are computed.
pub(super) const HOST: &str = "host";

/// Scene of either table.
pub(super) struct PrintedScene {
    /// Name of the scene in its figures' names.
    pub(super) id: &'static str,
    pub(super) name: &'static str,
    /// Number of local directions per side.
    pub(super) side: usize,
    /// Width and height of the picture that is timed; Table II names none.
    pub(super) picture: [u32; 2],
}

impl PrintedScene {
    const fn new(id: &'static str, name: &'static str, side: usize, picture: [u32; 2]) -> Self {
        Self { id, name, side, picture }
    }

    /// Name of one of the scene's figures.
    pub(super) fn figure(&self, what: &str) -> String {
        format!("bi-scale/{what}-{}", self.id)
    }

    /// One of the scene's printed figures.
    pub(super) fn printed(&self, what: &str) -> Result<&'static PaperFigure, StudyError> {
        printed(&self.figure(what))
    }

    pub(super) fn vertices(&self) -> Result<usize, StudyError> {
        Ok(self.printed("vertices")?.value as usize)
    }

    /// Number of rows of the matrix.
    pub(super) fn rows(&self) -> Result<usize, StudyError> {
        Ok(self.vertices()? * self.side * self.side)
    }
}

pub(super) const SCENES: [PrintedScene; 6] = [
    PrintedScene::new("bunny", "bunny", 8, [640, 480]),
    PrintedScene::new("armor", "armor", 12, [480, 640]),
    PrintedScene::new("chair", "chair", 8, [640, 640]),
    PrintedScene::new("temple", "temple", 8, [640, 480]),
    PrintedScene::new("middle-bunny", "middle bunny", 8, [640, 480]),
    PrintedScene::new("fine-bunny", "fine bunny", 8, [640, 480]),
];
