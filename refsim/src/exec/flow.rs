//! The jump structure of a program, resolved once and shared by the executors.

use std::collections::BTreeMap;

use crate::isa::{Opcode, Program};

/// Where each instruction of a program leads.
///
/// Matching is by nesting alone. A checked program nests properly; were one not to, an unmatched jump leads to the
/// end of the program, so that executors need no error path.
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
        // The first label of a number counts.
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

    /// Where instruction `at` leads: from `if` to its `else` or `endif`, from `else` to its `endif`, from `rep` and
    /// `loop` to their end and back, from a call to its label. The length of the program for everything else.
    pub fn target(&self, at: usize) -> usize {
        self.targets.get(at).copied().unwrap_or(self.targets.len())
    }

    /// Whether instruction `at + 1` is issued together with instruction `at`.
    pub fn pairs_with_next(&self, at: usize) -> bool {
        self.coissued.get(at + 1).copied().unwrap_or(false)
    }

    /// Where the main program ends: at its first label, or with its text.
    pub fn main_end(&self) -> usize {
        self.main_end
    }
}
