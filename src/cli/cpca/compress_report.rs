//! Tables and documents of the steps of `crossbar cpca compress`.

use serde_json::{Value, json};

use crate::clustering::{Clustering, CpcaStep, CpcaStepKind};
use crate::report::{Cell, Table};

const fn word(kind: CpcaStepKind) -> &'static str {
    match kind {
        CpcaStepKind::Classified => "classified",
        CpcaStepKind::Fitted => "fitted",
        CpcaStepKind::Redistributed => "redistributed",
    }
}

/// Table of the last step for each number of vectors, and every redistribution; the document has all steps.
pub(super) fn table(steps: &[CpcaStep], energy: f64) -> Table {
    let mut table = Table::new("Steps", &["steps", "vectors", "ends", "squared error", "of the signal (%)"]);
    let last = |at: usize| steps.get(at + 1).is_none_or(|next| next.vectors != steps[at].vectors);
    for (at, step) in steps.iter().enumerate() {
        if last(at) || step.kind == CpcaStepKind::Redistributed {
            let share = if energy > 0.0 { Cell::measured(100.0 * step.squared_error / energy) } else { Cell::Empty };
            let error = Cell::measured(step.squared_error);
            table.push([(at + 1).into(), step.vectors.into(), word(step.kind).into(), error, share]);
        }
    }
    table
}

/// All steps as JSON.
pub(super) fn steps_document(steps: &[CpcaStep]) -> Value {
    let step = |step: &CpcaStep| {
        let &CpcaStep { vectors, kind, moved, squared_error } = step;
        json!({ "vectors": vectors, "step": word(kind), "moved": moved, "squared_error": squared_error })
    };
    steps.iter().map(step).collect()
}

/// The largest number of vectors of a cluster.
pub(super) fn most_vectors(clustering: &Clustering) -> usize {
    clustering.subspaces().iter().map(|subspace| subspace.len()).max().unwrap_or(0)
}
