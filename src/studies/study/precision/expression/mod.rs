//! Study of expressions: bits of error in number formats, the smallest format that meets a goal, and the operations
//! that lose the bits.
//!
//! An expression is computed twice for each sampled input: over the reals, in intervals that narrow until the rounded
//! result is decided ([`real`]), and in a format, each operation rounded once ([`arithmetic`]). docs/precision.md
//! defines the measures.

mod arithmetic;
mod blame;
mod errors;
mod graph;
mod real;
mod report;
mod sample;
mod study;
mod syntax;

use super::super::{ProgressFn, Study, StudyError};
use crate::report::{Findings, Provenance};

pub use sample::InputDraw;
pub use study::ExpressionStudy;
pub use syntax::ExpressionError;

impl Study for ExpressionStudy {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        let goal = self.goal()?;
        let mut outcomes = Vec::new();
        for (index, expression) in self.expressions.iter().enumerate() {
            progress(&expression.name, index as u64, self.expressions.len() as u64);
            outcomes.push(self.outcome(expression, &goal));
        }
        report::findings(self, &goal, outcomes)
    }

    fn provenance(&self, mut provenance: Provenance) -> Provenance {
        provenance.seed = Some(self.seed);
        provenance
    }
}
