//! Flow control with lane masks and resolved jump targets.

use super::interpreter::{Interpreter, OpenBlock};
use crate::exec::Observer;
use crate::exec::budget::{MAX_LOOP_PASSES, loop_counter};
use crate::isa::{Instruction, Modifier, Opcode, RegisterFile, Source};

impl<O: Observer> Interpreter<'_, '_, O> {
    /// Executes the flow instruction `at`; returns the next instruction, or `None` if the program ends.
    pub(super) fn flow(&mut self, at: usize, instruction: &Instruction) -> Option<usize> {
        let target = self.prepared.flow.target(at);
        match instruction.opcode {
            Opcode::If | Opcode::IfC => {
                let taken = self.condition(instruction);
                let otherwise = self.active & !taken;
                self.open.push(OpenBlock::If { restore: self.active, otherwise });
                self.active = taken;
                Some(if taken == 0 { target } else { at + 1 })
            }
            Opcode::Else => {
                if let Some(OpenBlock::If { otherwise, .. }) = self.open.last() {
                    self.active = *otherwise;
                }
                Some(if self.active == 0 { target } else { at + 1 })
            }
            Opcode::EndIf => {
                if let Some(&OpenBlock::If { restore, .. }) = self.open.last() {
                    self.active = restore;
                    self.open.pop();
                }
                Some(at + 1)
            }
            Opcode::Rep | Opcode::Loop => Some(self.enter_loop(at, target, instruction)),
            Opcode::EndRep | Opcode::EndLoop => Some(self.end_pass(at, target)),
            Opcode::Break => {
                self.leave_loop(self.active);
                Some(at + 1)
            }
            Opcode::BreakC | Opcode::BreakP => {
                let leaving = self.condition(instruction);
                self.leave_loop(leaving);
                Some(at + 1)
            }
            Opcode::Call | Opcode::CallNz => Some(self.call(at, target, instruction)),
            Opcode::Ret => self.ret(at),
            // Reaching a label ends the preceding subroutine or the main program.
            Opcode::Label => self.return_from_call(),
            _ => Some(at + 1),
        }
    }

    fn condition(&mut self, instruction: &Instruction) -> u8 {
        let mut holds = 0;
        for lane in self.active_lanes() {
            let lane_holds = match instruction.opcode {
                Opcode::IfC | Opcode::BreakC => self.compare_sources(lane, instruction),
                Opcode::CallNz => instruction.sources.get(1).is_some_and(|s| self.boolean_value(lane, s)),
                _ => instruction.sources.first().is_some_and(|s| self.boolean_value(lane, s)),
            };
            holds |= u8::from(lane_holds) << lane;
        }
        holds
    }

    /// Value of a boolean operand: `b#` or a component of `p0`, possibly inverted.
    fn boolean_value(&self, lane: usize, source: &Source) -> bool {
        let value = match source.register.file {
            RegisterFile::Predicate => self.lanes[lane].predicate[usize::from(source.swizzle.0[0] & 3)],
            RegisterFile::ConstantBool => {
                let number = usize::from(source.register.index);
                self.prepared.constants.boolean.get(number).copied().unwrap_or(false)
            }
            _ => false,
        };
        value != (source.modifier == Modifier::Not)
    }

    fn enter_loop(&mut self, at: usize, target: usize, instruction: &Instruction) -> usize {
        let [count, start, step, _] = loop_counter(instruction, &self.prepared.constants);
        let left = count.clamp(0, MAX_LOOP_PASSES);
        if left == 0 || self.active == 0 {
            return target + 1;
        }
        let with_counter = instruction.opcode == Opcode::Loop;
        self.open.push(OpenBlock::Loop {
            live: self.active,
            restore: self.active,
            left,
            // `rep` does not change aL.
            step: if with_counter { step } else { 0 },
            outer_counter: self.loop_counter,
        });
        if with_counter {
            self.loop_counter = start;
        }
        at + 1
    }

