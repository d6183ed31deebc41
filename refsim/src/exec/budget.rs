//! The step budget: how many instructions one pixel or vertex may execute.
//!
//! A step is one instruction that a lane executes, flow control included; the two of a co-issued pair are one step,
//! `phase` is none. A lane that has used up its budget is cut off in front of its next instruction: it writes nothing
//! more and runs nothing more. What it computed is no result, so a fragment or vertex that is cut off is an
//! [`Overrun`]. A helper lane that is cut off is not: it is no fragment.
//!
//! Source: GL_NV_vertex_program2 and GL_NV_fragment_program2, which end a program after so many instructions "to
//! prevent hangs"; docs/decisions/0011.

use super::{FlowMap, ResolvedConstants};
use crate::isa::{Instruction, Opcode, OpcodeClass, Program};

/// Passes of a loop at most: the range of a card's loop counter. Larger counts are cut, negative ones are 0.
pub(crate) const MAX_LOOP_PASSES: i32 = 255;

/// A fragment that did not end within its step budget.
///
/// They order as they are reported: by the triangle, then by row, then by column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Overrun {
    /// The triangle, as the executor was given it.
    pub triangle: u32,
    /// Row of the pixel.
    pub y: u32,
    /// Column of the pixel.
    pub x: u32,
    /// The instruction that was one too many, from 0.
    pub instruction: usize,
}

/// The budget if the program may exceed it; `None` where every path is shorter and steps need not be counted.
pub(crate) fn enforced(program: &Program, flow: &FlowMap, constants: &ResolvedConstants, budget: u32) -> Option<u32> {
    (most_steps(program, flow, constants) > u64::from(budget)).then_some(budget)
}

/// Whether a program without flow control is longer than the step budget, so that every fragment or vertex exceeds it.
pub(crate) fn straight_exceeds(program: &Program, budget: u32) -> bool {
    let is_step = |at: usize| {
        let instruction = &program.instructions[at];
        instruction.opcode != Opcode::Phase && !is_partner(program, at)
    };
    let count = program.instructions.len();
    count > budget as usize && (0..count).filter(|&at| is_step(at)).count() > budget as usize
}

/// Whether an instruction is issued together with the one before it.
fn is_partner(program: &Program, at: usize) -> bool {
    let before = at.checked_sub(1).and_then(|before| program.instructions.get(before));
    program.instructions[at].coissue && before.is_some_and(|i| i.opcode.info().class == OpcodeClass::Arithmetic)
}

/// The steps of the longest way through a program, or more: branches on booleans count as if they could go either way,
/// and loops as if never left early. Exact for programs without flow control. One pass over the text.
pub(crate) fn most_steps(program: &Program, flow: &FlowMap, constants: &ResolvedConstants) -> u64 {
    let code = &program.instructions;
    // Calls lead forward, so subroutines are known before what calls them.
    let mut starts: Vec<usize> = (0..code.len()).filter(|&at| code[at].opcode == Opcode::Label).collect();
    let mut after = vec![0u64; code.len()];
    let mut end = code.len();
    while let Some(label) = starts.pop() {
        after[label] = of_section(program, label + 1..end, flow, constants, &after);
        end = label;
    }
    of_section(program, 0..end, flow, constants, &after)
}

/// An open block on the way through a section.
struct Open {
    /// Steps in front of it.
    before: u64,
    /// Passes, of a loop.
    passes: u64,
    /// Steps of the way through `if` where the walk is past `else`.
    taken: u64,
}

/// The most steps of the instructions `section`, given those of the subroutines behind them by their labels.
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
                    // `else` is a step of the lanes before it, `endif` of those in front of it.
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
    // Unclosed blocks: a checked program has none.
    open.iter().rev().fold(steps, |steps, block| block.before.saturating_add(steps))
}

/// The integer constant that a loop instruction counts by.
pub(crate) fn loop_counter(instruction: &Instruction, constants: &ResolvedConstants) -> [i32; 4] {
    let counter = match instruction.opcode {
        Opcode::Loop => instruction.sources.get(1),
        _ => instruction.sources.first(),
    };
    let number = counter.map_or(usize::MAX, |s| usize::from(s.register.index));
    constants.int.get(number).copied().unwrap_or_default()
}
