//! Translation of pixel programs without flow control, and of single instructions of any program.

use super::graph::{Arith, NodeId};
use super::translate::{Effect, Translator};
use crate::device::Storage;
use crate::isa::{Instruction, Opcode, OpcodeClass, Program, RegisterFile};
use crate::num::NumberOperation as Op;

/// Outputs of a straight-line pixel program.
#[derive(Debug)]
pub(crate) struct Ends {
    pub(crate) colors: [Option<[NodeId; 4]>; 4],
    pub(crate) killed: Option<NodeId>,
    pub(crate) depth: Option<(Arith, NodeId)>,
}

/// Returns `true` if a program needs lane masks and registers in memory.
pub(crate) fn has_flow(program: &Program) -> bool {
    program
        .instructions
        .iter()
        .any(|i| i.opcode.info().class == OpcodeClass::Flow || i.predicate.is_some() || i.opcode == Opcode::Setp)
}

impl Ends {
    /// The output values.
    pub(crate) fn roots(&self) -> Vec<NodeId> {
        self.colors.iter().flatten().flatten().copied().chain(self.killed).chain(self.depth.map(|d| d.1)).collect()
    }
}

/// Translates a straight-line vertex program; its registers hold the results.
pub(crate) fn translate_straight_vertex(t: &mut Translator<'_>, program: &Program) {
    for instruction in &program.instructions {
        let mut effects = Vec::new();
        translate_instruction(t, instruction, &mut effects);
        for effect in effects {
            if let Effect::Write(place, value, _) = effect {
                t.registers.insert(place, value);
            }
        }
    }
}

/// Translates a straight-line pixel program; `visit` receives the effects of each instruction.
pub(crate) fn translate_straight(
    t: &mut Translator<'_>,
    program: &Program,
    mut visit: impl FnMut(usize, &[Effect]),
) -> Ends {
    let mut killed: Option<NodeId> = None;
    let mut depth: Option<(Arith, NodeId)> = None;
    let mut at = 0;
    while let Some(instruction) = program.instructions.get(at) {
        let pair = program.instructions.get(at + 1).filter(|i| i.coissue && is_arithmetic(instruction));
        let mut effects = Vec::new();
        translate_instruction(t, instruction, &mut effects);
        visit(at, &effects);
        if let Some(partner) = pair {
            // Both instructions read the state before the pair.
            let first = effects.len();
            translate_instruction(t, partner, &mut effects);
            visit(at + 1, effects.get(first..).unwrap_or_default());
        }
        at += if pair.is_some() { 2 } else { 1 };
        for effect in effects {
            match effect {
                Effect::Write(place, value, _) => {
                    t.registers.insert(place, value);
                }
                Effect::Kill(mask) => {
                    killed = Some(killed.map_or(mask, |k| t.make.binary(Arith::Single, Op::Or, k, mask)));
                }
                Effect::Depth(arith, value) => depth = Some((arith, value)),
            }
        }
    }
    let colors = final_colors(t, program);
    let own = t.registers.get(&(RegisterFile::DepthOut, 0, 0)).map(|&n| (Arith::Main, n));
    Ends { colors, killed, depth: depth.or(own) }
}

fn is_arithmetic(instruction: &Instruction) -> bool {
    instruction.opcode.info().class == OpcodeClass::Arithmetic
}

pub(crate) fn translate_instruction(t: &mut Translator<'_>, instruction: &Instruction, effects: &mut Vec<Effect>) {
    if t.program.version.is_fragment_program() {
        return t.fragment(instruction, effects);
    }
    match instruction.opcode.info().class {
        OpcodeClass::Arithmetic => t.arithmetic(instruction, effects),
        OpcodeClass::Texture => t.texture(instruction, effects),
        OpcodeClass::Marker if instruction.opcode == Opcode::Phase => {
            // `phase` clears alpha: zero.
            t.registers.retain(|&(file, _, component), _| file != RegisterFile::Temp || component != 3);
        }
        OpcodeClass::Marker | OpcodeClass::Flow => {}
    }
}

fn final_colors(t: &mut Translator<'_>, program: &Program) -> [Option<[NodeId; 4]>; 4] {
    let zero = t.make.zero();
    let mut colors = [None; 4];
    if program.version.is_ps_1_x() {
        colors[0] = Some(std::array::from_fn(|c| {
            let value = t.registers.get(&(RegisterFile::Temp, 0, c as u8)).copied().unwrap_or(zero);
            let clamped = t.make.unary(Arith::Main, Op::Saturate, value);
            t.make.stored(Arith::Main, t.make.rules.storage.of(Storage::Outputs), clamped)
        }));
        return colors;
    }
    if program.version.is_fragment_program() {
        let half = |i: &Instruction| i.destination.is_some_and(|d| d.register.file == RegisterFile::HalfColorOut);
        colors[0] = Some(t.fragment_color(program.instructions.iter().any(half)));
        return colors;
    }
    let written = crate::exec::colors_written(program);
    for (i, slot) in colors.iter_mut().enumerate() {
        // The alpha test needs colour 0 even if the program doesn't write it.
        if i == 0 || written >> i & 1 == 1 {
            *slot = Some(std::array::from_fn(|c| {
                t.registers.get(&(RegisterFile::ColorOut, i as u16, c as u8)).copied().unwrap_or(zero)
            }));
        }
    }
    colors
}
