//! Programs with flow control, and vertex programs: an instruction at a time under lane masks.
//!
//! Registers have slots of their own. An instruction is a small block whose results are merged into them where the
//! mask of active lanes, and the predicate, allow. Jumps are taken for the batch as a whole: a branch is walked if any
//! lane takes it.

use std::collections::BTreeMap;

use super::arith::Formats;
use super::graph::{Arith, Kind, Node};
use super::ops::Code;
use super::output::Results;
use super::program::one;
use super::schedule::{Block, schedule};
use super::slots::{Slot, Slots};
use super::translate::{Effect, Place, Translator};
use crate::device::Rules;
use crate::exec::budget::{enforced, loop_counter};
use crate::exec::{FlowMap, PixelBindings, ResolvedConstants};
use crate::isa::{Instruction, Opcode, OpcodeClass, Program, RegisterFile};

/// Slots with a fixed meaning; registers follow.
pub(crate) const ACTIVE: Slot = 0;
pub(crate) const KILLED: Slot = 1;
pub(crate) const DECIDED: Slot = 2;
pub(crate) const COUNTER: Slot = 3;
const FIRST_REGISTER: Slot = 4;

/// One instruction.
#[derive(Debug)]
pub(super) struct Instr {
    pub(super) opcode: Opcode,
    /// What is computed.
    pub(super) block: Block,
    /// Where the block's roots are merged to; for conditions there is one root and no place.
    pub(super) to: Vec<Slot>,
    /// The sampler that a texture instruction reads.
    pub(super) sampler: Option<usize>,
    /// Slots that it counts for.
    pub(super) cost: u64,
    /// Number of the integer constant of a loop.
    pub(super) counter: [i32; 4],
}

/// A program decoded for masked execution.
#[derive(Debug)]
pub(crate) struct FlowPlan {
    pub(super) code: Vec<Instr>,
    pub(super) flow: FlowMap,
    /// The step budget, if the program may exceed it.
    pub(super) budget: Option<u32>,
    constants: Vec<(Slot, u32)>,
    inputs: Vec<(u16, Slot)>,
    pub(super) registers: BTreeMap<Place, Slot>,
    slots: usize,
    results: Results,
}

impl FlowPlan {
    /// Decodes a pixel program.
    pub(crate) fn pixel(
        program: &Program,
        rules: &Rules,
        formats: &Formats,
        constants: &ResolvedConstants,
        bindings: &PixelBindings<'_>,
        budget: u32,
    ) -> Self {
        let translator = Translator::new(program, rules, formats.clone(), constants, Some(bindings));
        Self::new(program, constants, translator, budget)
    }

    /// Decodes a vertex program.
    pub(crate) fn vertex(
        program: &Program,
        rules: &Rules,
        formats: &Formats,
        constants: &ResolvedConstants,
        budget: u32,
    ) -> Self {
        Self::new(program, constants, Translator::new(program, rules, formats.clone(), constants, None), budget)
    }

    fn new(program: &Program, constants: &ResolvedConstants, mut t: Translator<'_>, budget: u32) -> Self {
        let Parts { parts, registers, first_free } = Parts::new(program, &mut t);
        let mut next = first_free;
        // Constants and inputs live as long as the program.
        let (mut constant_slots, mut inputs, mut placed) = (Vec::new(), Vec::new(), BTreeMap::new());
        let results = results(&mut t, program, &registers, &mut next, &mut constant_slots);
        for i in 0..t.make.graph.len() as u32 {
            match t.make.graph.kind(Node(i)) {
                Kind::Constant(raw) => constant_slots.push((next, raw)),
                Kind::Input(component) => inputs.push((component, next)),
                _ => continue,
            }
            placed.insert(Node(i), next);
            next += 1;
        }
        let mut slots = usize::from(next);
        let code = program.instructions.iter().zip(parts).map(|(instruction, part)| {
            let block = schedule(&t.make.graph, &part.roots, |_| false, &placed, next.into());
            slots = slots.max(block.slots);
            let cost = instruction.opcode.info().slot_cost(program.version);
            Instr {
                opcode: instruction.opcode,
                block,
                to: part.to,
                sampler: part.sampler,
                cost: u64::from(cost.arithmetic) + u64::from(cost.texture),
                counter: loop_counter(instruction, constants),
            }
        });
        let code = code.collect();
        let flow = FlowMap::new(program);
        let budget = enforced(program, &flow, constants, budget);
        Self { code, flow, budget, constants: constant_slots, inputs, registers, slots, results }
    }

    pub(crate) fn slots(&self) -> usize {
        self.slots
    }

    /// Input components and the slots they are expected in, before each run.
    pub(crate) fn inputs(&self) -> &[(u16, Slot)] {
        &self.inputs
    }

    pub(crate) fn results(&self) -> &Results {
        &self.results
    }

    /// The slot of a register component, if the program writes it.
    pub(crate) fn register(&self, file: RegisterFile, index: u16, component: u8) -> Option<Slot> {
        self.registers.get(&(file, index, component)).copied()
    }

