//! Sampled inputs, and the exact results there.

use std::cmp::Ordering;

use super::arithmetic::{Arithmetic, PRECISIONS};
use super::graph::{Expression, Graph, Operation};
use super::real::Real;
use crate::geom::random::CounterRng;

/// Maximum numbers of drawn and of discarded inputs, per wanted input, before sampling ends.
const DRAWS: usize = 1000;
const DISCARDED: usize = 20;

/// Number of draws without an input that meets the precondition before sampling ends.
const MISSES: usize = 1_000_000;

/// Distribution of inputs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "kebab-case")]
pub enum InputDraw {
    /// Every number of the format is equally likely, as in Herbie.
    #[default]
    Floats,
    /// Every real number of the range is equally likely, then rounded.
    Reals,
}

/// An input, and the exact result in the format of the inputs.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sample {
    pub(super) inputs: Vec<u64>,
    /// The correctly rounded result, finite.
    pub(super) exact: u64,
    /// The result rounded to double precision.
    pub(super) value: f64,
}

/// Sampled inputs.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Samples {
    pub(super) kept: Vec<Sample>,
    /// Number of inputs that meet the precondition but have no finite and decided result.
    pub(super) discarded: usize,
}

/// Samples `count` inputs that meet the precondition and have a finite result, or fewer if they are rare.
pub(super) fn sample(
    expression: &Expression,
    arithmetic: Arithmetic,
    count: usize,
    draw: InputDraw,
    seed: u64,
) -> Samples {
    let (spans, rng) = (spans(expression, arithmetic), CounterRng::new(seed));
    let count = if expression.variables.is_empty() { 1 } else { count };
    let mut samples = Samples::default();
    if spans.iter().any(|[low, high]| low > high) {
        return samples;
    }
    for row in 0..DRAWS {
        // Draws a whole row, each input from its index, so that the number of threads does not change the result.
        let numbers: Vec<usize> = (row * count..(row + 1) * count).collect();
        let drawn = parallel(&numbers, |&number| {
            let bits = |variable: usize| rng.bits(number as u64, 0, variable as u64);
            let inputs = spans.iter().enumerate().map(|(at, span)| arithmetic.drawn(*span, draw, bits(at)));
            let inputs: Vec<u64> = inputs.collect();
            let reals: Vec<Real> = inputs.iter().map(|&bits| arithmetic.real(bits)).collect();
            let is_met = expression.preconditions.iter().all(|graph| meets(graph, &reals));
            is_met.then(|| exact(expression, arithmetic, inputs))
        });
        for sample in drawn.into_iter().flatten() {
            match sample {
                _ if samples.kept.len() == count => return samples,
                Some(sample) => samples.kept.push(sample),
                None => samples.discarded += 1,
            }
        }
        let is_missed = samples.kept.is_empty() && samples.discarded == 0 && (row + 1) * count >= MISSES;
        if samples.kept.len() == count || samples.discarded > DISCARDED * count || is_missed {
            break;
        }
    }
    samples
}

/// Applies `of` to every item on several threads; the results are in the order of the items.
pub(super) fn parallel<T: Sync, U: Send>(items: &[T], of: impl Fn(&T) -> U + Sync + Send) -> Vec<U> {
    use rayon::prelude::*;
    items.par_iter().map(of).collect()
}

/// Returns `true` if an input meets a precondition over the reals.
fn meets(precondition: &Graph, reals: &[Real]) -> bool {
    let value = PRECISIONS.iter().map(|&bits| precondition.reals(reals, bits, None).pop());
    value.into_iter().find(|value| *value != Some(Real::Unknown)).flatten() == Some(Real::Truth(true))
}

