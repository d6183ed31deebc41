//! Programs with flow control, and vertex programs: executed one instruction at a time under lane masks.
//!
//! Each register component has its own slot. An instruction is a small block; its results are merged into registers
//! under the mask of active lanes and the predicate. The whole batch jumps together: a branch is executed if any lane
//! takes it.

use std::collections::BTreeMap;

use super::block::{ResultSlots, StepBlock, schedule};
use crate::device::Rules;
use crate::exec::budget::{enforced, loop_counter};
use crate::exec::lower::{
    Arith, DECIDED, Formats, KILLED, MaskedProgram, NodeId, NodeKind, RegisterComponent, Slot, Translator,
};
use crate::exec::{FlowMap, PixelBindings, ResolvedConstants};
use crate::isa::{Opcode, Program, RegisterFile};

#[derive(Debug)]
pub(crate) struct PlannedInstruction {
    pub(crate) opcode: Opcode,
    /// Computation of its results.
    pub(crate) block: StepBlock,
    /// Destination slots of the block's roots; a condition has one root and no destination.
    pub(crate) to: Vec<Slot>,
    pub(crate) sampler: Option<usize>,
    /// Number of instruction slots.
    pub(crate) cost: u64,
    /// Integer constant of a loop: count, start, step.
    pub(crate) counter: [i32; 4],
}

/// A program decoded for masked execution.
#[derive(Debug)]
pub(crate) struct FlowPlan {
    pub(crate) code: Vec<PlannedInstruction>,
    pub(crate) flow: FlowMap,
    /// The step budget, if the program may exceed it.
    pub(crate) budget: Option<u32>,
    /// Slots of uniform values, filled before the first run.
    pub(crate) constants: Vec<(Slot, u32)>,
    inputs: Vec<(u16, Slot)>,
    pub(crate) registers: BTreeMap<RegisterComponent, Slot>,
    slots: usize,
    results: ResultSlots,
}

impl FlowPlan {
    /// Plans a pixel program with its bindings, or a vertex program, which has none.
    pub(crate) fn new(
        program: &Program,
        rules: &Rules,
        formats: Formats,
        constants: &ResolvedConstants,
        bindings: Option<&PixelBindings<'_>>,
        budget: u32,
    ) -> Self {
        let mut t = Translator::new(program, rules, formats, constants, bindings);
        let MaskedProgram { parts, registers, first_free } = MaskedProgram::new(program, &mut t);
        let mut next = first_free;
        // Constants and inputs keep their slots for the whole program.
        let (mut constant_slots, mut inputs, mut placed) = (Vec::new(), Vec::new(), BTreeMap::new());
        let results = results(program, &registers, &mut next, &mut constant_slots);
        for i in 0..t.make.graph.len() as u32 {
            match t.make.graph.kind(NodeId(i)) {
                NodeKind::Constant(raw) => constant_slots.push((next, raw)),
                NodeKind::Input(component) => inputs.push((component, next)),
                _ => continue,
            }
            placed.insert(NodeId(i), next);
            next += 1;
        }
        let mut slots = usize::from(next);
        let code = program.instructions.iter().zip(parts).map(|(instruction, part)| {
            let block = schedule(&t.make.graph, &part.roots, |_| false, &placed, next.into());
            slots = slots.max(block.slots);
            PlannedInstruction {
                opcode: instruction.opcode,
                block,
                to: part.to,
                sampler: part.sampler,
                cost: instruction.opcode.info().slot_cost(program.version).total().into(),
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

    /// Input components and their slots, to be filled before each run.
    pub(crate) fn inputs(&self) -> &[(u16, Slot)] {
        &self.inputs
    }

    pub(crate) fn results(&self) -> &ResultSlots {
        &self.results
    }

    /// Slot of a register component, if the program writes it.
    pub(crate) fn register(&self, file: RegisterFile, index: u16, component: u8) -> Option<Slot> {
        self.registers.get(&(file, index, component)).copied()
    }
}

/// Result slots of a pixel program; components that are never written share a slot of zeros.
fn results(
    program: &Program,
    registers: &BTreeMap<RegisterComponent, Slot>,
    next: &mut Slot,
    constants: &mut Vec<(Slot, u32)>,
) -> ResultSlots {
    let zero = *next;
    *next += 1;
    constants.push((zero, 0));
    let named = crate::exec::colors_written(program) | 1;
    let colors = std::array::from_fn(|i| {
        let slot = |c: usize| registers.get(&(RegisterFile::ColorOut, i as u16, c as u8)).copied().unwrap_or(zero);
        (named >> i & 1 == 1).then(|| [0, 1, 2, 3].map(slot))
    });
    let depth = registers.get(&(RegisterFile::DepthOut, 0, 0)).map(|&slot| (Arith::Main, slot, Some(DECIDED)));
    ResultSlots { colors, killed: Some(KILLED), depth }
}
