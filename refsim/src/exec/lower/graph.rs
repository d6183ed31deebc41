//! A program as a graph of component values, before execution order and storage are decided.
//!
//! Equal computations are one node, and what nothing needs is never scheduled: masked components, repeated `dp3`
//! results and moves cost nothing at run time.

use crate::num::NumberOperation as Op;
use std::collections::BTreeMap;

/// Index of a slot: where an executor keeps a value for all its lanes.
pub(in crate::exec) type Slot = u16;

/// The value of a mask where it holds.
pub(in crate::exec) const TRUE: u32 = u32::MAX;

/// A value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct NodeId(pub(crate) u32);

/// In which number format a value is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Arith {
    /// The register format.
    Main,
    /// The format of `_pp` instructions.
    Partial,
    /// Single precision: coordinates and addresses.
    Single,
    /// The register format, wrapping: coordinates delivered by `texcrd` with their fraction kept.
    Wrapped,
    /// H in OpenGL's fragment programs.
    Half,
    /// X in OpenGL's fragment programs.
    Fixed,
}

impl Arith {
    /// Its number in shaders' tables of formats, where those of targets and textures stand in between.
    pub(crate) const fn number(self) -> u32 {
        match self {
            Self::Main => 0,
            Self::Partial => 1,
            Self::Single => 2,
            Self::Wrapped => 3,
            Self::Half => 9,
            Self::Fixed => 10,
        }
    }
}

/// How a texture read finds its level of detail.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Detail {
    /// From differences across the quad.
    Implicit,
    /// Likewise, plus a bias.
    Biased(NodeId),
    /// From derivatives given by the program.
    Gradients([NodeId; 4], [NodeId; 4]),
}

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum NodeKind {
    /// The same host bits in every lane.
    Constant(u32),
    /// What a fixed slot holds when the block starts: a register of a program with flow control.
    Held(Slot),
    /// An interpolated component, or a component of a vertex attribute; single precision.
    Input(u16),
    /// An operation; what it does not take is no operand. Immediates are constants.
    Compute(Arith, Op, [NodeId; 3]),
    /// A difference across the quad: right less left, or (if true) lower less upper.
    Difference(Arith, bool, NodeId),
    /// A dot product of so many terms, rounded once.
    Dot(Arith, u8, [NodeId; 4], [NodeId; 4]),
    /// A value of one format rounded into another.
    Convert(Arith, Arith, NodeId),
    /// A single precision value clamped to [0, 1], rounded to so many steps, and then into the register format.
    Steps(u32, NodeId),
    /// A texture read: sampler, single precision coordinates, detail.
    Fetch(u8, [NodeId; 4], Detail),
    /// The cosine, or the sine, of an angle: format, whether it is the sine, angle.
    Circle(Arith, bool, NodeId),
    /// A component of a texture read's result.
    Texel(NodeId, u8),
    /// A float constant with a relative number: `c[index + a]`, component, `a` an integer.
    Relative(i32, u8, NodeId),
}

impl NodeKind {
    /// Calls `visit` with every node that this one needs.
    pub(crate) fn needs(&self, mut visit: impl FnMut(NodeId)) {
        match *self {
            NodeKind::Constant(_) | NodeKind::Held(_) | NodeKind::Input(_) => {}
            NodeKind::Compute(_, operation, args) => args.into_iter().take(operation.operands()).for_each(visit),
            NodeKind::Dot(_, terms, a, b) => {
                a.into_iter().take(terms.into()).for_each(&mut visit);
                b.into_iter().take(terms.into()).for_each(visit);
            }
            NodeKind::Circle(_, _, a)
            | NodeKind::Convert(_, _, a)
            | NodeKind::Difference(_, _, a)
            | NodeKind::Steps(_, a)
            | NodeKind::Texel(a, _)
            | NodeKind::Relative(_, _, a) => visit(a),
            NodeKind::Fetch(_, coordinates, detail) => {
                coordinates.into_iter().for_each(&mut visit);
                match detail {
                    Detail::Implicit => {}
                    Detail::Biased(bias) => visit(bias),
                    Detail::Gradients(x, y) => x.into_iter().chain(y).for_each(visit),
                }
            }
        }
    }
}

/// The nodes, each after those it needs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Graph {
    kinds: Vec<NodeKind>,
    known: BTreeMap<NodeKind, NodeId>,
}

impl Graph {
    /// The node of this kind; the one there is, if there is one.
    pub(crate) fn node(&mut self, kind: NodeKind) -> NodeId {
        *self.known.entry(kind).or_insert_with(|| {
            self.kinds.push(kind);
            NodeId((self.kinds.len() - 1) as u32)
        })
    }

    pub(crate) fn constant(&mut self, raw: u32) -> NodeId {
        self.node(NodeKind::Constant(raw))
    }

    /// Whether mask `a` is `b`, or one of several that are or'ed together of which `b` is one.
    pub(crate) fn includes(&self, mut a: NodeId, b: NodeId) -> bool {
        while a != b {
            match self.kind(a) {
                NodeKind::Compute(_, Op::Or, [_, right, _]) if right == b => return true,
                NodeKind::Compute(_, Op::Or, [left, ..]) => a = left,
                _ => return false,
            }
        }
        true
    }

    pub(crate) fn kind(&self, node: NodeId) -> NodeKind {
        self.kinds[node.0 as usize]
    }

    pub(crate) fn kinds(&self) -> &[NodeKind] {
        &self.kinds
    }

    pub(crate) fn len(&self) -> usize {
        self.kinds.len()
    }

    /// For each node whether a root needs it.
    pub(crate) fn live(&self, roots: impl IntoIterator<Item = NodeId>) -> Vec<bool> {
        let mut live = vec![false; self.kinds.len()];
        for root in roots {
            live[root.0 as usize] = true;
        }
        for i in (0..self.kinds.len()).rev() {
            if live[i] {
                self.kinds[i].needs(|n| live[n.0 as usize] = true);
            }
        }
        live
    }

    /// For each node whether it is the same in every lane, given which inputs are, and which kinds of node look at
    /// other lanes.
    pub(crate) fn uniform(&self, input: impl Fn(u16) -> bool, across: impl Fn(&NodeKind) -> bool) -> Vec<bool> {
        let mut uniform = Vec::with_capacity(self.kinds.len());
        for kind in &self.kinds {
            let same = match *kind {
                NodeKind::Constant(_) => true,
                NodeKind::Input(component) => input(component),
                // Where what is uniform is computed, neighbours are other triangles. (A difference of equal lanes is a
                // zero, whose sign depends on the format.)
                NodeKind::Difference(..) => false,
                NodeKind::Held(_) | NodeKind::Relative(..) => false,
                _ if across(kind) => false,
                _ => {
                    let mut all = true;
                    kind.needs(|n| all &= uniform[n.0 as usize]);
                    all
                }
            };
            uniform.push(same);
        }
        uniform
    }
}
