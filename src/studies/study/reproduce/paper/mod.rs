//! Printed figures of the papers: the data of `src/studies/papers`, one file per paper, each figure once.
//!
//! The files lie within the package, so that the program contains them. They state the bound of every judged figure
//! apart from any result; the program refuses a file whose bounds were changed without a list of the changes.

mod file;
mod statement;

use std::sync::LazyLock;

use super::error::papers_error;
use super::row::{Method, PaperFigure, PaperRow, Standing};
use crate::study::StudyError;

/// Names and contents of the files.
const FILES: [(&str, &str); 6] = [
    ("ray-engine", include_str!("../../../papers/ray_engine.toml")),
    ("radiosity", include_str!("../../../papers/radiosity.toml")),
    ("subsurface", include_str!("../../../papers/subsurface.toml")),
    ("cpca", include_str!("../../../papers/cpca.toml")),
    ("all-frequency", include_str!("../../../papers/all_frequency.toml")),
    ("bi-scale", include_str!("../../../papers/bi_scale.toml")),
];

/// Paper with its figures in the order of its file.
#[derive(Clone, Debug)]
pub struct Paper {
    /// Name, with which the names of its figures begin.
    pub id: &'static str,
    /// Title, authors and year.
    pub title: String,
    /// Printed, implied and inferred figures.
    pub figures: Vec<PaperFigure>,
}

static PAPERS: LazyLock<Result<Vec<Paper>, String>> = LazyLock::new(|| {
    let paper = |&(id, text): &(&'static str, &str)| {
        statement::verify(text).map_err(|reason| format!("the file of `{id}`: {reason}"))?;
        let (title, figures) = file::parse(id, text)?;
        Ok(Paper { id, title, figures })
    };
    FILES.iter().map(paper).collect()
});

/// Returns all papers.
///
/// # Errors
/// If a file is malformed, or states other bounds than it did.
pub fn papers() -> Result<&'static [Paper], StudyError> {
    PAPERS.as_deref().map_err(|reason| papers_error(reason))
}

/// Returns the figure with a name, as in `ray-engine/host-alone`.
///
/// # Errors
/// If there is none.
pub fn printed(id: &str) -> Result<&'static PaperFigure, StudyError> {
    let found = papers()?.iter().flat_map(|paper| &paper.figures).find(|figure| figure.id == id);
    found.ok_or_else(|| papers_error(&format!("no figure is named `{id}`")))
}

/// Returns the value of the figure with a name.
///
/// # Errors
/// As [`printed`].
pub(super) fn value(id: &str) -> Result<f64, StudyError> {
    Ok(printed(id)?.value)
}

/// Returns the row that judges the figure with a name by a value of ours, with the bound of the data.
///
/// # Errors
/// If there is no such figure, or if the data has a reason not to judge it.
pub(super) fn row(id: &str, by: (&'static str, Method), ours: (f64, Standing)) -> Result<PaperRow, StudyError> {
    let unjudged = || papers_error(&format!("the figure `{id}` is listed as not judged"));
    PaperRow::new(by, printed(id)?, ours).ok_or_else(unjudged)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::study::reproduce::row::Judgement;

    #[test]
    fn every_figure_has_a_name_of_its_own_and_a_bound_or_a_reason() {
        let figures: Vec<&PaperFigure> = papers().expect("the files").iter().flat_map(|paper| &paper.figures).collect();
        let names: BTreeSet<&str> = figures.iter().map(|figure| figure.id.as_str()).collect();
        assert_eq!(names.len(), figures.len());
        for figure in figures {
            assert!(figure.value.is_finite() && !figure.what.is_empty() && !figure.place.is_empty(), "{}", figure.id);
            assert!(!matches!(&figure.judgement, Judgement::Not(reason) if reason.is_empty()), "{}", figure.id);
        }
    }

    /// No figure of a paper stands twice: a second row with the same value, unit and words is the same figure.
    #[test]
    fn each_printed_figure_stands_once() {
        for paper in papers().expect("the files") {
            let mut seen = BTreeSet::new();
            for figure in &paper.figures {
                let key = (figure.value.to_bits(), &figure.unit, &figure.what, &figure.place);
                assert!(seen.insert(key), "{} stands twice", figure.id);
            }
        }
    }

    /// Bounds and readings are those that were stated, but for the changes that the files list.
    #[test]
    fn bounds_are_those_that_were_stated() {
        let refused =
            FILES.into_iter().filter_map(|(id, text)| Some(format!("{id}: {}", statement::verify(text).err()?)));
        assert_eq!(refused.collect::<Vec<_>>(), Vec::<String>::new());
    }

    #[test]
    fn an_unknown_name_is_an_error() {
        let error = printed("ray-engine/host-alon").expect_err("a typo").to_string();
        assert!(error.contains("no figure is named `ray-engine/host-alon`"), "{error}");
    }
}
