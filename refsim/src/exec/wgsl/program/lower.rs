//! Lowering of programs for GPUs: the graph shared with the batch executor, and the uses of its values.

use crate::device::Rules;
use crate::exec::budget::loop_counter;
use crate::exec::lower::{
    ACTIVE, Arith, DECIDED, Effect, Ends, Formats, Graph, KILLED, MaskedInstruction, MaskedProgram, NodeId, NodeKind,
    RegisterComponent, Slot, TRUE, Translator, has_flow, translate_straight,
};
use crate::exec::trace::{makes_step, written_mask};
use crate::exec::usage::registers_delivered;
use crate::exec::{FlowMap, PixelBindings, ResolvedConstants, colors_written};
use crate::isa::{Instruction, Mask, Opcode, OpcodeClass, Program, RegisterFile};
use crate::num::NumberOperation;
use std::collections::BTreeMap;

/// Use of values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SinkKind {
    /// Output of a colour component: target, component.
    Color(u16, u16),
    /// Output of the mask of killed lanes.
    Killed,
    /// Output of depth, and of the mask of lanes that write depth.
    Depth(Arith),
    /// Trace record of an instruction: up to four values, a lane mask for each, and the mask of their components.
    Trace(usize, Mask),
    /// Merge into the slot of a register under a mask: value, mask.
    Merge(Slot),
    /// Move into a slot.
    Move(Slot),
    /// Mask of a condition.
    Condition,
}

/// A use and its values.
#[derive(Clone, Debug)]
pub(super) struct Sink {
    pub(super) what: SinkKind,
    pub(super) nodes: Vec<NodeId>,
}

impl Sink {
    fn new(what: SinkKind, nodes: impl Into<Vec<NodeId>>) -> Self {
        Self { what, nodes: nodes.into() }
    }
}

/// An instruction of a program with flow control.
#[derive(Clone, Debug)]
pub(super) struct MaskedStep {
    pub(super) opcode: Opcode,
    /// Jump target, as in [`FlowMap::target`].
    pub(super) target: usize,
    /// Uses of the instruction's results. A condition has only one use.
    pub(super) sinks: Vec<Sink>,
    /// The sampler read.
    pub(super) sampler: Option<usize>,
    /// Integer constant of a loop.
    pub(super) counter: [i32; 4],
}

#[derive(Clone, Debug)]
pub(super) enum Body {
    /// Without flow control: the uses of all values, and the sampler of each texture read.
    Straight { sinks: Vec<Sink>, fetches: Vec<usize> },
    /// With flow control: steps with registers in slots below `first_free`, and the prologue and epilogue.
    Flow { start: Vec<Sink>, steps: Vec<MaskedStep>, first_free: Slot, end: Vec<Sink> },
}

/// A program as values and their uses.
#[derive(Clone, Debug)]
pub(super) struct Lowered {
    pub(super) graph: Graph,
    pub(super) formats: Formats,
    pub(super) body: Body,
    /// Raw float constants for relative addressing; empty if the program has none.
    pub(super) table: Vec<[u32; 4]>,
}

impl Lowered {
    /// Lowers a pixel program; if `traced`, the results of every instruction are recorded.
    pub(super) fn pixel(program: &Program, rules: &Rules, bindings: &PixelBindings<'_>, traced: bool) -> Self {
        let constants = ResolvedConstants::pixel(program, rules, bindings.constants);
        let formats = Formats::pixel(program, rules);
        let mut t = Translator::new(program, rules, formats, &constants, Some(bindings));
        let body = match has_flow(program) {
            false => straight(&mut t, program, traced),
            true => {
                let parts = MaskedProgram::new(program, &mut t);
                let end = color_sinks(&mut t, program, &parts.registers);
                flow(&mut t, program, parts, end, traced)
            }
        };
        Self::finish(t, body, &constants)
    }

    fn finish(t: Translator<'_>, body: Body, constants: &ResolvedConstants) -> Self {
        let (graph, formats) = (t.make.graph, t.make.formats);
        let relative = (0..graph.len() as u32).any(|i| matches!(graph.kind(NodeId(i)), NodeKind::Relative(..)));
        let table = constants
            .float
            .iter()
            .filter(|_| relative)
            .map(|c| c.map(|bits| formats.decode(Arith::Main, bits)))
            .collect();
        Self { graph, formats, body, table }
    }
}

fn straight(t: &mut Translator<'_>, program: &Program, traced: bool) -> Body {
    let mut taps = if traced { delivered_sinks(t, program) } else { Vec::new() };
    let mut written: Vec<(usize, Vec<u8>, Vec<NodeId>)> = Vec::new();
    let ends = translate_straight(t, program, |at, effects| {
        let values = effects.iter().filter_map(|effect| match effect {
            Effect::Write((_, _, component), value, _) => Some((*component, *value)),
            _ => None,
        });
        let (components, nodes): (Vec<u8>, Vec<NodeId>) = values.unzip();
        written.push((at, components, nodes));
    });
    if traced {
        let all = t.make.graph.constant(TRUE);
        for (at, components, mut nodes) in written {
            let Some(instruction) = program.instructions.get(at).filter(|i| makes_step(i)) else { continue };
            let mask = written_mask(instruction, components.into_iter());
            nodes.extend(vec![all; nodes.len()]);
            taps.push(Sink::new(SinkKind::Trace(at, mask), nodes));
        }
    }
    let mut sinks = end_sinks(t, &ends);
    sinks.append(&mut taps);
    Body::Straight { sinks, fetches: std::mem::take(&mut t.fetches) }
}

