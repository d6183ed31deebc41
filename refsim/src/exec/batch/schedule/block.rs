//! Scheduling of a graph as steps on slots.

use std::collections::{BTreeMap, BTreeSet};

use refsim_lanes::{LaneCode, LaneOp, OPERANDS, RowSum};

use super::fuse::{Fused, Fusion};
use crate::exec::lower::{Arith, Detail, Graph, NodeId, NodeKind, Slot};

/// A texture read with operands in slots.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct FetchStep {
    pub(crate) sampler: usize,
    pub(crate) coordinates: [Slot; 4],
    pub(crate) detail: FetchDetail,
    /// Slots of the needed components.
    pub(crate) to: [Option<Slot>; 4],
}

/// [`Detail`] with operands in slots.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum FetchDetail {
    Implicit,
    Biased(Slot),
    Gradients([Slot; 4], [Slot; 4]),
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum BatchStep {
    /// Lane operations of one format.
    Lanes(Arith, Vec<LaneOp>),
    /// Rounds single-precision values to fractions in [0, 1], into the wide row.
    Unorm {
        /// Number of steps.
        steps: u32,
        /// The values.
        from: Slot,
    },
    /// A sum computed by one adder.
    Sum {
        arith: Arith,
        /// Kind of sum.
        sum: RowSum,
        /// The operands; surplus operands are ignored.
        from: [Slot; 4],
        to: Slot,
    },
    /// A texture read.
    Fetch(FetchStep),
    /// Cosines or sines.
    Circle {
        arith: Arith,
        /// `true` for sines.
        sine: bool,
        from: Slot,
        to: Slot,
    },
    /// Relatively addressed constants.
    Relative {
        /// Index without the address register.
        base: i32,
        component: usize,
        address: Slot,
        to: Slot,
    },
}

#[derive(Clone, Debug, Default)]
pub(crate) struct StepBlock {
    /// Slots of uniform values, filled before the first run and never overwritten.
    pub(crate) constants: Vec<(Slot, u32)>,
    /// Slots that the caller fills before each run: `(input component, slot)`.
    pub(crate) inputs: Vec<(u16, Slot)>,
    /// Slots of values computed by another block: `(node, slot)`.
    pub(crate) given: Vec<(NodeId, Slot)>,
    pub(crate) steps: Vec<BatchStep>,
    /// Slots of the roots after the last step, in the order requested.
    pub(crate) roots: Vec<Slot>,
    /// Number of slots used.
    pub(crate) slots: usize,
    /// Slots of constants and given values of which steps read only the uniform value, never the row.
    pub(crate) without_row: Vec<Slot>,
}

/// Schedules the nodes that `roots` depend on, except `given` nodes, in the order of their creation.
///
/// Slots below `first_slot` belong to the caller, which has stored the nodes of `placed` there. Slots of temporaries
/// are reused after the last read; constants, inputs, given values and roots keep their slots.
pub(crate) fn schedule(
    graph: &Graph,
    roots: &[NodeId],
    given: impl Fn(NodeId) -> bool,
    placed: &BTreeMap<NodeId, Slot>,
    first_slot: usize,
) -> StepBlock {
    let fusion = Fusion::new(graph, roots, &given, |n| given(n) && !placed.contains_key(&n));
    let (last_use, needed) = uses(graph, &fusion, roots, &given);
    let mut maker = Scheduler {
        graph,
        fusion,
        read: BTreeSet::new(),
        block: StepBlock::default(),
        place: placed.clone(),
        last_use,
        free: Vec::new(),
        first: first_slot,
        next: first_slot,
        texels: BTreeMap::new(),
    };
    // Components get their slots together with the texture read.
    for &node in &needed {
        if let NodeKind::Texel(fetch, component) = graph.kind(node) {
            maker.texels.entry(fetch).or_default().push((component, node));
        }
    }
    // Leaves come first and keep their slots to the end.
    for &node in &needed {
        if !placed.contains_key(&node) {
            maker.leaf(node, &given);
        }
    }
    for &node in &needed {
        if !maker.place.contains_key(&node) {
            maker.place_node(node);
        }
    }
    maker.block.roots = roots.iter().map(|root| maker.place[root]).collect();
    maker.block.slots = maker.next;
    let leaves = maker.block.constants.iter().map(|c| c.0).chain(maker.block.given.iter().map(|g| g.1));
    let unread = leaves.filter(|slot| !maker.read.contains(slot) && !maker.block.roots.contains(slot));
    maker.block.without_row = unread.collect();
    maker.block
}

