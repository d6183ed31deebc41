//! Jump targets of a program, resolved once and shared by the executors.

use std::collections::BTreeMap;

use crate::isa::{Opcode, Program};

/// Jump target of each instruction of a program.
///
/// Blocks are matched by nesting. Checked programs always match; an unmatched jump would lead to the end of the
/// program, so executors need no error handling.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FlowMap {
    targets: Vec<usize>,
    coissued: Vec<bool>,
    main_end: usize,
}

impl FlowMap {
    /// Resolves the jumps of `program`.
    pub fn new(program: &Program) -> Self {
        let code = &program.instructions;
        let end = code.len();
        let mut targets = vec![end; end];
        let mut open: Vec<usize> = Vec::new();
        // If several labels are equal, the first one is used.
        let labels = code.iter().enumerate().rev().filter(|(_, i)| i.opcode == Opcode::Label);
        let labels: BTreeMap<_, _> = labels.map(|(at, i)| (i.sources.first().map(|s| s.register.index), at)).collect();
        for (at, instruction) in code.iter().enumerate() {
            match instruction.opcode {
                Opcode::If | Opcode::IfC | Opcode::Rep | Opcode::Loop => open.push(at),
                Opcode::Else => {
                    if let Some(start) = open.pop() {
                        targets[start] = at;
                    }
                    open.push(at);
                }
                Opcode::EndIf => {
                    if let Some(start) = open.pop() {
                        targets[start] = at;
                    }
                }
                Opcode::EndRep | Opcode::EndLoop => {
                    if let Some(start) = open.pop() {
                        targets[start] = at;
                        targets[at] = start;
                    }
                }
                Opcode::Call | Opcode::CallNz => {
                    let label = instruction.sources.first().map(|s| s.register.index);
                    targets[at] = labels.get(&label).copied().unwrap_or(end);
                }
                _ => {}
            }
        }
        let coissued = code.iter().map(|i| i.coissue).collect();
        let main_end = code.iter().position(|i| i.opcode == Opcode::Label).unwrap_or(end);
        Self { targets, coissued, main_end }
    }

    /// Jump target of instruction `at`: from `if` to its `else` or `endif`, from `else` to its `endif`, from `rep` and
    /// `loop` to their end and back, from a call to its label. The length of the program for all other instructions.
    pub fn target(&self, at: usize) -> usize {
        self.targets.get(at).copied().unwrap_or(self.targets.len())
    }

    /// Returns `true` if instruction `at + 1` is co-issued with instruction `at`.
    pub fn pairs_with_next(&self, at: usize) -> bool {
        self.coissued.get(at + 1).copied().unwrap_or(false)
    }

    /// End of the main program: the first label, or the end of the text.
    pub fn main_end(&self) -> usize {
        self.main_end
    }
}
