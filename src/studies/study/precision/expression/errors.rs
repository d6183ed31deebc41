//! Errors of an expression in a format.

use super::arithmetic::Arithmetic;
use super::graph::Expression;
use super::sample::{Sample, Samples, parallel};

/// Errors of computed values, over sampled inputs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Errors {
    /// Mean of the bits of error, standard error of the mean, and the largest.
    pub(super) mean_bits: f64,
    pub(super) standard_error: f64,
    pub(super) worst_bits: f64,
    /// Index of the input with the most bits of error.
    pub(super) worst: usize,
    /// Mean and largest relative error; infinite if a result is infinite or NaN.
    pub(super) mean_relative: f64,
    pub(super) largest_relative: f64,
}

impl Errors {
    /// Measures of goals.
    pub(super) const MEASURES: [&str; 4] = ["mean_relative", "largest_relative", "mean_bits", "worst_bits"];

    /// Value of a measure of goals.
    pub(super) fn measure(&self, name: &str) -> f64 {
        match name {
            "mean_bits" => self.mean_bits,
            "worst_bits" => self.worst_bits,
            "largest_relative" => self.largest_relative,
            _ => self.mean_relative,
        }
    }
}

/// Errors in a format, over inputs sampled in the same format.
pub(super) fn errors(expression: &Expression, arithmetic: Arithmetic, samples: &Samples) -> Errors {
    let constants = arithmetic.constants(&expression.body);
    summary(&parallel(&samples.kept, |sample| {
        let computed = arithmetic.values(&expression.body, &sample.inputs, &constants).pop().unwrap_or_default();
        (arithmetic.error_bits(computed, sample.exact), relative(arithmetic.value(computed), sample.value))
    }))
}

/// Errors in a format, over inputs sampled in another format and rounded to it.
pub(super) fn errors_of_rounded(
    expression: &Expression,
    arithmetic: Arithmetic,
    samples: &Samples,
    from: Arithmetic,
) -> Errors {
    let constants = arithmetic.constants(&expression.body);
    summary(&parallel(&samples.kept, |Sample { inputs, value, .. }| {
        let inputs: Vec<u64> = inputs.iter().map(|&bits| arithmetic.rounded(from.value(bits))).collect();
        let computed = arithmetic.values(&expression.body, &inputs, &constants).pop().unwrap_or_default();
        (arithmetic.error_bits(computed, arithmetic.rounded(*value)), relative(arithmetic.value(computed), *value))
    }))
}

/// Relative error; 1 if only the exact value is 0.
fn relative(computed: f64, exact: f64) -> f64 {
    match computed - exact {
        0.0 => 0.0,
        _ if exact == 0.0 => 1.0,
        error if error.is_finite() => (error / exact).abs(),
        _ => f64::INFINITY,
    }
}

fn summary(errors: &[(f64, f64)]) -> Errors {
    let count = errors.len().max(1) as f64;
    let mean_bits = errors.iter().map(|error| error.0).sum::<f64>() / count;
    let spread = errors.iter().map(|error| (error.0 - mean_bits) * (error.0 - mean_bits)).sum::<f64>();
    let worst = (0..errors.len()).max_by(|a, b| errors[*a].0.total_cmp(&errors[*b].0)).unwrap_or_default();
    Errors {
        mean_bits,
        standard_error: (spread / (count - 1.0).max(1.0) / count).sqrt(),
        worst_bits: errors.get(worst).map_or(0.0, |error| error.0),
        worst,
        mean_relative: errors.iter().map(|error| error.1).sum::<f64>() / count,
        largest_relative: errors.iter().map(|error| error.1).fold(0.0, f64::max),
    }
}
