//! Errors of an expression in a format.

use super::super::goal::Goal;
use super::arithmetic::Arithmetic;
use super::graph::Expression;
use super::sample::{Sample, Samples, parallel};
use crate::picture::metrics::relative_error;

/// Measures of goals.
pub(super) const MEASURES: [&str; 2] = ["mean_relative", "largest_relative"];

/// Number of inputs evaluated before the first check whether the goal is missed.
const FIRST: usize = 64;

/// Bits of error of computed values, over sampled inputs; NaN without any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BitErrors {
    pub(super) mean: f64,
    /// Standard error of the mean.
    pub(super) standard_error: f64,
    pub(super) worst: f64,
    /// Index of the input with the most bits of error.
    pub(super) worst_input: usize,
}

/// Bits of error in a format of inputs sampled in the same format.
pub(super) fn bits(expression: &Expression, arithmetic: Arithmetic, samples: &Samples) -> BitErrors {
    let constants = arithmetic.constants(&expression.body);
    let errors = parallel(&samples.kept, |sample| {
        let computed = arithmetic.values(&expression.body, &sample.inputs, &constants).pop().unwrap_or_default();
        arithmetic.error_bits(computed, sample.exact)
    });
    let count = errors.len() as f64;
    let mean = errors.iter().sum::<f64>() / count;
    let spread = errors.iter().map(|error| (error - mean) * (error - mean)).sum::<f64>();
    let worst_input = (0..errors.len()).max_by(|a, b| errors[*a].total_cmp(&errors[*b])).unwrap_or_default();
    let standard_error = (spread / (count - 1.0).max(1.0) / count).sqrt();
    BitErrors { mean, standard_error, worst: errors.get(worst_input).copied().unwrap_or(f64::NAN), worst_input }
}

/// Value of a goal's measure in a format, over inputs sampled in another format and rounded to this format. With
/// `ends_early`, stops as soon as the inputs so far miss the goal, whatever the others are.
pub(super) fn relative_errors(
    expression: &Expression,
    arithmetic: Arithmetic,
    (samples, from): (&Samples, Arithmetic),
    goal: &Goal,
    ends_early: bool,
) -> f64 {
    let constants = arithmetic.constants(&expression.body);
    let at = |Sample { inputs, value, .. }: &Sample| {
        let inputs: Vec<u64> = inputs.iter().map(|&bits| arithmetic.rounded(from.value(bits))).collect();
        let computed = arithmetic.values(&expression.body, &inputs, &constants).pop().unwrap_or_default();
        relative_error(arithmetic.value(computed), *value)
    };
    // Errors are not negative, so later errors never decrease a sum or a maximum.
    let ends_early = ends_early && goal.is_upper_bound();
    let (count, mut errors) = (samples.kept.len(), Vec::new());
    loop {
        let next = errors.len()..count.min(2 * errors.len() + FIRST);
        errors.extend(parallel(&samples.kept[next], at));
        let value = match goal.measure.as_str() {
            "largest_relative" => errors.iter().copied().fold(0.0, f64::max),
            _ => errors.iter().sum::<f64>() / count as f64,
        };
        if errors.len() == count || ends_early && !goal.met(value) {
            return value;
        }
    }
}
