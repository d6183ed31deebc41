//! Assembler for the virtual machine of `vm.wgsl`: assigns slots to values and encodes operations.

use super::lower::{Sink, SinkKind};
use super::operations as op;
use crate::exec::lower::{Arith, Detail, Formats, Graph, NodeId, NodeKind};
use crate::exec::wgsl::number::source_word;
use crate::exec::wgsl::parts::Parts;
use crate::num::{Format, NumberOperation};
use refsim_lanes::{RowSum, TRUE};
use std::collections::{BTreeMap, BTreeSet};

/// First operand of each range. Slots are numbered from 0; then come constants, words of a triangle's set-up, input
/// rows and output rows.
pub(super) const FIRST_CONSTANT: usize = 0x8000;
pub(super) const SETUP: u16 = 0xfe00;
pub(super) const INPUT: u16 = 0xff00;
/// Output rows, as in `interface.wgsl`: colours, killed lanes, depth, lanes whose depth is in the main format.
pub(super) const COLORS: u16 = INPUT + 47;
pub(super) const KILLED: u16 = COLORS + 16;
pub(super) const DEPTH: u16 = KILLED + 1;
pub(super) const DEPTH_IS_MAIN: u16 = DEPTH + 1;
pub(crate) const IN_OUT_ROWS: usize = (DEPTH_IS_MAIN - INPUT) as usize + 1;
/// Code for a missing operand.
pub(super) const NONE: u16 = 0xffff;
/// Loop iterations per instruction, by the class in bits 14 and 15 of its word.
pub(super) const PASSES: [u32; 4] = [20, 600, 1000, 8000];

/// Encodes a program.
pub(super) struct Assembler<'g> {
    pub(super) graph: &'g Graph,
    pub(super) formats: &'g Formats,
    pub(super) words: Vec<u32>,
    /// Constants and their indices.
    pub(super) pool: BTreeMap<u32, usize>,
    /// Number of slots used.
    pub(super) next: usize,
    pub(super) parts: Parts,
    pub(super) samplers: BTreeSet<usize>,
    pub(super) passes: u32,
}

/// Slots of the values.
struct Places {
    at: BTreeMap<NodeId, u16>,
    /// Number of remaining reads of each value.
    left: BTreeMap<NodeId, u32>,
    free: Vec<u16>,
    next: usize,
    texels: BTreeMap<NodeId, Vec<(u8, NodeId)>>,
}

impl Places {
    fn fresh(&mut self) -> u16 {
        self.free.pop().unwrap_or_else(|| {
            self.next += 1;
            (self.next - 1) as u16
        })
    }

    fn of(&self, node: NodeId) -> u16 {
        self.at.get(&node).copied().unwrap_or(NONE)
    }
}

