//! Finds the expressions of a WGSL shader that may be f16.

use super::bits::{Assignment, FormatBits};
use super::runs::{RunError, Runs};

/// The format of f16.
const HALF: FormatBits = FormatBits::float(5, 10);

/// Expression in half precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HalfExpression {
    /// Index of its place.
    pub(super) place: usize,
    /// Value of the goal's measure when it alone is f16.
    pub(super) alone: f64,
    /// `true` if it is f16 in the largest set that was found to meet the goal.
    pub(super) together: bool,
}

/// Tries each expression alone; then adds one after the other, the harmless first, as long as the goal is met.
pub(super) fn half_expressions(runs: &mut Runs<'_>, found: &mut Vec<HalfExpression>) -> Result<(), RunError> {
    if !runs.programs.iter().all(|studied| studied.text.is_wgsl()) {
        return Ok(());
    }
    runs.step("half precision");
    for place in 0..runs.count() {
        let alone = runs.value(&runs.alone(place, HALF))?;
        found.push(HalfExpression { place, alone, together: false });
    }
    let mut order: Vec<usize> = (0..found.len()).filter(|at| runs.goal.met(found[*at].alone)).collect();
    order.sort_by(|a, b| found[*a].alone.total_cmp(&found[*b].alone));
    let mut together: Assignment = vec![None; runs.count()];
    for at in order {
        together[found[at].place] = Some(HALF);
        found[at].together = runs.meets(&together)?;
        if !found[at].together {
            together[found[at].place] = None;
        }
    }
    Ok(())
}
