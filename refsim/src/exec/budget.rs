//! The step budget: the maximum number of instructions executed per pixel or vertex, as in GL_NV_vertex_program2 and
//! GL_NV_fragment_program2.
//!
//! A step is one instruction executed by a lane, flow control included. A co-issued pair is one step; `phase` counts 0.
//! A lane that has used up its budget is stopped before its next instruction. A stopped fragment or vertex is an error
//! ([`Overrun`]); a stopped helper lane is not.

use super::{FlowMap, ResolvedConstants};
use crate::isa::{Instruction, Opcode, OpcodeClass, Program};

/// Maximum number of loop iterations: the range of a card's loop counter. Larger counts are clamped; negative counts
/// become 0.
pub(crate) const MAX_LOOP_PASSES: i32 = 255;

/// A fragment that exceeded its step budget.
///
/// Ordered by triangle, then row, then column; a draw reports the first overrun.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Overrun {
    /// Index of the triangle, as passed to the executor.
    pub triangle: u32,
    /// Row of the pixel.
    pub y: u32,
    /// Column of the pixel.
    pub x: u32,
    /// Index of the first instruction beyond the budget, from 0.
    pub instruction: usize,
}

/// Returns the budget if the program may exceed it; `None` if every path is shorter and steps need not be counted.
pub(crate) fn enforced(program: &Program, flow: &FlowMap, constants: &ResolvedConstants, budget: u32) -> Option<u32> {
    (most_steps(program, flow, constants) > u64::from(budget)).then_some(budget)
}

/// Returns `true` if a program without flow control is longer than the budget, so that every invocation exceeds it.
pub(crate) fn straight_exceeds(program: &Program, budget: u32) -> bool {
    let is_step = |at: usize| {
        let instruction = &program.instructions[at];
        instruction.opcode != Opcode::Phase && !is_partner(program, at)
    };
    let count = program.instructions.len();
    count > budget as usize && (0..count).filter(|&at| is_step(at)).count() > budget as usize
}

/// Returns `true` if an instruction is co-issued with the previous instruction.
fn is_partner(program: &Program, at: usize) -> bool {
    let before = at.checked_sub(1).and_then(|before| program.instructions.get(before));
    program.instructions[at].coissue && before.is_some_and(|i| i.opcode.info().class == OpcodeClass::Arithmetic)
}

/// Upper bound on the steps of a program: the longer branch counts, and no loop ends early. Exact for programs
/// without flow control. Takes one pass over the text.
pub(crate) fn most_steps(program: &Program, flow: &FlowMap, constants: &ResolvedConstants) -> u64 {
    let code = &program.instructions;
    // Calls lead forward, so processing the labels backward visits every callee before its callers.
    let mut starts: Vec<usize> = (0..code.len()).filter(|&at| code[at].opcode == Opcode::Label).collect();
    let mut after = vec![0u64; code.len()];
    let mut end = code.len();
    while let Some(label) = starts.pop() {
        after[label] = of_section(program, label + 1..end, flow, constants, &after);
        end = label;
    }
    of_section(program, 0..end, flow, constants, &after)
}

struct Open {
    before: u64,
    /// Number of iterations; 1 for blocks that are not loops.
    passes: u64,
    /// Steps of the `if` branch, set at `else`.
    taken: u64,
}

/// Upper bound on the steps of `section`, given the bounds of later subroutines by label.
fn of_section(
    program: &Program,
    section: std::ops::Range<usize>,
    flow: &FlowMap,
    constants: &ResolvedConstants,
    subroutines: &[u64],
) -> u64 {
    let (mut steps, mut open) = (0u64, Vec::<Open>::new());
    for at in section {
        let instruction = &program.instructions[at];
        if instruction.opcode != Opcode::Phase && !is_partner(program, at) {
            steps = steps.saturating_add(1);
        }
        match instruction.opcode {
            Opcode::If | Opcode::IfC => open.push(Open { before: std::mem::take(&mut steps), passes: 1, taken: 0 }),
            Opcode::Rep | Opcode::Loop => {
                let passes =
                    u64::from(loop_counter(instruction, constants)[0].clamp(0, MAX_LOOP_PASSES).unsigned_abs());
                open.push(Open { before: std::mem::take(&mut steps), passes, taken: 0 });
            }
            Opcode::Else => {
                if let Some(block) = open.last_mut() {
                    block.taken = std::mem::take(&mut steps);
                }
            }
            Opcode::EndIf | Opcode::EndRep | Opcode::EndLoop => {
                if let Some(block) = open.pop() {
                    // `else` is a step of the lanes in the `if` branch, `endif` a step of the lanes that reach it.
                    let inside = steps.max(block.taken).saturating_mul(block.passes);
                    steps = block.before.saturating_add(inside);
                }
            }
            Opcode::Call | Opcode::CallNz => {
                let target = flow.target(at);
                if target > at {
                    steps = steps.saturating_add(subroutines.get(target).copied().unwrap_or_default());
                }
            }
            _ => {}
        }
    }
    // Unclosed blocks don't occur in checked programs.
    open.iter().rev().fold(steps, |steps, block| block.before.saturating_add(steps))
}

/// Integer constant of a loop instruction: count, start, step.
pub(crate) fn loop_counter(instruction: &Instruction, constants: &ResolvedConstants) -> [i32; 4] {
    let counter = match instruction.opcode {
        Opcode::Loop => instruction.sources.get(1),
        _ => instruction.sources.first(),
    };
    let number = counter.map_or(usize::MAX, |s| usize::from(s.register.index));
    constants.int.get(number).copied().unwrap_or_default()
}