fn end_sinks(t: &mut Translator<'_>, ends: &Ends) -> Vec<Sink> {
    let mut sinks = Vec::new();
    for (target, color) in (0u16..).zip(&ends.colors) {
        for (component, &node) in (0u16..).zip(color.iter().flatten()) {
            sinks.push(Sink::new(SinkKind::Color(target, component), [node]));
        }
    }
    sinks.extend(ends.killed.map(|mask| Sink::new(SinkKind::Killed, [mask])));
    if let Some((arith, value)) = ends.depth {
        let all = t.make.graph.constant(TRUE);
        sinks.push(Sink::new(SinkKind::Depth(arith), [value, all]));
    }
    sinks
}

/// Outputs of a pixel program with flow control.
fn color_sinks(t: &mut Translator<'_>, program: &Program, registers: &BTreeMap<RegisterComponent, Slot>) -> Vec<Sink> {
    let mut sinks = Vec::new();
    let named = colors_written(program);
    for target in (0u16..4).filter(|i| named >> i & 1 == 1) {
        for component in 0u16..4 {
            if let Some(&slot) = registers.get(&(RegisterFile::ColorOut, target, component as u8)) {
                let held = t.make.graph.node(NodeKind::Held(slot));
                sinks.push(Sink::new(SinkKind::Color(target, component), [held]));
            }
        }
    }
    let killed = t.make.graph.node(NodeKind::Held(KILLED));
    sinks.push(Sink::new(SinkKind::Killed, [killed]));
    if let Some(&slot) = registers.get(&(RegisterFile::DepthOut, 0, 0)) {
        let nodes = [slot, DECIDED].map(|slot| t.make.graph.node(NodeKind::Held(slot)));
        sinks.push(Sink::new(SinkKind::Depth(Arith::Main), nodes));
    }
    sinks
}

fn flow(t: &mut Translator<'_>, program: &Program, parts: MaskedProgram, end: Vec<Sink>, traced: bool) -> Body {
    let map = FlowMap::new(program);
    let MaskedProgram { parts, registers: _, first_free } = parts;
    let mut steps = Vec::with_capacity(parts.len());
    for (at, (instruction, part)) in program.instructions.iter().zip(parts).enumerate() {
        let sampler = part.sampler;
        let sinks = match instruction.opcode.info().class {
            OpcodeClass::Flow => part.roots.iter().map(|&root| Sink::new(SinkKind::Condition, [root])).collect(),
            _ => merges(t, at, instruction, part, traced),
        };
        steps.push(MaskedStep {
            opcode: instruction.opcode,
            target: map.target(at),
            sinks,
            sampler,
            counter: loop_counter(instruction, t.constants),
        });
    }
    let start = if traced { delivered_sinks(t, program) } else { Vec::new() };
    Body::Flow { start, steps, first_free, end }
}

/// Trace records of the input registers, before the program; numbered after the instructions.
fn delivered_sinks(t: &mut Translator<'_>, program: &Program) -> Vec<Sink> {
    let all = t.make.graph.constant(TRUE);
    let numbers = program.instructions.len()..;
    let sink = |(at, register)| {
        let mut nodes = [0, 1, 2, 3].map(|c| t.held(&register, c)).to_vec();
        nodes.extend([all; 4]);
        Sink::new(SinkKind::Trace(at, Mask::ALL), nodes)
    };
    numbers.zip(registers_delivered(program)).map(sink).collect()
}

/// Merges of an instruction's results under lane masks.
fn merges(
    t: &mut Translator<'_>,
    at: usize,
    instruction: &Instruction,
    part: MaskedInstruction,
    traced: bool,
) -> Vec<Sink> {
    let (mut sinks, mut values, mut masks) = (Vec::new(), Vec::new(), Vec::new());
    for (&root, &to) in part.roots.iter().zip(&part.to) {
        let old = t.make.graph.node(NodeKind::Held(to));
        match t.make.graph.kind(root) {
            NodeKind::Compute(_, NumberOperation::Select, [mask, value, kept]) if kept == old => {
                values.push(value);
                masks.push(mask);
                sinks.push(Sink::new(SinkKind::Merge(to), [value, mask]));
            }
            _ => sinks.push(Sink::new(SinkKind::Move(to), [root])),
        }
    }
    if traced && makes_step(instruction) {
        // Every write is a merge, with the destination's components in order.
        let components = instruction.destination.map_or(Mask(0), |d| d.mask);
        let mask = written_mask(instruction, components.components().take(values.len()).map(|c| c as u8));
        values.append(&mut masks);
        sinks.insert(0, Sink::new(SinkKind::Trace(at, mask), values));
    }
    sinks
}

/// Slot of the mask of active lanes.
pub(super) const ACTIVE_SLOT: Slot = ACTIVE;