/// The last user of each node (roots stay live), and the needed nodes in order of creation.
fn uses(
    graph: &Graph,
    fusion: &Fusion<'_>,
    roots: &[NodeId],
    given: impl Fn(NodeId) -> bool,
) -> (BTreeMap<NodeId, u32>, Vec<NodeId>) {
    let mut live = vec![false; graph.len()];
    let mut last_use: BTreeMap<NodeId, u32> = BTreeMap::new();
    for &root in roots {
        live[root.0 as usize] = true;
        last_use.insert(root, u32::MAX);
    }
    for i in (0..graph.len() as u32).rev() {
        let node = NodeId(i);
        if live[i as usize] && !given(node) {
            fusion.needs(node, |n| {
                live[n.0 as usize] = true;
                last_use.entry(n).or_insert(i);
            });
        }
    }
    let needed = (0..graph.len() as u32).map(NodeId).filter(|n| live[n.0 as usize]).collect();
    (last_use, needed)
}

struct Scheduler<'g> {
    graph: &'g Graph,
    fusion: Fusion<'g>,
    block: StepBlock,
    place: BTreeMap<NodeId, Slot>,
    last_use: BTreeMap<NodeId, u32>,
    free: Vec<Slot>,
    /// The first free slot: lower slots belong to the caller.
    first: usize,
    next: usize,
    texels: BTreeMap<NodeId, Vec<(u8, NodeId)>>,
    /// Slots whose rows some step reads.
    read: BTreeSet<Slot>,
}

