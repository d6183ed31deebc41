//! Study of the difference of two pictures: numerical and perceptual.

mod compare;
mod report;

use crate::report::Findings;
use crate::study::{ProgressFn, Study, StudyError};

pub use compare::{DifferenceOptions, PictureDifference, PictureInput};

impl Study for PictureDifference {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        let outcome = self.compare(progress)?;
        report::findings(self, outcome)
    }
}