impl Assembler<'_> {
    pub(super) fn constant(&mut self, raw: u32) -> u16 {
        let number = self.pool.len();
        let number = *self.pool.entry(raw).or_insert(number);
        // Overflow is detected at the end.
        (FIRST_CONSTANT + number).min(usize::from(SETUP) - 1) as u16
    }

    /// Appends the first word of an instruction.
    pub(super) fn push(&mut self, operation: u32, rest: u32) {
        if let Some(part) = op::part(operation) {
            self.parts.add(&part);
        }
        self.words.push(operation | rest);
    }

    /// Appends the first word of an instruction with about `passes` loop iterations.
    pub(super) fn push_costly(&mut self, operation: u32, rest: u32, passes: u32) {
        let class = PASSES.iter().position(|&most| passes <= most).unwrap_or(PASSES.len() - 1);
        self.passes += PASSES[class];
        self.push(operation, rest | (class as u32) << 14);
    }

    /// Index of a format; marks it as used.
    pub(super) fn format(&mut self, k: Arith) -> u32 {
        let format = self.formats.format(k);
        self.parts.add_if(format != Format::FP32, "HAS_FORMATS");
        self.parts.add_format(&format);
        k.number()
    }

    /// Computes the values that the sinks need, and emits each sink as soon as its values are available.
    pub(super) fn program(&mut self, sinks: &[Sink]) {
        let live = self.graph.live(sinks.iter().flat_map(|s| s.nodes.iter().copied()));
        let needed: Vec<NodeId> = (0u32..).zip(&live).filter(|&(_, &live)| live).map(|(i, _)| NodeId(i)).collect();
        let mut places =
            Places { at: BTreeMap::new(), left: BTreeMap::new(), free: Vec::new(), next: 0, texels: BTreeMap::new() };
        let mut reads = |n: NodeId| *places.left.entry(n).or_default() += 1;
        for &node in &needed {
            self.graph.kind(node).needs(&mut reads);
        }
        sinks.iter().flat_map(|s| s.nodes.iter().copied()).for_each(reads);
        for &node in &needed {
            if let NodeKind::Texel(fetch, component) = self.graph.kind(node) {
                places.texels.entry(fetch).or_default().push((component, node));
            }
            self.leaf(node, &mut places);
        }
        // A sink is emitted after the last of its values.
        let mut order: Vec<(Option<NodeId>, &Sink)> = Vec::with_capacity(sinks.len());
        let mut traced = None;
        for sink in sinks {
            let mut last = sink.nodes.iter().copied().max();
            // Trace records must keep the order of the program.
            if let SinkKind::Trace(..) = sink.what {
                last = last.max(traced);
                traced = last;
            }
            order.push((last, sink));
        }
        order.sort_by_key(|&(last, _)| last);
        let mut waiting = order.into_iter().peekable();
        for &node in &needed {
            if places.of(node) == NONE {
                self.node(node, &mut places);
            }
            while let Some((_, sink)) = waiting.next_if(|&(last, _)| last <= Some(node)) {
                self.sink(sink, &mut places);
            }
        }
        for (_, sink) in waiting {
            self.sink(sink, &mut places);
        }
        self.next = self.next.max(places.next);
    }

    fn leaf(&mut self, node: NodeId, places: &mut Places) {
        let at = match self.graph.kind(node) {
            NodeKind::Constant(raw) => self.constant(raw),
            NodeKind::Input(component) => INPUT + component,
            _ => return,
        };
        places.at.insert(node, at);
    }

    /// Counts one read of each value; frees the slots of values without remaining reads.
    fn release(&self, nodes: &[NodeId], places: &mut Places) {
        for node in nodes {
            let Some(left) = places.left.get_mut(node) else { continue };
            *left = left.saturating_sub(1);
            let kept =
                matches!(self.graph.kind(*node), NodeKind::Constant(_) | NodeKind::Input(_) | NodeKind::Fetch(..));
            if *left == 0 && !kept && places.of(*node) != NONE {
                places.free.push(places.of(*node));
            }
        }
    }

    fn release_operands(&self, node: NodeId, places: &mut Places) {
        let mut operands = Vec::new();
        self.graph.kind(node).needs(|n| operands.push(n));
        self.release(&operands, places);
    }

    /// Allocates the slot of a result, after its operands' last reads. Lanes are computed one after the other, so only
    /// operations that do not read other lanes may overwrite an operand.
    fn result(&mut self, node: NodeId, places: &mut Places) -> u16 {
        self.release_operands(node, places);
        let to = places.fresh();
        places.at.insert(node, to);
        to
    }

    pub(super) fn emit(&mut self, operation: u32, rest: u32, to: u16, [a, b, c]: [u16; 3]) {
        let (operation, passes) = match (operation, passes(rest >> 16 & 255)) {
            (op::ALU, passes) if passes > PASSES[0] => (op::LONG, passes),
            _ => (operation, PASSES[0]),
        };
        self.push_costly(operation, rest, passes);
        self.words.extend([pair(to, a), pair(b, c)]);
    }

    fn node(&mut self, node: NodeId, places: &mut Places) {
        match self.graph.kind(node) {
            NodeKind::Compute(k, code, args) => self.compute(node, k, code, args.map(|n| places.of(n)), places),
            NodeKind::Dot(k, terms, a, b) => {
                let mut operands = [0; 8];
                for i in 0..usize::from(terms.min(4)) {
                    (operands[2 * i], operands[2 * i + 1]) = (places.of(a[i]), places.of(b[i]));
                }
                let format = self.format(k);
                let to = self.result(node, places);
                let [o0, o1, o2, o3, o4, o5, o6, o7] = operands;
                self.push_costly(op::DOT, format << 24 | u32::from(terms) << 16, 600);
                self.words.extend([pair(to, o0), pair(o1, o2), pair(o3, o4), pair(o5, o6), pair(o7, 0)]);
            }
            NodeKind::Sum(k, sum, numbers) => {
                let mut operands = [places.of(numbers[0]); 4];
                for i in 0..sum.operands() {
                    operands[i] = places.of(numbers[i]);
                }
                let what = match sum {
                    RowSum::Aligned { terms, bits } => u32::from(bits) << 3 | u32::from(terms),
                    RowSum::ProductCut => 0,
                };
                let format = self.format(k);
                let to = self.result(node, places);
                let [a, b, c, d] = operands;
                self.push_costly(op::SUM, format << 24 | what << 16, PASSES[0]);
                self.words.extend([pair(to, a), pair(b, c), pair(d, 0)]);
            }
            NodeKind::Difference(k, down, a) => {
                let (a, other) = (places.of(a), if down { 2 } else { 1 });
                let to = places.fresh();
                places.at.insert(node, to);
                self.release_operands(node, places);
                self.parts.add_operation(NumberOperation::Sub);
                let format = self.format(k);
                self.emit(op::ALU, format << 24 | other << 12 | NumberOperation::Sub.word() << 16, to, [a; 3]);
            }
            NodeKind::Convert(from, into, a) => {
                let format = self.formats.format(from);
                self.parts.add_format(&format);
                if self.formats.format(into).takes_patterns_of(&format) {
                    let a = places.of(a);
                    let to = self.result(node, places);
                    self.emit(op::COPY, 0, to, [a; 3]);
                    return;
                }
                let source = self.constant(source_word(&format));
                self.alu(node, into, NumberOperation::Convert, [places.of(a), source, source], places);
            }
            NodeKind::Steps(steps, a) => {
                let steps = self.constant(steps);
                self.alu(node, Arith::Main, NumberOperation::Steps, [places.of(a), steps, steps], places);
            }
            NodeKind::Fetch(sampler, coordinates, detail) => self.fetch(node, sampler, coordinates, detail, places),
            NodeKind::Circle(k, sine, a) => {
                let a = places.of(a);
                self.alu(node, k, if sine { NumberOperation::Sin } else { NumberOperation::Cos }, [a; 3], places);
            }
            NodeKind::Texel(..) | NodeKind::Constant(_) | NodeKind::Input(_) => {}
            // These occur only in programs with flow control and in vertex programs.
            NodeKind::Held(_) | NodeKind::Relative(..) => {}
        }
    }

    fn alu(&mut self, node: NodeId, k: Arith, operation: NumberOperation, args: [u16; 3], places: &mut Places) {
        let to = self.result(node, places);
        self.operation(k, operation, to, args);
    }

    fn operation(&mut self, k: Arith, operation: NumberOperation, to: u16, args: [u16; 3]) {
        self.parts.add_operation(operation);
        let format = self.format(k);
        self.emit(op::ALU, format << 24 | operation.word() << 16, to, args);
    }

    fn compute(&mut self, node: NodeId, k: Arith, code: NumberOperation, args: [u16; 3], places: &mut Places) {
        let [a, b, c] = args;
        let bits = match code {
            NumberOperation::And => Some(op::AND),
            NumberOperation::Or => Some(op::OR),
            NumberOperation::AndNot => Some(op::AND_NOT),
            NumberOperation::Select => Some(op::SELECT),
            _ => None,
        };
        if let Some(bits) = bits {
            let to = self.result(node, places);
            self.emit(bits, 0, to, args);
            return;
        }
        match code {
            NumberOperation::Mad if self.formats.format(k).unit.is_card() => {
                self.alu(node, k, NumberOperation::FusedMad, args, places);
            }
            // The shader has no multiply-add with two roundings.
            NumberOperation::Mad => {
                let product = places.fresh();
                self.operation(k, NumberOperation::Mul, product, [a, b, a]);
                places.free.push(product);
                self.alu(node, k, NumberOperation::Add, [product, c, product], places);
            }
            _ => {
                let args = std::array::from_fn(|i| if i < code.operands() { args[i] } else { a });
                self.alu(node, k, code, args, places);
            }
        }
    }

    fn fetch(&mut self, node: NodeId, sampler: u8, coordinates: [NodeId; 4], detail: Detail, places: &mut Places) {
        let [u, v, w, q] = coordinates.map(|n| places.of(n));
        let (number, more) = match detail {
            Detail::Implicit => (0, vec![]),
            Detail::Biased(bias) => (1, vec![places.of(bias).into()]),
            Detail::Gradients(x, y) => {
                let all: Vec<u16> = x.iter().chain(&y).map(|&n| places.of(n)).collect();
                (2, all.chunks_exact(2).map(|p| pair(p[0], p[1])).collect())
            }
        };
        let mut to = [NONE; 4];
        for (component, texel) in places.texels.remove(&node).unwrap_or_default() {
            let slot = places.fresh();
            places.at.insert(texel, slot);
            to[usize::from(component & 3)] = slot;
        }
        places.at.insert(node, 0);
        // A lane's texel is written before the next lane's coordinates are read.
        self.release_operands(node, places);
        self.samplers.insert(sampler.into());
        self.push_costly(op::FETCH, u32::from(sampler) << 16 | number << 24, 8000);
        self.words.extend([pair(u, v), pair(w, q), pair(to[0], to[1]), pair(to[2], to[3])]);
        self.words.extend(more);
    }

    fn sink(&mut self, sink: &Sink, places: &mut Places) {
        let operands: Vec<u16> = sink.nodes.iter().map(|&n| places.of(n)).collect();
        let first = operands.first().copied().unwrap_or(NONE);
        match sink.what {
            SinkKind::Color(target, c) => self.emit(op::COPY, 0, COLORS + 4 * target + c, [first; 3]),
            SinkKind::Killed => self.emit(op::COPY, 0, KILLED, [first; 3]),
            SinkKind::Depth(arith) => {
                self.emit(op::COPY, 0, DEPTH, [first; 3]);
                if arith == Arith::Main {
                    let all = self.constant(TRUE);
                    self.emit(op::COPY, 0, DEPTH_IS_MAIN, [all; 3]);
                }
            }
            SinkKind::Trace(at, mask) => {
                let mut values = [NONE; 4];
                for (c, &operand) in mask.components().zip(&operands) {
                    values[c] = operand;
                }
                self.push_costly(op::TRACE, u32::from(mask.0) << 16, PASSES[0]);
                self.words.extend([at as u32, pair(values[0], values[1]), pair(values[2], values[3])]);
            }
        }
        self.release(&sink.nodes, places);
    }
}

fn pair(low: u16, high: u16) -> u32 {
    u32::from(low) | u32::from(high) << 16
}

/// Loop iterations of a number operation in four lanes.
fn passes(operation: u32) -> u32 {
    use NumberOperation as Op;
    match Op::ALL.get(operation as usize) {
        Some(Op::Exp2 | Op::Log2) => 1000,
        Some(Op::Div | Op::Rcp | Op::Rsq | Op::Sqrt | Op::Steps | Op::Sin | Op::Cos) => 600,
        Some(Op::SplitShort | Op::SplitByte | Op::SplitSignedByte) => 600,
        _ => PASSES[0],
    }
}
