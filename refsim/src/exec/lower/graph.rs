//! A program as a graph of component values, independent of execution order and storage.
//!
//! Equal computations share a node, and unused nodes are never scheduled: masked components, repeated `dp3` results and
//! moves cost nothing at run time.

use std::collections::BTreeMap;

use refsim_lanes::{LaneCode, RowSum, Slot};

use crate::num::{Encoding, Format, NumberOperation as Op};

/// A value of the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct NodeId(pub(crate) u32);

/// Number format of a computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Arith {
    /// The register format.
    Main,
    /// The format of `_pp` instructions.
    Partial,
    /// Single precision: coordinates and addresses.
    Single,
    /// The register format with wrapping overflow, for `texcrd` with preserved fractions.
    Wrapped,
    /// Suffix H in OpenGL's fragment programs.
    Half,
    /// Suffix X in OpenGL's fragment programs.
    Fixed,
    /// A format of single instructions, storages or sums: its index in [`super::Formats::own`].
    Own(u8),
}

impl Arith {
    /// Index in [`super::Formats`].
    pub(crate) const fn index(self) -> usize {
        match self {
            Self::Main => 0,
            Self::Partial => 1,
            Self::Single => 2,
            Self::Wrapped => 3,
            Self::Half => 4,
            Self::Fixed => 5,
            Self::Own(index) => NAMED_FORMATS + index as usize,
        }
    }

    /// Index in the shaders' tables of formats, which also contain the formats of targets and textures.
    pub(crate) const fn number(self) -> u32 {
        match self {
            Self::Main => 0,
            Self::Partial => 1,
            Self::Single => 2,
            Self::Wrapped => 3,
            Self::Half => 9,
            Self::Fixed => 10,
            Self::Own(index) => 11 + index as u32,
        }
    }
}

/// Number of formats that exist in every program.
pub(crate) const NAMED_FORMATS: usize = 6;

/// Source of a read's level of detail.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Detail {
    /// Differences across the quad.
    Implicit,
    /// Differences across the quad, plus a bias.
    Biased(NodeId),
    /// Derivatives given by the program.
    Gradients([NodeId; 4], [NodeId; 4]),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum NodeKind {
    /// The same host bits in every lane.
    Constant(u32),
    /// Contents of a fixed slot at the start of the block: a register of a program with flow control.
    Held(Slot),
    /// An interpolated component, or a component of a vertex attribute; single precision.
    Input(u16),
    /// An operation; surplus operands are ignored. Immediates are constants.
    Compute(Arith, Op, [NodeId; 3]),
    /// A difference across the quad: right minus left, or (if `true`) lower minus upper.
    Difference(Arith, bool, NodeId),
    /// A dot product with the given number of terms, rounded once, or computed by a card's unit.
    Dot(Arith, u8, [NodeId; 4], [NodeId; 4]),
    /// A sum computed by one adder; surplus operands are ignored.
    Sum(Arith, RowSum, [NodeId; 4]),
    /// A conversion between formats, rounded once.
    Convert(Arith, Arith, NodeId),
    /// A single-precision value clamped to [0, 1], rounded to a multiple of 1 / steps, and converted to the register
    /// format.
    Steps(u32, NodeId),
    /// A texture read: sampler, single precision coordinates, detail.
    Fetch(u8, [NodeId; 4], Detail),
    /// The cosine or (if `true`) sine of an angle.
    Circle(Arith, bool, NodeId),
    /// A component of a texture read's result.
    Texel(NodeId, u8),
    /// A relatively addressed float constant `c[index + a]`: index, component, integer `a`.
    Relative(i32, u8, NodeId),
}

impl NodeKind {
    /// Calls `visit` with every operand of this node.
    pub(crate) fn needs(&self, mut visit: impl FnMut(NodeId)) {
        match *self {
            NodeKind::Constant(_) | NodeKind::Held(_) | NodeKind::Input(_) => {}
            NodeKind::Compute(_, operation, args) => args.into_iter().take(operation.operands()).for_each(visit),
            NodeKind::Dot(_, terms, a, b) => {
                a.into_iter().take(terms.into()).for_each(&mut visit);
                b.into_iter().take(terms.into()).for_each(visit);
            }
            NodeKind::Sum(_, sum, addends) => addends.into_iter().take(sum.operands()).for_each(visit),
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

/// The nodes; each follows its operands.
#[derive(Clone, Debug, Default)]
pub(crate) struct Graph {
    /// Formats by [`Arith::index`].
    formats: Vec<Format>,
    /// `true` if inputs are arbitrary words, not results of arithmetic.
    reads_words: bool,
    kinds: Vec<NodeKind>,
    known: BTreeMap<NodeKind, NodeId>,
}

impl Graph {
    /// An empty graph of computations in these formats.
    pub(crate) fn new(formats: &[Format], reads_words: bool) -> Self {
        Self { formats: formats.to_vec(), reads_words, ..Self::default() }
    }

    fn format(&self, arith: Arith) -> Option<&Format> {
        self.formats.get(arith.index())
    }

    /// Returns `true` if a card's unit computes in this arithmetic.
    pub(crate) fn is_card(&self, arith: Arith) -> bool {
        self.format(arith).is_some_and(|format| format.unit.is_card())
    }

    /// The operation that copies numbers of one format to be rounded to another.
    pub(crate) fn widen(&self, from: Arith, to: Arith) -> LaneCode {
        self.format(from).zip(self.format(to)).map_or(LaneCode::Widen, |(from, to)| LaneCode::widen(from, to))
    }

    /// The operation that converts single floats into the words of a card's unit, and its format; `None` for other
    /// conversions. Words stay unchanged; numbers of an ideal format become their patterns, with one NaN. Vertex
    /// programs read words.
    pub(crate) fn copies(&self, from: Arith, to: Arith, number: NodeId) -> Option<(Arith, Op)> {
        let is_single = |format: &Format| format.kind == Format::FP32.kind && format.encoding == Encoding::Ieee;
        if !self.is_card(to) || !self.format(from).is_some_and(is_single) {
            return None;
        }
        let word = self.is_card(from) || self.reads_words && matches!(self.kind(number), NodeKind::Input(_));
        Some(if word { (Arith::Single, Op::Or) } else { (from, Op::Encode) })
    }

    /// Returns the node with this definition, creating it if it is new.
    pub(crate) fn node(&mut self, kind: NodeKind) -> NodeId {
        *self.known.entry(kind).or_insert_with(|| {
            self.kinds.push(kind);
            NodeId((self.kinds.len() - 1) as u32)
        })
    }

    pub(crate) fn constant(&mut self, raw: u32) -> NodeId {
        self.node(NodeKind::Constant(raw))
    }

    /// Returns `true` if mask `a` is `b`, or a disjunction that contains `b`.
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

    /// For each node, `true` if a root depends on it.
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

    /// For each node, `true` if it has the same value in all lanes, given the uniform inputs and the kinds of nodes
    /// that read other lanes.
    pub(crate) fn uniform(&self, input: impl Fn(u16) -> bool, across: impl Fn(&NodeKind) -> bool) -> Vec<bool> {
        let mut uniform = Vec::with_capacity(self.kinds.len());
        for kind in &self.kinds {
            let same = match *kind {
                NodeKind::Constant(_) => true,
                NodeKind::Input(component) => input(component),
                // Uniform values are computed in batches whose adjacent lanes hold other triangles. (The difference of
                // equal lanes is a zero, whose sign depends on the format.)
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
