//! Figures 1, 2 and 4 to 7: pictures and derived counts. Figure 3 is with the factors.

mod baselines;
mod clusters;
mod lit;
mod models;
mod parts;
mod rates;
mod scene;
mod terms;
mod truncation;

use super::{EntryFindings, HOST, PaperRow, Prose, Shared, Standing, StudyError, failed, number, paper_row, solved};
use crate::all_frequency::compressed::SegmentOptions;
use crate::report::PictureGrid;
use crate::study::prt::{light_picture, of_texels};
use crate::study::reproduce::ModelSize;
use parts::FigureParts;

const QUESTION: &str = "the models, the light of St. Peter's, the cameras and the sources of Figure 6 with their sizes, and the frame rates printed under \
    it, which the scan has lost.";

/// Parameters of runs at full size, of Table 1 too.
pub(in crate::study::reproduce) fn full_size() -> String {
    let size = ModelSize::Printed;
    let options = models::options(size, SegmentOptions::default().vectors);
    format!("{options:?} {:?} {}", baselines::options(size), models::ground(size))
}

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let mut found = EntryFindings { questions: vec![QUESTION], ..EntryFindings::default() };
    for parts in [
        baselines::figure(shared)?,
        terms::figure(shared)?,
        clusters::figure(shared)?,
        truncation::figure(shared.models)?,
        rates::figure(shared)?,
    ] {
        found.text.extend(parts.text);
        found.rows.extend(parts.rows);
        found.tables.extend(parts.tables);
        found.pictures.extend(parts.pictures);
    }
    let light = scene::stand_in()?;
    let light = light_picture("all-frequency-light", "a clear sky with a small sun", of_texels(light.texels()));
    let light = light.map_err(|e| failed(HOST)(&e))?;
    found.pictures.push(PictureGrid::new("The light of Figures 1, 2, 5 and 7", ["light"]).row("", [light]));
    Ok(found)
}