    /// Executes `endrep` or `endloop` at `at`; the loop starts at `start`.
    fn end_pass(&mut self, at: usize, start: usize) -> usize {
        let Some(OpenBlock::Loop { live, restore, left, step, outer_counter }) = self.open.last_mut() else {
            return at + 1;
        };
        *left -= 1;
        if *left > 0 && *live != 0 {
            self.active = *live;
            self.loop_counter = self.loop_counter.wrapping_add(*step);
            return start + 1;
        }
        self.active = *restore;
        self.loop_counter = *outer_counter;
        self.open.pop();
        at + 1
    }

    /// Removes `lanes` from all open blocks up to and including the innermost loop.
    fn leave_loop(&mut self, lanes: u8) {
        // A `break` outside of a loop has no effect.
        let in_loop = self
            .open
            .iter()
            .rev()
            .take_while(|f| !matches!(f, OpenBlock::Call { .. }))
            .any(|f| matches!(f, OpenBlock::Loop { .. }));
        if !in_loop {
            return;
        }
        self.active &= !lanes;
        for block in self.open.iter_mut().rev() {
            match block {
                OpenBlock::If { restore, otherwise } => {
                    *restore &= !lanes;
                    *otherwise &= !lanes;
                }
                // The lanes leave the loop but rejoin after it, so `restore` keeps them.
                OpenBlock::Loop { live, .. } => {
                    *live &= !lanes;
                    return;
                }
                OpenBlock::Call { .. } => return,
            }
        }
    }

    /// `call`, `callnz`. As on the cards, calls only lead forward, so that every program ends; a backward call is
    /// skipped.
    fn call(&mut self, at: usize, target: usize, instruction: &Instruction) -> usize {
        let entering = match instruction.opcode {
            Opcode::CallNz => self.condition(instruction),
            _ => self.active,
        };
        if entering == 0 || target <= at || target >= self.prepared.program.instructions.len() {
            return at + 1;
        }
        self.open.push(OpenBlock::Call { restore: self.active, back: at + 1 });
        self.active = entering;
        target + 1
    }

    /// Counts a step for every active lane before instruction `at`, and stops lanes whose budget is used up.
    pub(super) fn charge(&mut self, at: usize, budget: u32) {
        let mut cut = 0;
        for lane in self.active_lanes() {
            if self.steps[lane] == budget {
                cut |= 1 << lane;
                self.cut_at[lane] = Some(at);
            } else {
                self.steps[lane] += 1;
            }
        }
        if cut == 0 {
            return;
        }
        // No open block may reactivate a stopped lane.
        self.active &= !cut;
        for block in &mut self.open {
            match block {
                OpenBlock::If { restore, otherwise } => {
                    *restore &= !cut;
                    *otherwise &= !cut;
                }
                OpenBlock::Loop { live, restore, .. } => {
                    *live &= !cut;
                    *restore &= !cut;
                }
                OpenBlock::Call { restore, .. } => *restore &= !cut,
            }
        }
    }

    /// `ret`: the active lanes leave the subroutine, or end the program.
    fn ret(&mut self, at: usize) -> Option<usize> {
        match self.open.last() {
            None => return None,
            Some(OpenBlock::Call { .. }) => return self.return_from_call(),
            Some(_) => {}
        }
        // No open block of the subroutine may reactivate a lane that has returned.
        let done = self.active;
        self.active = 0;
        for block in self.open.iter_mut().rev() {
            match block {
                OpenBlock::If { restore, otherwise } => {
                    *restore &= !done;
                    *otherwise &= !done;
                }
                OpenBlock::Loop { live, restore, .. } => {
                    *live &= !done;
                    *restore &= !done;
                }
                OpenBlock::Call { .. } => break,
            }
        }
        Some(at + 1)
    }

    /// Ends the innermost subroutine; returns the instruction after the call, or `None` in the main program.
    pub(super) fn return_from_call(&mut self) -> Option<usize> {
        while let Some(block) = self.open.pop() {
            if let OpenBlock::Call { restore, back } = block {
                self.active = restore;
                return Some(back);
            }
        }
        None
    }
}