/// An input with its result, if that is finite and decided.
pub(super) fn exact(expression: &Expression, arithmetic: Arithmetic, inputs: Vec<u64>) -> Option<Sample> {
    let reals: Vec<Real> = inputs.iter().map(|&bits| arithmetic.real(bits)).collect();
    let decide = |bits| match expression.exact().reals(&reals, bits, None).pop() {
        Some(Real::Range(range)) => Some(Some((arithmetic.decided(&range)?, Arithmetic::Double.decided(&range)?))),
        Some(Real::Undefined) => Some(None),
        _ => None,
    };
    let (exact, double) = PRECISIONS.into_iter().find_map(decide)??;
    let (value, finite) = (f64::from_bits(double), arithmetic.finite_ordinals());
    // Fixed point has no infinity: its largest number represents all larger ones.
    let [least, largest] = finite.map(|ordinal| arithmetic.value(arithmetic.at_ordinal(ordinal)));
    let is_within = !arithmetic.is_fixed() || (least..=largest).contains(&value);
    let is_finite = (finite[0]..=finite[1]).contains(&arithmetic.ordinal(exact));
    (is_within && is_finite).then_some(Sample { inputs, exact, value })
}

impl Arithmetic {
    /// A random number between two indices.
    fn drawn(self, [low, high]: [i64; 2], draw: InputDraw, random: u64) -> u64 {
        if draw == InputDraw::Reals {
            let [low, high] = [low, high].map(|ordinal| self.value(self.at_ordinal(ordinal)));
            let share = (random >> 11) as f64 / (1u64 << 53) as f64;
            return self.rounded(low * (1.0 - share) + high * share);
        }
        let last = low.abs_diff(high);
        let offset = ((u128::from(random) * (u128::from(last) + 1)) >> 64) as u64;
        self.at_ordinal(low.wrapping_add_unsigned(offset))
    }
}

/// For each variable, the positions of the first and last number within its constant bounds in the preconditions; first
/// > last if there is no such number. All other conditions are tested input by input.
pub(super) fn spans(expression: &Expression, arithmetic: Arithmetic) -> Vec<[i64; 2]> {
    let mut spans = vec![arithmetic.finite_ordinals(); expression.variables.len()];
    expression.preconditions.iter().for_each(|graph| narrow(&mut spans, graph, arithmetic));
    spans
}

fn narrow(spans: &mut [[i64; 2]], precondition: &Graph, arithmetic: Arithmetic) {
    // Always the highest precision: bounds are few, and no number just outside a bound may remain.
    let values = precondition.reals(&vec![Real::Unknown; spans.len()], PRECISIONS[PRECISIONS.len() - 1], None);
    let ordinal = |end| arithmetic.ordinal(arithmetic.encode(end));
    let mut demanded = vec![precondition.0.len() - 1];
    while let Some(node) = demanded.pop() {
        let (comparison, [left, right]) = match &precondition.0[node].operation {
            Operation::Compare(comparison, operands) => (*comparison, *operands),
            Operation::Connect { all: true, operands } => {
                demanded.extend(operands);
                continue;
            }
            _ => continue,
        };
        let [lower, upper] = [Ordering::Less, Ordering::Greater].map(|order| !comparison.holds(Some(order)));
        for (variable, bound, is_upper, is_lower) in [(left, right, upper, lower), (right, left, lower, upper)] {
            let (Operation::Variable(index), Real::Range(range)) =
                (&precondition.0[variable].operation, &values[bound])
            else {
                continue;
            };
            let is_strict = !comparison.holds(Some(Ordering::Equal));
            let is_beyond = |position: i64, order| {
                let Real::Range(x) = arithmetic.real(arithmetic.at_ordinal(position)) else { return false };
                let found = x.order(range);
                found == Some(order) || is_strict && found == Some(Ordering::Equal)
            };
            // Starts one number farther out, because the bound may have been rounded inward.
            let [low, high] = &mut spans[*index];
            if is_upper {
                *high = (*high).min(ordinal(&range.high) + 1);
                while low <= high && is_beyond(*high, Ordering::Greater) {
                    *high -= 1;
                }
            }
            if is_lower {
                *low = (*low).max(ordinal(&range.low) - 1);
                while low <= high && is_beyond(*low, Ordering::Less) {
                    *low += 1;
                }
            }
        }
    }
}
