//! Finds the expressions of a WGSL shader that may be f16.

use std::collections::{BTreeMap, BTreeSet};

use refsim::front::{WgslOperation, wgsl_operations};

use super::bits::{Assignment, FormatBits};
use super::runs::{RunError, Runs};
use crate::shader::ShaderText;

/// The format f16.
const HALF: FormatBits = FormatBits::float(5, 10);

/// Expression in half precision.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct HalfExpression {
    /// Index of its instruction place.
    pub(super) place: usize,
    /// Value of the goal's measure if only this expression is f16.
    pub(super) alone: f64,
    /// `true` if it is f16 in the largest set that was found to meet the goal.
    pub(super) together: bool,
    /// Location of the largest error of the run that refuted it.
    pub(super) worst: Option<String>,
}

/// The operations of a text by their spans; empty if it is not WGSL.
fn operations(text: &ShaderText) -> BTreeMap<[u32; 2], WgslOperation> {
    let found = if text.is_wgsl() { wgsl_operations(text.named_source().text()) } else { Ok(Vec::new()) };
    found.into_iter().flatten().map(|operation| ([operation.span.start, operation.span.end], operation)).collect()
}

/// Text spans of the instructions at a place.
fn spans(place: usize, runs: &Runs<'_>) -> impl Iterator<Item = [u32; 2]> {
    let place = &runs.places[place];
    let program = runs.programs[place.program].program;
    place.instructions.iter().map(|at| program.instructions[*at].span).map(|span| [span.start, span.end])
}

/// Tries each expression alone; then adds one after the other, least harmful first, as long as the goal is met.
pub(super) fn half_expressions(runs: &mut Runs<'_>, found: &mut Vec<HalfExpression>) -> Result<(), RunError> {
    let [studied] = runs.programs[..] else { return Ok(()) };
    let known = operations(studied.text);
    runs.step("half precision");
    for place in 0..runs.count() {
        if spans(place, runs).all(|span| known.contains_key(&span)) {
            let assignment = runs.alone(place, HALF);
            let alone = runs.value(&assignment)?;
            let worst = runs.made_before(&assignment).and_then(|(_, worst)| worst);
            found.push(HalfExpression { place, alone, together: false, worst });
        }
    }
    let mut order: Vec<usize> = (0..found.len()).filter(|at| runs.goal.met(found[*at].alone)).collect();
    order.sort_by(|a, b| found[*a].alone.total_cmp(&found[*b].alone));
    let mut together: Assignment = vec![None; runs.count()];
    for at in order {
        let expression = &mut found[at];
        together[expression.place] = Some(HALF);
        expression.together = runs.meets(&together)?;
        if !expression.together {
            expression.worst = runs.made_before(&together).and_then(|(_, worst)| worst);
            together[expression.place] = None;
        }
    }
    Ok(())
}

/// The text with f16 expressions, as many as may be f16 together.
pub(super) fn rewritten(found: &[HalfExpression], runs: &Runs<'_>) -> Option<ShaderText> {
    let [studied] = runs.programs[..] else { return None };
    let known = operations(studied.text);
    let chosen = found.iter().filter(|expression| expression.together);
    let chosen = chosen.flat_map(|expression| spans(expression.place, runs)).collect::<BTreeSet<_>>();
    let text =
        WgslOperation::in_half(studied.text.named_source().text(), chosen.iter().filter_map(|span| known.get(span)));
    Some(ShaderText::new("half.wgsl", text))
}
