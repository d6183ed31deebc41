//! Execution of a program with flow control: mask of active lanes, and the current instruction.

use refsim_lanes::{LANES, LaneRow, Slots};

use super::steps::{Surroundings, run_steps};
use crate::event::SAMPLERS;
use crate::exec::batch::schedule::{FlowPlan, PlannedInstruction};
use crate::exec::budget::MAX_LOOP_PASSES;
use crate::exec::lower::{ACTIVE, COUNTER, DECIDED, KILLED, TRUE};
use crate::isa::{Opcode, OpcodeClass};

enum OpenBlock {
    If { restore: Box<LaneRow>, otherwise: Box<LaneRow> },
    Loop { live: Box<LaneRow>, restore: Box<LaneRow>, left: i32, step: i32, outer: i32 },
    Call { restore: Box<LaneRow>, back: usize },
}

impl OpenBlock {
    fn masks(&mut self) -> impl Iterator<Item = &mut Box<LaneRow>> {
        let (restore, more) = match self {
            Self::If { restore, otherwise: more } | Self::Loop { restore, live: more, .. } => (restore, Some(more)),
            Self::Call { restore, .. } => (restore, None),
        };
        std::iter::once(restore).chain(more)
    }
}

/// An execution of a program over a batch.
pub(crate) struct FlowRun<'p> {
    plan: &'p FlowPlan,
    around: &'p Surroundings<'p>,
    run: &'p LaneRow,
    covered: &'p LaneRow,
    open: Vec<OpenBlock>,
    counter: i32,
    /// Instruction slots executed, in total over the lanes.
    pub(crate) executed: u64,
    /// Steps of each lane, if a budget is enforced.
    steps: Option<Box<LaneRow>>,
    /// Lanes stopped by the step budget, and the instruction before which each was stopped.
    pub(crate) cut: Vec<(usize, usize)>,
}

fn any(row: &LaneRow) -> bool {
    row.iter().any(|&m| m != 0)
}

fn remove(from: &mut LaneRow, lanes: &LaneRow) {
    for (a, &b) in from.iter_mut().zip(lanes) {
        *a &= !b;
    }
}

impl<'p> FlowRun<'p> {
    /// Creates an execution of the lanes in `run`; the lanes in `covered` are fragments (or vertices).
    pub(crate) fn new(
        plan: &'p FlowPlan,
        around: &'p Surroundings<'p>,
        run: &'p LaneRow,
        covered: &'p LaneRow,
    ) -> Self {
        let steps = plan.budget.map(|_| Box::new([0; LANES]));
        Self { plan, around, run, covered, open: Vec::new(), counter: 0, executed: 0, steps, cut: Vec::new() }
    }

