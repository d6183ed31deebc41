//! Programs with flow control, and vertex programs: an instruction at a time under lane masks.
//!
//! Registers have slots of their own. An instruction is a small block whose results are merged into them where the
//! mask of active lanes, and the predicate, allow. Jumps are taken for the batch as a whole: a branch is walked if any
//! lane takes it.

use std::collections::BTreeMap;

use super::arith::Formats;
use super::graph::{Arith, Kind, Node};
use super::lane::LANES;
use super::ops::Code;
use super::output::Results;
use super::program::one;
use super::schedule::{Block, schedule};
use super::slots::{Row, Slot, Slots, TRUE};
use super::steps::{Surroundings, run_steps};
use super::translate::{Effect, Place, Translator};
use crate::device::Rules;
use crate::event::SAMPLERS;
use crate::exec::{FlowMap, PixelBindings, ResolvedConstants};
use crate::isa::{Opcode, OpcodeClass, Program, RegisterFile};

/// Passes of a loop at most, as in the scalar executor.
const LOOP_LIMIT: i32 = 255;

/// Slots with a fixed meaning; registers follow.
const ACTIVE: Slot = 0;
const KILLED: Slot = 1;
const DECIDED: Slot = 2;
const COUNTER: Slot = 3;
const FIRST_REGISTER: Slot = 4;

/// One instruction.
#[derive(Debug)]
struct Instr {
    opcode: Opcode,
    /// What is computed.
    block: Block,
    /// Where the block's roots are merged to; for conditions there is one root and no place.
    to: Vec<Slot>,
    /// The sampler that a texture instruction reads.
    sampler: Option<usize>,
    /// Slots that it counts for.
    cost: u64,
    /// Number of the integer constant of a loop.
    counter: [i32; 4],
}

/// A program decoded for masked execution.
#[derive(Debug)]
pub(crate) struct FlowPlan {
    code: Vec<Instr>,
    flow: FlowMap,
    constants: Vec<(Slot, u32)>,
    inputs: Vec<(u16, Slot)>,
    registers: BTreeMap<Place, Slot>,
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
    ) -> Self {
        Self::new(program, constants, Translator::new(program, rules, formats.clone(), constants, Some(bindings)))
    }

    /// Decodes a vertex program.
    pub(crate) fn vertex(program: &Program, rules: &Rules, formats: &Formats, constants: &ResolvedConstants) -> Self {
        Self::new(program, constants, Translator::new(program, rules, formats.clone(), constants, None))
    }

    fn new(program: &Program, constants: &ResolvedConstants, mut t: Translator<'_>) -> Self {
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
        let parts: Vec<_> = program.instructions.iter().map(|i| part(&mut t, i, &registers)).collect();
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
            let counter = match instruction.opcode {
                Opcode::Loop => instruction.sources.get(1),
                _ => instruction.sources.first(),
            };
            let number = counter.map_or(usize::MAX, |s| usize::from(s.register.index));
            Instr {
                opcode: instruction.opcode,
                block,
                to: part.to,
                sampler: part.sampler,
                cost: u64::from(cost.arithmetic) + u64::from(cost.texture),
                counter: constants.int.get(number).copied().unwrap_or_default(),
            }
        });
        let code = code.collect();
        Self { code, flow: FlowMap::new(program), constants: constant_slots, inputs, registers, slots, results }
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

/// What an instruction computes and where it goes.
struct Part {
    roots: Vec<Node>,
    to: Vec<Slot>,
    sampler: Option<usize>,
}

fn part(t: &mut Translator<'_>, instruction: &crate::isa::Instruction, registers: &BTreeMap<Place, Slot>) -> Part {
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

/// What an open block remembers.
enum Frame {
    If { restore: Box<Row>, otherwise: Box<Row> },
    Loop { live: Box<Row>, restore: Box<Row>, left: i32, step: i32, outer: i32 },
    Call { restore: Box<Row>, back: usize },
}

/// One run of a program over a batch.
pub(crate) struct FlowRun<'p> {
    plan: &'p FlowPlan,
    around: &'p Surroundings<'p>,
    run: &'p Row,
    covered: &'p Row,
    frames: Vec<Frame>,
    counter: i32,
    /// Instruction slots, summed over the lanes.
    pub(crate) executed: u64,
}

