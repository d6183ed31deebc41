//! Fusion of nodes into operations: sums of products, and operations with uniform operands. This avoids storing and
//! loading intermediate rows, and copying a scalar into 256 lanes.

use std::collections::BTreeMap;

use refsim_lanes::{LaneCode, OPERANDS};

use crate::exec::lower::{Arith, Graph, NodeId, NodeKind};
use crate::num::NumberOperation as Op;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fused {
    pub(crate) arith: Arith,
    pub(crate) code: LaneCode,
    /// The operands; their number is the code's arity.
    pub(crate) args: [NodeId; OPERANDS],
    /// `true` if a product with a zero factor is always zero.
    pub(crate) zero_wins: bool,
}

impl Fused {
    fn new(arith: Arith, code: LaneCode, operands: &[NodeId]) -> Self {
        let mut args = [operands[0]; OPERANDS];
        args[..operands.len()].copy_from_slice(operands);
        Self { arith, code, args, zero_wins: false }
    }

    pub(crate) fn operands(&self) -> &[NodeId] {
        &self.args[..self.code.arity()]
    }
}

/// The operations of a block after fusion.
///
/// A product, a sum of products or a negated product with a single reader is fused into that reader. Roundings and
/// their order stay the same; only the operands of additions are swapped, which has no effect in any arithmetic here.
/// `Factor` operands become a property of the product.
pub(crate) struct Fusion<'g> {
    graph: &'g Graph,
    /// Number of operations and roots that read a node.
    readers: Vec<u32>,
    fused: BTreeMap<NodeId, Fused>,
}

impl<'g> Fusion<'g> {
    /// Fuses the nodes that `roots` depend on. `given` nodes are not computed here; `shared` nodes and constants are
    /// uniform.
    pub(crate) fn new(
        graph: &'g Graph,
        roots: &[NodeId],
        given: impl Fn(NodeId) -> bool,
        shared: impl Fn(NodeId) -> bool,
    ) -> Self {
        let mut readers = vec![0u32; graph.len()];
        for root in roots {
            // Counted as two readers, so that roots are never fused.
            readers[root.0 as usize] += 2;
        }
        for i in (0..graph.len() as u32).rev() {
            if readers[i as usize] > 0 && !given(NodeId(i)) {
                graph.kind(NodeId(i)).needs(|n| readers[n.0 as usize] += 1);
            }
        }
        let mut fusion = Self { graph, readers, fused: BTreeMap::new() };
        for i in 0..graph.len() as u32 {
            if fusion.readers[i as usize] > 0 && !given(NodeId(i)) {
                fusion.decide(NodeId(i), &given);
            }
        }
        let shared = |n: NodeId| shared(n) || matches!(graph.kind(n), NodeKind::Constant(_));
        for fused in fusion.fused.values_mut().filter(|fused| !graph.is_card(fused.arith)) {
            *fused = with_shared(fused, shared);
        }
        fusion
    }

    /// The fused operation that computes a node, if it is a lane operation.
    pub(crate) fn operation(&self, node: NodeId) -> Option<&Fused> {
        self.fused.get(&node)
    }

    /// Calls `visit` with every node that this one reads after fusion.
    pub(crate) fn needs(&self, node: NodeId, visit: impl FnMut(NodeId)) {
        match self.fused.get(&node) {
            Some(fused) => fused.operands().iter().copied().for_each(visit),
            None => self.graph.kind(node).needs(visit),
        }
    }

    fn decide(&mut self, node: NodeId, given: &impl Fn(NodeId) -> bool) {
        let plain = match self.graph.kind(node) {
            NodeKind::Compute(arith, operation, mut args) => {
                let code = self.code(operation, &args);
                let product = matches!(operation, Op::Mul | Op::Mad | Op::FusedMad);
                let factors = self.factors(arith, args[0], args[1], given).filter(|_| product);
                (args[0], args[1]) = factors.unwrap_or((args[0], args[1]));
                Fused { zero_wins: factors.is_some(), ..Fused::new(arith, code, &args[..code.arity()]) }
            }
            NodeKind::Difference(arith, down, a) => Fused::new(arith, LaneCode::Neighbors(down), &[a]),
            NodeKind::Dot(arith, terms, a, b) => {
                let pairs = (0..usize::from(terms)).map(|k| (a[k], b[k]));
                let factors: Option<Vec<_>> = pairs.clone().map(|(a, b)| self.factors(arith, a, b, given)).collect();
                let zero_wins = factors.is_some();
                let operands: Vec<NodeId> =
                    factors.unwrap_or_else(|| pairs.collect()).into_iter().flat_map(|(a, b)| [a, b]).collect();
                Fused { zero_wins, ..Fused::new(arith, LaneCode::Dot(terms), &operands) }
            }
            _ => return,
        };
        // Units of cards have their own multiply-add, and sum products by their own rules.
        let whole = self.graph.is_card(plain.arith);
        let fused = if whole { plain } else { self.longer(&plain, given).unwrap_or(plain) };
        self.fused.insert(node, fused);
    }

    /// The operands of a product whose factors are a pair of `Factor` nodes.
    fn factors(&self, k: Arith, a: NodeId, b: NodeId, given: &impl Fn(NodeId) -> bool) -> Option<(NodeId, NodeId)> {
        let factor = |n: NodeId| match self.graph.kind(n) {
            NodeKind::Compute(arith, Op::Factor, [x, y, _]) if arith == k && !given(n) => Some((x, y)),
            _ => None,
        };
        let ((x, y), (other, first)) = (factor(a)?, factor(b)?);
        ((x, y) == (first, other)).then_some((x, y))
    }