    /// Executes the program to its end.
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
            self.charge(at, slots);
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
                // Swapping rows avoids copying them.
                for (&root, &to) in instruction.block.roots.iter().zip(&instruction.to) {
                    slots.swap(root, to);
                }
            }
            at += 1;
        }
    }

    /// Counts a step for every active lane before instruction `at`, and stops lanes whose budget is used up.
    fn charge(&mut self, at: usize, slots: &mut Slots) {
        let (Some(steps), Some(budget)) = (&mut self.steps, self.plan.budget) else { return };
        let mut cut = [0; LANES];
        // The mask of an active lane is all ones, or -1: subtracting it adds one.
        for ((count, &active), cut) in steps.iter_mut().zip(slots.row(ACTIVE)).zip(&mut cut) {
            *cut = if *count == budget { active } else { 0 };
            *count = count.wrapping_sub(active & !*cut);
        }
        if !any(&cut) {
            return;
        }
        remove(slots.row_mut(ACTIVE), &cut);
        self.open.iter_mut().flat_map(OpenBlock::masks).for_each(|mask| remove(mask, &cut));
        let lanes = cut.iter().zip(self.covered).enumerate();
        self.cut.extend(lanes.filter(|(_, (cut, covered))| **cut & **covered != 0).map(|(lane, _)| (lane, at)));
    }

    fn condition(&self, instruction: &PlannedInstruction, slots: &mut Slots) -> LaneRow {
        run_steps(&instruction.block.steps, self.around, self.run, slots);
        instruction.block.roots.first().map_or([0; LANES], |&root| *slots.row(root))
    }

    fn flow(&mut self, at: usize, instruction: &PlannedInstruction, slots: &mut Slots) -> Option<usize> {
        let target = self.plan.flow.target(at);
        match instruction.opcode {
            Opcode::If | Opcode::IfC => {
                let taken = self.condition(instruction, slots);
                let restore = Box::new(*slots.row(ACTIVE));
                let mut otherwise = restore.clone();
                remove(&mut otherwise, &taken);
                self.open.push(OpenBlock::If { restore, otherwise });
                *slots.row_mut(ACTIVE) = taken;
                Some(if any(&taken) { at + 1 } else { target })
            }
            Opcode::Else => {
                if let Some(OpenBlock::If { otherwise, .. }) = self.open.last() {
                    *slots.row_mut(ACTIVE) = **otherwise;
                }
                Some(if any(slots.row(ACTIVE)) { at + 1 } else { target })
            }
            Opcode::EndIf => {
                if let Some(OpenBlock::If { restore, .. }) = self.open.last() {
                    *slots.row_mut(ACTIVE) = **restore;
                    self.open.pop();
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
                self.open.push(OpenBlock::Call { restore: Box::new(*slots.row(ACTIVE)), back: at + 1 });
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

    fn enter_loop(&mut self, at: usize, target: usize, instruction: &PlannedInstruction, slots: &mut Slots) -> usize {
        let [count, start, step, _] = instruction.counter;
        let left = count.clamp(0, MAX_LOOP_PASSES);
        if left == 0 || !any(slots.row(ACTIVE)) {
            return target + 1;
        }
        let counted = instruction.opcode == Opcode::Loop;
        let active = Box::new(*slots.row(ACTIVE));
        let step = if counted { step } else { 0 };
        self.open.push(OpenBlock::Loop { live: active.clone(), restore: active, left, step, outer: self.counter });
        if counted {
            self.count_from(start, slots);
        }
        at + 1
    }

    fn end_pass(&mut self, at: usize, start: usize, slots: &mut Slots) -> usize {
        let Some(OpenBlock::Loop { live, restore, left, step, outer }) = self.open.last_mut() else {
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
        self.open.pop();
        self.count_from(outer, slots);
        at + 1
    }

    fn leave_loop(&mut self, lanes: &LaneRow, slots: &mut Slots) {
        let in_loop = self
            .open
            .iter()
            .rev()
            .take_while(|f| !matches!(f, OpenBlock::Call { .. }))
            .any(|f| matches!(f, OpenBlock::Loop { .. }));
        if !in_loop {
            return;
        }
        remove(slots.row_mut(ACTIVE), lanes);
        for block in self.open.iter_mut().rev() {
            match block {
                OpenBlock::If { restore, otherwise } => {
                    remove(restore, lanes);
                    remove(otherwise, lanes);
                }
                OpenBlock::Loop { live, .. } => {
                    remove(live, lanes);
                    return;
                }
                OpenBlock::Call { .. } => return,
            }
        }
    }

    fn ret(&mut self, at: usize, slots: &mut Slots) -> Option<usize> {
        match self.open.last() {
            None => return None,
            Some(OpenBlock::Call { .. }) => return self.return_from_call(slots),
            Some(_) => {}
        }
        let done = *slots.row(ACTIVE);
        slots.fill(ACTIVE, 0);
        let in_call = self.open.iter_mut().rev().take_while(|block| !matches!(block, OpenBlock::Call { .. }));
        in_call.flat_map(OpenBlock::masks).for_each(|mask| remove(mask, &done));
        Some(at + 1)
    }

    fn return_from_call(&mut self, slots: &mut Slots) -> Option<usize> {
        while let Some(block) = self.open.pop() {
            if let OpenBlock::Call { restore, back } = block {
                *slots.row_mut(ACTIVE) = *restore;
                return Some(back);
            }
        }
        None
    }
}

/// Fills the constants of a program with flow control, once for new slots.
pub(crate) fn fill_plan(plan: &FlowPlan, slots: &mut Slots) {
    for &(slot, raw) in &plan.constants {
        slots.fill(slot, raw);
    }
}

/// Mask of the first `count` lanes.
pub(crate) fn first_lanes(count: usize) -> LaneRow {
    std::array::from_fn(|i| if i < count { TRUE } else { 0 })
}
