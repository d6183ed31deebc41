//! Expressions as lists of operations in postorder: each operation follows its operands.

use std::cmp::Ordering;
use std::ops::Range;
use std::sync::Arc;

use num_bigint::BigInt;

use super::real::{Constant, Function, Real, RealInterval, apply};
use crate::report::SourceText;

/// Truth values of a comparison if the first number is less than, equal to, and greater than the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct NumberComparison([bool; 3]);

const COMPARISONS: [(&str, NumberComparison); 6] = [
    ("<", NumberComparison([true, false, false])),
    ("<=", NumberComparison([true, true, false])),
    (">", NumberComparison([false, false, true])),
    (">=", NumberComparison([false, true, true])),
    ("==", NumberComparison([false, true, false])),
    ("!=", NumberComparison([true, false, true])),
];

impl NumberComparison {
    pub(super) fn named(name: &str) -> Option<Self> {
        COMPARISONS.iter().find(|(known, _)| *known == name).map(|(_, comparison)| *comparison)
    }

    /// Returns `true` if the comparison holds for two numbers in this order; `None`, the order with NaN, only satisfies
    /// `!=`.
    pub(super) fn holds(self, order: Option<Ordering>) -> bool {
        order.map_or(self.is_inequality(), |order| self.0[(order as i8 + 1) as usize])
    }

    /// Returns `true` for `!=`.
    pub(super) fn is_inequality(self) -> bool {
        self.0 == [true, false, true]
    }
}

/// Operation of a node; operands are indices of earlier nodes.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Operation {
    Variable(usize),
    /// Numerator and denominator.
    Number(BigInt, BigInt),
    Constant(Constant),
    Apply(Function, Vec<usize>),
    Truth(bool),
    Compare(NumberComparison, [usize; 2]),
    /// Conjunction of the operands if `all`, otherwise disjunction.
    Connect {
        all: bool,
        operands: Vec<usize>,
    },
    Not(usize),
    If([usize; 3]),
}

/// A node with its span in the text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) operation: Operation,
    /// `true` if its value is a truth value.
    pub(super) is_truth: bool,
    pub(super) place: Range<usize>,
}

/// Nodes in an order of computation; the last is the result.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Graph(pub(super) Vec<Node>);

/// An expression to study.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Expression {
    pub(super) source: Arc<SourceText>,
    pub(super) name: String,
    pub(super) variables: Vec<String>,
    pub(super) body: Graph,
    /// The intended result over the reals, if it is not the body.
    pub(super) spec: Option<Graph>,
    /// Conditions that inputs must meet, all of them.
    pub(super) preconditions: Vec<Graph>,
}

impl Expression {
    /// The intended result over the reals.
    pub(super) fn exact(&self) -> &Graph {
        self.spec.as_ref().unwrap_or(&self.body)
    }

    /// Text of a node in one line, and its line and column from 1.
    pub(super) fn text(&self, node: &Node) -> (String, usize, usize) {
        let text = self.source.text().get(node.place.clone()).unwrap_or_default();
        let (line, column) = (self.source.line_of(node.place.start), self.source.column_of(node.place.start));
        (text.split_whitespace().collect::<Vec<_>>().join(" "), line + 1, column + 1)
    }
}

impl Graph {
    /// Computes all nodes over the reals, to about `bits` bits. `rounded` replaces the value of a node.
    pub(super) fn reals(&self, inputs: &[Real], bits: u64, rounded: Option<(usize, &Real)>) -> Vec<Real> {
        let mut values: Vec<Real> = Vec::with_capacity(self.0.len());
        for (index, node) in self.0.iter().enumerate() {
            let value = match rounded {
                Some((replaced, value)) if replaced == index => value.clone(),
                _ => real(&node.operation, inputs, &values, bits),
            };
            values.push(value);
        }
        values
    }
}

fn real(operation: &Operation, inputs: &[Real], values: &[Real], bits: u64) -> Real {
    let of = |operands: &[usize]| operands.iter().map(|&operand| values[operand].clone()).collect::<Vec<_>>();
    match operation {
        Operation::Variable(variable) => inputs[*variable].clone(),
        Operation::Number(n, d) => Real::Range(RealInterval::ratio(n, d, bits)),
        Operation::Constant(constant) => Real::Range(constant.value(bits)),
        Operation::Apply(function, operands) => apply(*function, &of(operands), bits),
        Operation::Truth(truth) => Real::Truth(*truth),
        Operation::Compare(comparison, [x, y]) => match (&values[*x], &values[*y]) {
            (Real::Undefined, _) | (_, Real::Undefined) => Real::Undefined,
            (Real::Range(x), Real::Range(y)) => compare(*comparison, x, y).map_or(Real::Unknown, Real::Truth),
            _ => Real::Unknown,
        },
        Operation::Connect { all, operands } => connect(*all, &of(operands)),
        Operation::Not(operand) => match &values[*operand] {
            Real::Truth(truth) => Real::Truth(!truth),
            other => other.clone(),
        },
        Operation::If([condition, yes, no]) => match &values[*condition] {
            Real::Truth(truth) => values[if *truth { *yes } else { *no }].clone(),
            other => other.clone(),
        },
    }
}

/// Compares intervals; `None` unless the comparison has the same result for all of their numbers.
fn compare(comparison: NumberComparison, x: &RealInterval, y: &RealInterval) -> Option<bool> {
    let orders = match x.order(y) {
        Some(order) => [order; 2],
        None if x.high <= y.low => [Ordering::Less, Ordering::Equal],
        None if x.low >= y.high => [Ordering::Greater, Ordering::Equal],
        None => return None,
    };
    let [one, other] = orders.map(|order| comparison.holds(Some(order)));
    (one == other).then_some(one)
}

fn connect(all: bool, operands: &[Real]) -> Real {
    let deciding = Real::Truth(!all);
    match operands.iter().find(|operand| !matches!(operand, Real::Truth(_))) {
        _ if operands.contains(&deciding) => deciding,
        Some(unclear) => unclear.clone(),
        None => Real::Truth(all),
    }
}
