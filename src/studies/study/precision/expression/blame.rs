//! Blame: the operations of an expression that lose the bits.

use super::arithmetic::{Arithmetic, PRECISIONS};
use super::graph::{Expression, Graph, Node, Operation};
use super::real::Real;
use super::sample::{Sample, Samples, parallel};

/// Maximum number of inputs at which operations are blamed.
const MAX_INPUTS: usize = 256;

/// Mean bits of error that come from one operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OperationError {
    /// Index of the node.
    pub(super) node: usize,
    /// Error of the operation on correctly rounded operands, against its exact result: Herbie's local error.
    pub(super) local: f64,
    /// Error of the expression's result if only this operation rounds its result.
    pub(super) alone: f64,
}

/// Blames each operation, and each constant that is rounded, for errors in a format. Leaves out nodes that are always
/// exact.
pub(super) fn blame(expression: &Expression, arithmetic: Arithmetic, samples: &Samples) -> Vec<OperationError> {
    let graph = &expression.body;
    let nodes: Vec<usize> = (0..graph.0.len()).filter(|&node| may_err(&graph.0[node])).collect();
    let inputs = &samples.kept[..samples.kept.len().min(MAX_INPUTS)];
    let rows = parallel(inputs, |sample| at_input(graph, arithmetic, &nodes, sample));
    let mean = |of: &dyn Fn(&Vec<[f64; 2]>) -> f64| rows.iter().map(of).sum::<f64>() / rows.len().max(1) as f64;
    let all = nodes.iter().enumerate().map(|(at, &node)| OperationError {
        node,
        local: mean(&|row| row[at][0]),
        alone: mean(&|row| row[at][1]),
    });
    all.filter(|error| error.local > 0.0 || error.alone > 0.0).collect()
}

fn may_err(node: &Node) -> bool {
    matches!(node.operation, Operation::Apply(..) | Operation::Number(..) | Operation::Constant(_))
}

/// Local error of each node, and the error of the result if only this node is rounded.
fn at_input(graph: &Graph, arithmetic: Arithmetic, nodes: &[usize], sample: &Sample) -> Vec<[f64; 2]> {
    let reals: Vec<Real> = sample.inputs.iter().map(|&bits| arithmetic.real(bits)).collect();
    let exact = exact_values(graph, arithmetic, &reals);
    let of_node = |&node: &usize| {
        let Some(rounded) = exact[node] else { return [0.0, 0.0] };
        let operation = &graph.0[node].operation;
        let operands: Option<Vec<u64>> = operation.operands().iter().map(|&operand| exact[operand]).collect();
        let local = match operands {
            Some(operands) if !operands.is_empty() => {
                arithmetic.error_bits(arithmetic.operation(operation, &operands), rounded)
            }
            _ => 0.0,
        };
        let replaced = arithmetic.real(rounded);
        let result =
            PRECISIONS.iter().find_map(|&bits| match graph.reals(&reals, bits, Some((node, &replaced))).pop() {
                Some(Real::Range(range)) => arithmetic.decided(&range),
                Some(Real::Undefined) => Some(arithmetic.nan()),
                _ => None,
            });
        [local, result.map_or(0.0, |result| arithmetic.error_bits(result, sample.exact))]
    };
    nodes.iter().map(of_node).collect()
}

/// Correctly rounded values of all nodes; `None` for a node without a real value, or whose rounding is not decided.
fn exact_values(graph: &Graph, arithmetic: Arithmetic, reals: &[Real]) -> Vec<Option<u64>> {
    let mut exact: Vec<Option<u64>> = vec![None; graph.0.len()];
    for bits in PRECISIONS {
        let mut is_open = false;
        for (known, real) in exact.iter_mut().zip(graph.reals(reals, bits, None)) {
            *known = known.or_else(|| match &real {
                Real::Range(range) => arithmetic.decided(range),
                Real::Truth(truth) => Some(u64::from(*truth)),
                _ => None,
            });
            is_open |= known.is_none() && real != Real::Undefined;
        }
        if !is_open {
            break;
        }
    }
    exact
}