    /// The code of an operation, with its immediate if it has one.
    fn code(&self, operation: Op, args: &[NodeId; 3]) -> LaneCode {
        match self.graph.kind(args[operation.operands() - 1]) {
            NodeKind::Constant(word) if operation.has_immediate() => LaneCode::Immediate(operation, word as i8),
            _ => LaneCode::Plain(operation),
        }
    }

    /// Fuses the operation with the operation of one of its operands, if possible.
    fn longer(&self, plain: &Fused, given: &impl Fn(NodeId) -> bool) -> Option<Fused> {
        let (k, args) = (plain.arith, plain.args);
        // Products that are fused must have the same rule for zeros.
        let alike = |part: &&Fused| part.zero_wins == plain.zero_wins;
        let longer = match plain.code {
            LaneCode::Plain(Op::Mad) => {
                if let Some(products) = self.products(k, args[2], given).filter(alike) {
                    return sum(products, &[args[0], args[1]]);
                }
                // a b - c d
                let negated = self.part(k, args[2], given).filter(|part| part.code == LaneCode::Plain(Op::Neg))?;
                let product = self.part(k, negated.args[0], given).filter(|part| part.code == LaneCode::Plain(Op::Mul));
                let product = product.filter(alike)?;
                Some(Fused::new(k, LaneCode::Difference, &[args[0], args[1], product.args[0], product.args[1]]))
            }
            LaneCode::Plain(Op::Add) => {
                let (first, second) = (self.products(k, args[0], given)?, self.products(k, args[1], given)?);
                if first.zero_wins != second.zero_wins {
                    return None;
                }
                let (more, one) = if second.code.arity() == 2 { (first, second) } else { (second, first) };
                return sum(more, one.operands());
            }
            LaneCode::Plain(Op::Or) => {
                let less = |n: NodeId| {
                    let part = self.alone(n, given).filter(|part| part.code == LaneCode::Plain(Op::Less));
                    part.filter(|part| !self.graph.is_card(part.arith))
                };
                let (mask, part) = match less(args[1]) {
                    Some(part) => (args[0], part),
                    None => (args[1], less(args[0])?),
                };
                Some(Fused::new(part.arith, LaneCode::OrLess, &[mask, part.args[0], part.args[1]]))
            }
            _ => None,
        };
        longer.map(|fused| Fused { zero_wins: plain.zero_wins, ..fused })
    }

    /// The operation that computes an operand, if the operand has no other reader.
    fn alone(&self, node: NodeId, given: &impl Fn(NodeId) -> bool) -> Option<&Fused> {
        let alone = self.readers[node.0 as usize] == 1 && !given(node);
        self.fused.get(&node).filter(|_| alone)
    }

    /// The operation that computes an operand in the format `arith`, if the operand has no other reader.
    fn part(&self, arith: Arith, node: NodeId, given: &impl Fn(NodeId) -> bool) -> Option<&Fused> {
        self.alone(node, given).filter(|part| part.arith == arith)
    }

    /// The product or sum of products that computes an operand, if the operand has no other reader.
    fn products(&self, arith: Arith, node: NodeId, given: &impl Fn(NodeId) -> bool) -> Option<&Fused> {
        let is_products = |part: &&Fused| matches!(part.code, LaneCode::Plain(Op::Mul) | LaneCode::Sum(_));
        self.part(arith, node, given).filter(is_products)
    }
}

/// Appends a product to a sum; `None` if the sum would have too many products.
fn sum(products: &Fused, last: &[NodeId]) -> Option<Fused> {
    let all = [products.operands(), last].concat();
    let code = LaneCode::Sum((all.len() / 2) as u8);
    let fits = last.len() == 2 && all.len() <= OPERANDS;
    fits.then(|| Fused { zero_wins: products.zero_wins, ..Fused::new(products.arith, code, &all) })
}

/// Replaces shared operands by uniform operands, if such an operation exists.
fn with_shared(fused: &Fused, shared: impl Fn(NodeId) -> bool) -> Fused {
    let (k, args) = (fused.arith, fused.args);
    let of = |code, operands: &[NodeId]| Fused { zero_wins: fused.zero_wins, ..Fused::new(k, code, operands) };
    match fused.code {
        LaneCode::Plain(Op::Mul) | LaneCode::Sum(_) => {
            let mut sorted = *fused;
            for pair in sorted.args.chunks_exact_mut(2) {
                if !shared(pair[0]) {
                    pair.swap(0, 1);
                }
            }
            let terms = fused.code.arity() / 2;
            let all = (0..terms).all(|i| shared(sorted.args[2 * i]));
            if all { Fused { code: LaneCode::SumBy(terms as u8), ..sorted } } else { *fused }
        }
        LaneCode::Plain(Op::Add) if shared(args[0]) => of(LaneCode::AddTo, &args[..2]),
        LaneCode::Plain(Op::Add) if shared(args[1]) => of(LaneCode::AddTo, &[args[1], args[0]]),
        LaneCode::Plain(Op::Sub) if shared(args[0]) => of(LaneCode::SubFrom, &args[..2]),
        LaneCode::Plain(Op::Sub) if shared(args[1]) => of(LaneCode::SubOff, &[args[1], args[0]]),
        LaneCode::Plain(Op::Mad) if shared(args[0]) => of(LaneCode::MadBy, &args[..3]),
        LaneCode::Plain(Op::Mad) if shared(args[1]) => of(LaneCode::MadBy, &[args[1], args[0], args[2]]),
        _ => *fused,
    }
}