fn any(row: &Row) -> bool {
    row.iter().any(|&m| m != 0)
}

fn remove(from: &mut Row, lanes: &Row) {
    for (a, &b) in from.iter_mut().zip(lanes) {
        *a &= !b;
    }
}

impl<'p> FlowRun<'p> {
    /// A run of the lanes in `run`, of which those in `covered` are fragments (or vertices).
    pub(crate) fn new(plan: &'p FlowPlan, around: &'p Surroundings<'p>, run: &'p Row, covered: &'p Row) -> Self {
        Self { plan, around, run, covered, frames: Vec::new(), counter: 0, executed: 0 }
    }

    /// Runs the program to its end.
    pub(crate) fn run(&mut self, slots: &mut Slots, fetches: &mut [u64; SAMPLERS]) {
        *slots.row_mut(ACTIVE) = *self.run;
        for slot in [KILLED, DECIDED, COUNTER].into_iter().chain(self.plan.registers.values().copied()) {
            slots.fill(slot, 0);
        }
        let mut at = 0;
        loop {
            let Some(instruction) = self.plan.code.get(at) else {
                match self.return_from_call(slots) {
                    Some(back) => at = back,
                    None => return,
                }
                continue;
            };
            let running = any(slots.row(ACTIVE));
            if running {
                let lanes = slots.row(ACTIVE).iter().zip(self.covered).filter(|&(&a, &c)| a & c != 0).count() as u64;
                self.executed += instruction.cost * lanes;
                if let Some(count) = instruction.sampler.and_then(|s| fetches.get_mut(s)) {
                    *count += lanes;
                }
            }
            if instruction.opcode.info().class == OpcodeClass::Flow {
                match self.flow(at, instruction, slots) {
                    Some(next) => at = next,
                    None => return,
                }
                continue;
            }
            if running {
                run_steps(&instruction.block.steps, self.around, self.run, slots);
                for (&root, &to) in instruction.block.roots.iter().zip(&instruction.to) {
                    slots.rows.swap(root.into(), to.into());
                }
            }
            at += 1;
        }
    }

    /// The active lanes in which the instruction's condition holds.
    fn condition(&self, instruction: &Instr, slots: &mut Slots) -> Row {
        run_steps(&instruction.block.steps, self.around, self.run, slots);
        instruction.block.roots.first().map_or([0; LANES], |&root| *slots.row(root))
    }

    fn flow(&mut self, at: usize, instruction: &Instr, slots: &mut Slots) -> Option<usize> {
        let target = self.plan.flow.target(at);
        match instruction.opcode {
            Opcode::If | Opcode::IfC => {
                let taken = self.condition(instruction, slots);
                let restore = Box::new(*slots.row(ACTIVE));
                let mut otherwise = restore.clone();
                remove(&mut otherwise, &taken);
                self.frames.push(Frame::If { restore, otherwise });
                *slots.row_mut(ACTIVE) = taken;
                Some(if any(&taken) { at + 1 } else { target })
            }
            Opcode::Else => {
                if let Some(Frame::If { otherwise, .. }) = self.frames.last() {
                    *slots.row_mut(ACTIVE) = **otherwise;
                }
                Some(if any(slots.row(ACTIVE)) { at + 1 } else { target })
            }
            Opcode::EndIf => {
                if let Some(Frame::If { restore, .. }) = self.frames.last() {
                    *slots.row_mut(ACTIVE) = **restore;
                    self.frames.pop();
                }
                Some(at + 1)
            }
            Opcode::Rep | Opcode::Loop => Some(self.enter_loop(at, target, instruction, slots)),
            Opcode::EndRep | Opcode::EndLoop => Some(self.end_pass(at, target, slots)),
            Opcode::Break => {
                let leaving = *slots.row(ACTIVE);
                self.leave_loop(&leaving, slots);
                Some(at + 1)
            }
            Opcode::BreakC | Opcode::BreakP => {
                let leaving = self.condition(instruction, slots);
                self.leave_loop(&leaving, slots);
                Some(at + 1)
            }
            Opcode::Call | Opcode::CallNz => {
                let entering = match instruction.opcode {
                    Opcode::CallNz => self.condition(instruction, slots),
                    _ => *slots.row(ACTIVE),
                };
                if !any(&entering) || target <= at || target >= self.plan.code.len() {
                    return Some(at + 1);
                }
                self.frames.push(Frame::Call { restore: Box::new(*slots.row(ACTIVE)), back: at + 1 });
                *slots.row_mut(ACTIVE) = entering;
                Some(target + 1)
            }
            Opcode::Ret => self.ret(at, slots),
            Opcode::Label => self.return_from_call(slots),
            _ => Some(at + 1),
        }
    }

