//! Study of the difference of two pictures: numerical and perceptual.

mod compare;
mod report;

use crate::report::{Findings, Provenance};
use crate::study::{ProgressFn, Study};

pub use compare::{DifferenceBounds, DifferenceError, PictureDifference, PictureInput};

impl Study for PictureDifference {
    type Error = DifferenceError;

    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, DifferenceError> {
        let outcome = self.compare(progress)?;
        report::findings(self, outcome)
    }

    fn provenance(&self, provenance: Provenance) -> Provenance {
        provenance
    }
}