impl Scheduler<'_> {
    fn fresh(&mut self) -> Slot {
        self.next += 1;
        (self.next - 1) as Slot
    }

    /// Assigns a slot to a node that is not computed by a step.
    fn leaf(&mut self, node: NodeId, given: &impl Fn(NodeId) -> bool) {
        let slot = match self.graph.kind(node) {
            NodeKind::Constant(raw) => {
                let slot = self.fresh();
                self.block.constants.push((slot, raw));
                slot
            }
            NodeKind::Held(slot) => slot,
            _ if given(node) => {
                let slot = self.fresh();
                self.block.given.push((node, slot));
                slot
            }
            NodeKind::Input(component) => {
                let slot = self.fresh();
                self.block.inputs.push((component, slot));
                slot
            }
            _ => return,
        };
        self.place.insert(node, slot);
    }

    /// Allocates the slot of a result, after freeing the slots of operands that have no later reader. A lane operation
    /// may write a slot that it reads, because results are computed in the scratch row.
    fn result(&mut self) -> Slot {
        match self.free.pop() {
            Some(slot) => slot,
            None => self.fresh(),
        }
    }

    /// The slot of a value, which may be a slot of its operands.
    fn replace_operands(&mut self, node: NodeId) -> Slot {
        self.release(node);
        let to = self.result();
        self.place.insert(node, to);
        to
    }

    /// Frees the slots of temporaries whose last reader is `node`.
    fn release(&mut self, node: NodeId) {
        let mut done = Vec::new();
        let (last_use, place, graph) = (&self.last_use, &self.place, self.graph);
        self.fusion.needs(node, |n| {
            let kept = matches!(
                graph.kind(n),
                NodeKind::Constant(_) | NodeKind::Held(_) | NodeKind::Input(_) | NodeKind::Fetch(..)
            );
            if !kept
                && last_use.get(&n) == Some(&node.0)
                && let Some(&slot) = place.get(&n)
                && usize::from(slot) >= self.first
                && !done.contains(&slot)
            {
                done.push(slot);
            }
        });
        for slot in done {
            if !self.block.given.iter().any(|&(_, s)| s == slot) {
                self.free.push(slot);
            }
        }
    }

    /// The slot of a value whose row is read.
    fn at(&mut self, node: NodeId) -> Slot {
        let slot = self.place.get(&node).copied().unwrap_or_default();
        self.read.insert(slot);
        slot
    }

    /// Appends a lane operation and assigns the slot of its result.
    fn operation(&mut self, node: NodeId, fused: &Fused) {
        let mut args = [0; OPERANDS];
        for (i, &operand) in fused.operands().iter().enumerate() {
            args[i] = if fused.code.is_shared(i) {
                self.place.get(&operand).copied().unwrap_or_default()
            } else {
                self.at(operand)
            };
        }
        // Missing operands read the slot of the first operand.
        for i in fused.operands().len()..OPERANDS {
            args[i] = args[0];
        }
        let to = self.replace_operands(node);
        self.lane_op(fused.arith, LaneOp { code: fused.code, to, args, zero_wins: fused.zero_wins });
    }

    fn lane_op(&mut self, arith: Arith, op: LaneOp) {
        let neutral = matches!(op.code, LaneCode::Plain(operation) if operation.is_of_masks());
        match self.block.steps.last_mut() {
            Some(BatchStep::Lanes(last, ops)) if *last == arith || neutral => ops.push(op),
            _ => self.block.steps.push(BatchStep::Lanes(arith, vec![op])),
        }
    }

    fn place_node(&mut self, node: NodeId) {
        if let Some(&fused) = self.fusion.operation(node) {
            return self.operation(node, &fused);
        }
        match self.graph.kind(node) {
            NodeKind::Convert(from, target, operand) => {
                let a = self.at(operand);
                let to = self.replace_operands(node);
                if let Some((arith, code)) = self.graph.copies(from, target, operand) {
                    return self.lane_op(arith, LaneOp::of_one(LaneCode::Plain(code), to, a));
                }
                self.lane_op(from, LaneOp::of_one(self.graph.widen(from, target), to, a));
                self.lane_op(target, LaneOp::of_one(LaneCode::Narrow, to, a));
            }
            NodeKind::Sum(arith, sum, numbers) => {
                let mut from = [self.at(numbers[0]); 4];
                for k in 1..sum.operands() {
                    from[k] = self.at(numbers[k]);
                }
                let to = self.replace_operands(node);
                self.block.steps.push(BatchStep::Sum { arith, sum, from, to });
            }
            NodeKind::Steps(steps, a) => {
                let from = self.at(a);
                let to = self.replace_operands(node);
                self.block.steps.push(BatchStep::Unorm { steps, from });
                self.lane_op(Arith::Main, LaneOp::of_one(LaneCode::Narrow, to, from));
            }
            NodeKind::Circle(arith, sine, a) => {
                let from = self.at(a);
                let to = self.replace_operands(node);
                self.block.steps.push(BatchStep::Circle { arith, sine, from, to });
            }
            NodeKind::Relative(base, component, address) => {
                let address = self.at(address);
                let to = self.replace_operands(node);
                self.block.steps.push(BatchStep::Relative { base, component: component.into(), address, to });
            }
            NodeKind::Fetch(sampler, coordinates, detail) => {
                let coordinates = coordinates.map(|n| self.at(n));
                let detail = match detail {
                    Detail::Implicit => FetchDetail::Implicit,
                    Detail::Biased(bias) => FetchDetail::Biased(self.at(bias)),
                    Detail::Gradients(x, y) => FetchDetail::Gradients(x.map(|n| self.at(n)), y.map(|n| self.at(n))),
                };
                let mut to = [None; 4];
                for (component, texel) in self.texels.remove(&node).unwrap_or_default() {
                    let slot = self.result();
                    self.place.insert(texel, slot);
                    to[usize::from(component & 3)] = Some(slot);
                }
                self.release(node);
                self.block.steps.push(BatchStep::Fetch(FetchStep { sampler: sampler.into(), coordinates, detail, to }));
            }
            // Leaves got their slots earlier; texels got theirs together with their read.
            NodeKind::Compute(..)
            | NodeKind::Difference(..)
            | NodeKind::Dot(..)
            | NodeKind::Texel(..)
            | NodeKind::Constant(_)
            | NodeKind::Held(_)
            | NodeKind::Input(_) => {}
        }
    }
}

#[derive(Clone, Debug, Default)]
pub(crate) struct ResultSlots {
    pub(crate) colors: [Option<[Slot; 4]>; 4],
    pub(crate) killed: Option<Slot>,
    /// Depth written by the program: format, slot, and the mask of lanes that write depth, unless all do.
    pub(crate) depth: Option<(Arith, Slot, Option<Slot>)>,
}

impl ResultSlots {
    /// Returns `true` if the program writes the depth of every fragment.
    pub(crate) fn decide_depth(&self) -> bool {
        matches!(self.depth, Some((_, _, None)))
    }
}
