//! Sampled inputs, and the exact results there.

use std::cmp::Ordering;

use super::arithmetic::{Arithmetic, PRECISIONS};
use super::graph::{Comparison, Expression, Graph, Operation};
use super::real::{Interval, Real};
use crate::geom::random::CounterRng;

/// Draws per input wanted, and those that meet the precondition, before the search for inputs ends.
const DRAWS: usize = 1000;
const MET: usize = 20;

/// Distribution of inputs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InputDraw {
    /// Every number of the format is as likely as every other, as in Herbie.
    #[default]
    Floats,
    /// Every real number is as likely as every other, then rounded.
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

/// Sampled inputs, and what was drawn and discarded.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Samples {
    pub(super) kept: Vec<Sample>,
    /// Draws that met the precondition.
    pub(super) drawn: usize,
    /// Inputs without a real result, with one beyond the largest number, and with one that no precision decided.
    pub(super) undefined: usize,
    pub(super) too_large: usize,
    pub(super) undecided: usize,
}

/// What the reals say of an input.
enum Exact {
    Finite(Sample),
    Undefined,
    TooLarge,
    Undecided,
}

/// Draws `count` inputs that meet the precondition and have a finite result, or fewer if they are rare.
pub(super) fn sample(
    expression: &Expression,
    arithmetic: Arithmetic,
    count: usize,
    draw: InputDraw,
    seed: u64,
) -> Samples {
    let spans = spans(expression, arithmetic);
    let mut samples = Samples::default();
    let rng = CounterRng::new(seed);
    let count = if expression.variables.is_empty() { 1 } else { count };
    let mut at = 0;
    while samples.kept.len() < count && at < DRAWS * count && samples.drawn < MET * count {
        // Whole rows at once, each input by its number, so that threads change nothing.
        let row: Vec<usize> = (at..at + count).collect();
        at += count;
        let exact: Vec<Option<Exact>> = parallel(&row, |&index| {
            let inputs: Vec<u64> = spans
                .iter()
                .enumerate()
                .map(|(variable, span)| arithmetic.drawn(*span, draw, rng.bits(index as u64, 0, variable as u64)))
                .collect();
            let reals: Vec<Real> = inputs.iter().map(|&bits| arithmetic.real(bits)).collect();
            expression
                .preconditions
                .iter()
                .all(|graph| meets(graph, &reals))
                .then(|| exact_result(expression, arithmetic, inputs, &reals))
        });
        for exact in exact.into_iter().flatten() {
            if samples.kept.len() == count {
                break;
            }
            samples.drawn += 1;
            match exact {
                Exact::Finite(sample) => samples.kept.push(sample),
                Exact::Undefined => samples.undefined += 1,
                Exact::TooLarge => samples.too_large += 1,
                Exact::Undecided => samples.undecided += 1,
            }
        }
    }
    samples
}

/// Results in order, computed by several threads.
pub(super) fn parallel<T: Sync, U: Send>(items: &[T], of: impl Fn(&T) -> U + Sync + Send) -> Vec<U> {
    use rayon::prelude::*;
    items.par_iter().map(of).collect()
}

/// Whether an input meets a precondition over the reals.
fn meets(precondition: &Graph, reals: &[Real]) -> bool {
    let value = PRECISIONS.iter().map(|&bits| precondition.reals(reals, bits, None).pop());
    value.into_iter().find(|value| *value != Some(Real::Unknown)).flatten() == Some(Real::Truth(true))
}

/// The correctly rounded result of an input, if it is finite.
pub(super) fn exact(expression: &Expression, arithmetic: Arithmetic, inputs: &[u64]) -> Option<u64> {
    let reals: Vec<Real> = inputs.iter().map(|&bits| arithmetic.real(bits)).collect();
    match exact_result(expression, arithmetic, inputs.to_vec(), &reals) {
        Exact::Finite(sample) => Some(sample.exact),
        _ => None,
    }
}

fn exact_result(expression: &Expression, arithmetic: Arithmetic, inputs: Vec<u64>, reals: &[Real]) -> Exact {
    for bits in PRECISIONS {
        match expression.exact().reals(reals, bits, None).pop() {
            Some(Real::Range(range)) => {
                if let (Some(exact), Some(double)) = (arithmetic.decided(&range), Arithmetic::Double.decided(&range)) {
                    let [least, largest] = arithmetic.finite_ordinals();
                    let is_finite =
                        (least..=largest).contains(&arithmetic.ordinal(exact)) && is_within(arithmetic, &range);
                    return match is_finite {
                        true => Exact::Finite(Sample { inputs, exact, value: f64::from_bits(double) }),
                        false => Exact::TooLarge,
                    };
                }
            }
            Some(Real::Undefined) => return Exact::Undefined,
            _ => {}
        }
    }
    Exact::Undecided
}

/// Fixed point has no infinity: its largest number stands for all beyond, which are more than half a unit away.
fn is_within(arithmetic: Arithmetic, range: &Interval) -> bool {
    let Arithmetic::Number(format) = arithmetic else { return true };
    if !format.is_fixed() {
        return true;
    }
    let [least, largest] = [format.min_finite(), format.max_finite()].map(|bits| arithmetic.real(bits.into()));
    let (Real::Range(least), Real::Range(largest)) = (least, largest) else { return true };
    range.order(&least) != Some(Ordering::Less) && range.order(&largest) != Some(Ordering::Greater)
}

impl Arithmetic {
    /// A number between two positions.
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

/// For each variable the positions of the numbers within the bounds that preconditions state by constants; what else
/// they demand is tried input by input.
fn spans(expression: &Expression, arithmetic: Arithmetic) -> Vec<[i64; 2]> {
    let mut spans = vec![arithmetic.finite_ordinals(); expression.variables.len()];
    expression.preconditions.iter().for_each(|graph| narrow(&mut spans, graph, arithmetic));
    for [low, high] in &mut spans {
        *high = (*high).max(*low);
    }
    spans
}

fn narrow(spans: &mut [[i64; 2]], precondition: &Graph, arithmetic: Arithmetic) {
    let values = precondition.reals(&vec![Real::Unknown; spans.len()], PRECISIONS[0], None);
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
        let (upper, lower) = match comparison {
            Comparison::Less | Comparison::LessEqual => (true, false),
            Comparison::Greater | Comparison::GreaterEqual => (false, true),
            Comparison::Equal => (true, true),
            Comparison::NotEqual => continue,
        };
        for (variable, bound, is_upper, is_lower) in [(left, right, upper, lower), (right, left, lower, upper)] {
            if let (Operation::Variable(index), Real::Range(range)) =
                (&precondition.0[variable].operation, &values[bound])
            {
                // One number beyond, in case the bound was rounded away from it.
                let [low, high] = &mut spans[*index];
                *high = if is_upper { (*high).min(ordinal(&range.high) + 1) } else { *high };
                *low = if is_lower { (*low).max(ordinal(&range.low) - 1) } else { *low };
            }
        }
    }
}
