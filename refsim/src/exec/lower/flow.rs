//! Translation of programs with flow control: each instruction is a set of nodes; their results are merged into
//! registers under the mask of active lanes and the predicate.

use std::collections::BTreeMap;

use refsim_lanes::Slot;

use super::graph::{Arith, NodeId, NodeKind};
use super::program::translate_instruction;
use super::translate::{Effect, RegisterComponent, Translator};
use crate::isa::{Instruction, Opcode, OpcodeClass, Program, RegisterFile};
use crate::num::NumberOperation as Op;

/// Slots with a fixed meaning; register slots follow.
pub(crate) const ACTIVE: Slot = 0;
pub(crate) const KILLED: Slot = 1;
pub(crate) const DECIDED: Slot = 2;
pub(crate) const COUNTER: Slot = 3;
const FIRST_REGISTER: Slot = 4;

fn written(program: &Program) -> Vec<RegisterComponent> {
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

/// Instructions of a program as graph nodes, and the slots of the registers that receive their results.
pub(crate) struct MaskedProgram {
    /// One entry per instruction.
    pub(crate) parts: Vec<MaskedInstruction>,
    pub(crate) registers: BTreeMap<RegisterComponent, Slot>,
    /// First slot after the registers.
    pub(crate) first_free: Slot,
}

impl MaskedProgram {
    pub(crate) fn new(program: &Program, t: &mut Translator<'_>) -> Self {
        let mut registers = BTreeMap::new();
        let mut next = FIRST_REGISTER;
        for place in written(program) {
            registers.entry(place).or_insert_with(|| {
                let node = t.make.graph.node(NodeKind::Held(next));
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

/// Values computed by an instruction, and their destination slots.
pub(crate) struct MaskedInstruction {
    pub(crate) roots: Vec<NodeId>,
    pub(crate) to: Vec<Slot>,
    pub(crate) sampler: Option<usize>,
}

fn part(
    t: &mut Translator<'_>,
    instruction: &Instruction,
    registers: &BTreeMap<RegisterComponent, Slot>,
) -> MaskedInstruction {
    const MASK: Arith = Arith::Single;
    let active = t.make.graph.node(NodeKind::Held(ACTIVE));
    let mut part = MaskedInstruction { roots: Vec::new(), to: Vec::new(), sampler: None };
    if instruction.opcode.info().class == OpcodeClass::Flow {
        if matches!(instruction.opcode, Opcode::If | Opcode::IfC | Opcode::BreakC | Opcode::BreakP | Opcode::CallNz) {
            let condition = t.condition(instruction);
            part.roots.push(t.make.binary(MASK, Op::And, active, condition));
        }
        return part;
    }
    let mut effects = Vec::new();
    t.fetches.clear();
    translate_instruction(t, instruction, &mut effects);
    part.sampler = t.fetches.first().copied();
    for effect in effects {
        match effect {
            Effect::Write(place, value, predicate) => {
                let Some(&slot) = registers.get(&place) else { continue };
                let allowed = predicate.map_or(active, |p| t.make.binary(MASK, Op::And, active, p));
                let old = t.make.graph.node(NodeKind::Held(slot));
                part.roots.push(t.make.select(allowed, value, old));
                part.to.push(slot);
                if place.0 == RegisterFile::DepthOut {
                    let decided = t.make.graph.node(NodeKind::Held(DECIDED));
                    part.roots.push(t.make.binary(MASK, Op::Or, decided, allowed));
                    part.to.push(DECIDED);
                }
            }
            Effect::Kill(mask) => {
                // Masks of several components of one instruction are combined before they reach the slot.
                let killing = t.make.binary(MASK, Op::And, active, mask);
                let before = match part.to.iter().position(|&s| s == KILLED) {
                    Some(i) => part.roots[i],
                    None => t.make.graph.node(NodeKind::Held(KILLED)),
                };
                let all = t.make.binary(MASK, Op::Or, before, killing);
                match part.to.iter().position(|&s| s == KILLED) {
                    Some(i) => part.roots[i] = all,
                    None => {
                        part.roots.push(all);
                        part.to.push(KILLED);
                    }
                }
            }
            // In versions with flow control, only oDepth writes depth.
            Effect::Depth(..) => {}
        }
    }
    part
}
