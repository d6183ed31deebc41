//! Printed figures of the papers: the data of `src/studies/papers`, one file per paper, each figure once.
//!
//! The files are embedded in the program. They state the bound of every judged figure independently of any result; the
//! program rejects a file whose bounds were changed without a list of the changes. A figure that follows only from
//! other printed figures also has the expression of its row.

mod expression;
mod file;
mod statement;

use std::sync::LazyLock;

use strum::VariantArray as _;

use super::Paper;
use super::error::papers_error;
use super::row::{Contradiction, Dependence, Method, PaperFigure, PaperRow};
use crate::study::StudyError;

static FIGURES: LazyLock<Result<Vec<PaperFigure>, String>> = LazyLock::new(|| {
    let mut figures = Vec::new();
    for &paper in Paper::VARIANTS {
        let in_file = |reason| format!("the file of `{}`: {reason}", paper.id());
        figures.extend(parse_figures(paper, paper.file()).map_err(in_file)?);
    }
    Ok(figures)
});

/// Checks a paper's file against its statement digests, and parses its figures; errors are sentences. Fails if the file
/// is malformed, or its bounds differ from their statements.
pub fn parse_figures(paper: Paper, text: &str) -> Result<Vec<PaperFigure>, String> {
    let file = file::PaperFile::parse(text)?;
    statement::verify(&file)?;
    file::figures(paper, &file)
}

/// Returns the printed, implied and inferred figures of all papers, in the order of their files. Fails if a file is
/// malformed, or its bounds differ from their statements.
pub fn figures() -> Result<&'static [PaperFigure], StudyError> {
    FIGURES.as_deref().map_err(|reason| papers_error(reason))
}

/// Returns the figure with a name, as in `ray-engine/host-alone`. Fails if no figure has that name.
pub fn printed(id: &str) -> Result<&'static PaperFigure, StudyError> {
    let found = figures()?.iter().find(|figure| figure.id == id);
    found.ok_or_else(|| papers_error(&format!("no figure is named `{id}`")))
}

/// Returns the value of the figure with a name. Fails as [`printed`] does.
pub(super) fn value(id: &str) -> Result<f64, StudyError> {
    Ok(printed(id)?.value)
}

/// Returns the row that compares our value with the figure of this name, with the bound from the data. Fails if there
/// is no such figure, or if the data has a reason not to judge it.
pub(super) fn row(id: &str, by: (&'static str, Method), ours: (f64, Dependence)) -> Result<PaperRow, StudyError> {
    let unjudged = || papers_error(&format!("the figure `{id}` is listed as not judged"));
    PaperRow::new(by, printed(id)?, ours).ok_or_else(unjudged)
}

/// Name of the host on which our values are computed.
pub(super) const HOST: &str = "host";

/// Returns the row for a value that is computed in f64 and uses no printed value. Fails as [`row`] does.
pub(super) fn solved(id: &str, ours: f64) -> Result<PaperRow, StudyError> {
    row(id, (HOST, Method::Solver), (ours, Dependence::Counted))
}

/// Returns the row for a value that is drawn on a card, from no printed value. Fails as [`row`] does.
pub(super) fn drawn(id: &str, card: &'static str, ours: f64) -> Result<PaperRow, StudyError> {
    row(id, (card, Method::Pipeline), (ours, Dependence::Predicted { from: "" }))
}

/// Returns the rows of an entry whose values are expressions of printed values, in the order of the file. Fails as
/// [`row`] does.
pub(super) fn equations(entry: &str) -> Result<Vec<PaperRow>, StudyError> {
    let mut rows = Vec::new();
    for figure in figures()? {
        let Some(equation) = figure.equation.as_ref().filter(|equation| equation.entry == entry) else { continue };
        let by = (equation.device.as_str(), Method::Equation);
        let dependence = Dependence::new(equation.chose.as_deref(), equation.uses.as_deref());
        let row = row(&figure.id, by, (equation.ours, dependence))?;
        let contradiction =
            equation.contradicts.as_ref().and_then(|how| Contradiction::between(figure, equation.ours, how));
        rows.push(row.with_readings(equation.readings.iter().copied()).contradicted(contradiction));
    }
    Ok(rows)
}
