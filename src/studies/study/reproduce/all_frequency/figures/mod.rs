//! Figures 1, 2 and 5 to 7: errors and derived counts. Figure 3 is in the module `factors`.

mod baselines;
mod models;
mod numbers;
mod rates;
mod scene;
mod truncation;

use super::{Dependence, EntryFindings, HOST, PaperRow, RunResult, Shared, StudyError, paper_row, paragraph, solved};
pub(in crate::study::reproduce) use rates::timed;

use crate::study::reproduce::{ModelSize, TimedWork};

const QUESTION: &str = "the models, the light of St. Peter's, the cameras, the sources of Figure 6 with their sizes, \
    and the frame rates printed under it, which the scan has lost.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let mut found = EntryFindings { questions: vec![QUESTION], ..EntryFindings::default() };
    for figure in [
        baselines::figure(shared)?,
        numbers::figure_2()?,
        numbers::figure_5(shared)?,
        truncation::figure(shared.models)?,
        rates::figure(shared.models)?,
    ] {
        found.text.extend(figure.text);
        found.rows.extend(figure.rows);
        found.tables.extend(figure.tables);
    }
    Ok(found)
}