    fn count_from(&mut self, counter: i32, slots: &mut Slots) {
        self.counter = counter;
        slots.fill(COUNTER, counter.cast_unsigned());
    }

    fn enter_loop(&mut self, at: usize, target: usize, instruction: &Instr, slots: &mut Slots) -> usize {
        let [count, start, step, _] = instruction.counter;
        let left = count.clamp(0, LOOP_LIMIT);
        if left == 0 || !any(slots.row(ACTIVE)) {
            return target + 1;
        }
        let counted = instruction.opcode == Opcode::Loop;
        let active = Box::new(*slots.row(ACTIVE));
        let step = if counted { step } else { 0 };
        self.frames.push(Frame::Loop { live: active.clone(), restore: active, left, step, outer: self.counter });
        if counted {
            self.count_from(start, slots);
        }
        at + 1
    }

    fn end_pass(&mut self, at: usize, start: usize, slots: &mut Slots) -> usize {
        let Some(Frame::Loop { live, restore, left, step, outer }) = self.frames.last_mut() else {
            return at + 1;
        };
        *left -= 1;
        if *left > 0 && any(live) {
            *slots.row_mut(ACTIVE) = **live;
            let counter = self.counter.wrapping_add(*step);
            self.count_from(counter, slots);
            return start + 1;
        }
        *slots.row_mut(ACTIVE) = **restore;
        let outer = *outer;
        self.frames.pop();
        self.count_from(outer, slots);
        at + 1
    }

    fn leave_loop(&mut self, lanes: &Row, slots: &mut Slots) {
        let in_loop = self
            .frames
            .iter()
            .rev()
            .take_while(|f| !matches!(f, Frame::Call { .. }))
            .any(|f| matches!(f, Frame::Loop { .. }));
        if !in_loop {
            return;
        }
        remove(slots.row_mut(ACTIVE), lanes);
        for frame in self.frames.iter_mut().rev() {
            match frame {
                Frame::If { restore, otherwise } => {
                    remove(restore, lanes);
                    remove(otherwise, lanes);
                }
                Frame::Loop { live, .. } => {
                    remove(live, lanes);
                    return;
                }
                Frame::Call { .. } => return,
            }
        }
    }

    fn ret(&mut self, at: usize, slots: &mut Slots) -> Option<usize> {
        match self.frames.last() {
            None => return None,
            Some(Frame::Call { .. }) => return self.return_from_call(slots),
            Some(_) => {}
        }
        let done = *slots.row(ACTIVE);
        slots.fill(ACTIVE, 0);
        for frame in self.frames.iter_mut().rev() {
            match frame {
                Frame::If { restore, otherwise } => {
                    remove(restore, &done);
                    remove(otherwise, &done);
                }
                Frame::Loop { live, restore, .. } => {
                    remove(live, &done);
                    remove(restore, &done);
                }
                Frame::Call { .. } => break,
            }
        }
        Some(at + 1)
    }

    fn return_from_call(&mut self, slots: &mut Slots) -> Option<usize> {
        while let Some(frame) = self.frames.pop() {
            if let Frame::Call { restore, back } = frame {
                *slots.row_mut(ACTIVE) = *restore;
                return Some(back);
            }
        }
        None
    }
}

/// A mask of the first `count` lanes.
pub(crate) fn first_lanes(count: usize) -> Row {
    std::array::from_fn(|i| if i < count { TRUE } else { 0 })
}
