//! Flow control as microcode.

use super::assembler::{Assembler, NONE};
use super::lower::{ACTIVE_SLOT, MaskedStep, Sink, SinkKind};
use super::operations as op;
use crate::exec::budget::MAX_LOOP_PASSES;
use crate::isa::{Opcode, OpcodeClass};

impl Assembler<'_> {
    /// Encodes the instructions in order and resolves jumps.
    pub(super) fn steps(&mut self, steps: &[MaskedStep]) {
        let (mut starts, mut jumps) = (Vec::with_capacity(steps.len()), Vec::new());
        for (at, step) in steps.iter().enumerate() {
            starts.push(self.words.len() as u32);
            let sampler = step.sampler.map_or(u32::from(NONE), |s| s as u32);
            let enter = self.words.len();
            self.push(op::STEP, 0);
            self.words.extend([0, sampler]);
            let places = self.block(&step.sinks);
            let condition = match step.sinks.first() {
                Some(Sink { what: SinkKind::Condition, nodes }) => places.of(nodes[0]),
                _ => ACTIVE_SLOT,
            };
            if let Some((jump, to)) = self.flow(step, at, steps.len(), condition) {
                jumps.push((jump, to));
                self.words[enter + 1] = enter as u32 + 3;
            } else if is_flow(step.opcode) {
                self.words[enter + 1] = enter as u32 + 3;
            } else {
                self.words[enter + 1] = self.words.len() as u32;
            }
        }
        starts.push(self.words.len() as u32);
        self.push(op::LABEL, 0);
        self.words.extend([0, 0]);
        for (word, to) in jumps {
            self.words[word] = starts[to.min(steps.len())];
        }
    }

    /// Encodes the flow control of an instruction; returns the index of the word for its target, and the target
    /// instruction.
    fn flow(&mut self, step: &MaskedStep, at: usize, count: usize, condition: u16) -> Option<(usize, usize)> {
        let target_word = self.words.len() + 1;
        let mut emit = |op: u32| {
            self.push(op, 0);
            self.words.extend([0, condition.into()]);
        };
        match step.opcode {
            Opcode::If | Opcode::IfC => emit(op::IF),
            Opcode::Else => emit(op::ELSE),
            Opcode::EndIf => {
                emit(op::END_IF);
                return None;
            }
            Opcode::Rep | Opcode::Loop => {
                let counted = step.opcode == Opcode::Loop;
                let [passes, start, grows, _] = step.counter;
                let grows = if counted { grows } else { 0 };
                let passes = passes.clamp(0, MAX_LOOP_PASSES).cast_unsigned();
                self.push(op::LOOP, 0);
                self.words.extend([0, passes, start.cast_unsigned(), grows.cast_unsigned(), counted.into()]);
                return Some((target_word, step.target + 1));
            }
            Opcode::EndRep | Opcode::EndLoop => {
                emit(op::END_LOOP);
                return Some((target_word, step.target + 1));
            }
            Opcode::Break | Opcode::BreakC | Opcode::BreakP => {
                emit(op::BREAK);
                return None;
            }
            Opcode::Call | Opcode::CallNz => {
                emit(op::CALL);
                // A backward call, or a call without a label, is skipped.
                let forward = step.target > at && step.target < count;
                return forward.then_some((target_word, step.target + 1));
            }
            Opcode::Ret => {
                emit(op::RET);
                return None;
            }
            Opcode::Label => {
                emit(op::LABEL);
                return None;
            }
            _ => return None,
        }
        Some((target_word, step.target))
    }
}

fn is_flow(opcode: Opcode) -> bool {
    opcode.info().class == OpcodeClass::Flow
}

/// Maximum number of simultaneously open blocks and calls.
pub(super) fn deepest(steps: &[MaskedStep]) -> usize {
    // Calls lead forward, so going backward, a subroutine's depth is known before its callers'.
    let mut needs = vec![0; steps.len() + 1];
    let mut most = 0;
    for start in (0..=steps.len()).rev() {
        let begins = start == 0 || matches!(steps.get(start - 1), Some(s) if s.opcode == Opcode::Label);
        if !begins {
            continue;
        }
        let (mut open, mut need) = (0usize, 0usize);
        for (at, step) in steps.iter().enumerate().skip(start) {
            match step.opcode {
                Opcode::Label => break,
                Opcode::If | Opcode::IfC | Opcode::Rep | Opcode::Loop => open += 1,
                Opcode::EndIf | Opcode::EndRep | Opcode::EndLoop => open = open.saturating_sub(1),
                Opcode::Call | Opcode::CallNz if step.target > at && step.target < steps.len() => {
                    need = need.max(open + 1 + needs[step.target + 1]);
                }
                _ => {}
            }
            need = need.max(open);
        }
        needs[start] = need;
        most = most.max(need);
    }
    most
}