    /// Fills the constants, once for new slots.
    pub(crate) fn fill(&self, slots: &mut Slots) {
        for &(slot, raw) in &self.constants {
            slots.fill(slot, raw);
        }
    }
}

/// Every register component that a program writes.
fn written(program: &Program) -> Vec<Place> {
    let mut out = Vec::new();
    for instruction in &program.instructions {
        let Some(destination) = &instruction.destination else { continue };
        let (file, index) = (destination.register.file, destination.register.index);
        match file {
            RegisterFile::DepthOut => out.push((file, 0, 0)),
            _ if instruction.opcode == Opcode::TexKill => {}
            _ => out.extend(destination.mask.components().map(|c| (file, index, c as u8))),
        }
    }
    out
}

/// The instructions of a program as graph nodes, each merged into registers that have slots of their own.
pub(crate) struct Parts {
    /// One for each instruction.
    pub(crate) parts: Vec<Part>,
    /// The slot of each register component that the program writes.
    pub(crate) registers: BTreeMap<Place, Slot>,
    /// The first slot that no register has.
    pub(crate) first_free: Slot,
}

impl Parts {
    pub(crate) fn new(program: &Program, t: &mut Translator<'_>) -> Self {
        let mut registers = BTreeMap::new();
        let mut next = FIRST_REGISTER;
        for place in written(program) {
            registers.entry(place).or_insert_with(|| {
                let node = t.make.graph.node(Kind::Held(next));
                t.registers.insert(place, node);
                next += 1;
                next - 1
            });
        }
        t.loop_counter = Some(COUNTER);
        let parts = program.instructions.iter().map(|i| part(t, i, &registers)).collect();
        Self { parts, registers, first_free: next }
    }
}

/// What an instruction computes and where it goes.
pub(crate) struct Part {
    pub(crate) roots: Vec<Node>,
    pub(crate) to: Vec<Slot>,
    pub(crate) sampler: Option<usize>,
}

fn part(t: &mut Translator<'_>, instruction: &Instruction, registers: &BTreeMap<Place, Slot>) -> Part {
    const MASK: Arith = Arith::Single;
    let active = t.make.graph.node(Kind::Held(ACTIVE));
    let mut part = Part { roots: Vec::new(), to: Vec::new(), sampler: None };
    if instruction.opcode.info().class == OpcodeClass::Flow {
        if matches!(instruction.opcode, Opcode::If | Opcode::IfC | Opcode::BreakC | Opcode::BreakP | Opcode::CallNz) {
            let condition = t.condition(instruction);
            part.roots.push(t.make.binary(MASK, Code::And, active, condition));
        }
        return part;
    }
    let mut effects = Vec::new();
    t.fetches.clear();
    one(t, instruction, &mut effects);
    part.sampler = t.fetches.first().copied();
    for effect in effects {
        match effect {
            Effect::Write(place, value, predicate) => {
                let Some(&slot) = registers.get(&place) else { continue };
                let allowed = predicate.map_or(active, |p| t.make.binary(MASK, Code::And, active, p));
                let old = t.make.graph.node(Kind::Held(slot));
                part.roots.push(t.make.select(allowed, value, old));
                part.to.push(slot);
                if place.0 == RegisterFile::DepthOut {
                    let decided = t.make.graph.node(Kind::Held(DECIDED));
                    part.roots.push(t.make.binary(MASK, Code::Or, decided, allowed));
                    part.to.push(DECIDED);
                }
            }
            Effect::Kill(mask) => {
                // Several components of one instruction: the masks add up before they reach the slot.
                let killing = t.make.binary(MASK, Code::And, active, mask);
                let before = match part.to.iter().position(|&s| s == KILLED) {
                    Some(i) => part.roots[i],
                    None => t.make.graph.node(Kind::Held(KILLED)),
                };
                let all = t.make.binary(MASK, Code::Or, before, killing);
                match part.to.iter().position(|&s| s == KILLED) {
                    Some(i) => part.roots[i] = all,
                    None => {
                        part.roots.push(all);
                        part.to.push(KILLED);
                    }
                }
            }
            // No version with flow control decides depth but by oDepth.
            Effect::Depth(..) => {}
        }
    }
    part
}

/// The result slots of a pixel program; components that are never written share a slot of zeros.
fn results(
    t: &mut Translator<'_>,
    program: &Program,
    registers: &BTreeMap<Place, Slot>,
    next: &mut Slot,
    constants: &mut Vec<(Slot, u32)>,
) -> Results {
    let _ = &t;
    let zero = *next;
    *next += 1;
    constants.push((zero, 0));
    let named = crate::exec::colors_written(program) | 1;
    let colors = std::array::from_fn(|i| {
        let slot = |c: usize| registers.get(&(RegisterFile::ColorOut, i as u16, c as u8)).copied().unwrap_or(zero);
        (named >> i & 1 == 1).then(|| [0, 1, 2, 3].map(slot))
    });
    let depth = registers.get(&(RegisterFile::DepthOut, 0, 0)).map(|&slot| (Arith::Main, slot, Some(DECIDED)));
    Results { colors, killed: Some(KILLED), depth }
}
