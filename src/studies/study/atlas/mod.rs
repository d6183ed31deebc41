//! Study of a mesh's atlas: quality, pictures and files.

mod export;
mod parameters;
mod pictures;
mod report;

use crate::atlas::{Atlas, AtlasQuality};
use crate::report::Findings;
use crate::study::{ProgressFn, Study, StudyError};

pub use parameters::{AtlasStudy, no_atlas};
pub use pictures::MAX_PICTURE;

impl Study for AtlasStudy {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        let steps = if self.camera.is_some() { 3 } else { 2 };
        progress("clustering faces", 0, steps);
        let atlas = Atlas::new(&self.mesh, self.side).map_err(no_atlas)?;
        progress("measuring", 1, steps);
        let quality = AtlasQuality::of(&atlas);
        if self.camera.is_some() {
            progress("drawing", 2, steps);
        }
        Ok(report::findings(self, &atlas, &quality))
    }
}
