//! Operands of an instruction, reconstructed from the earlier steps of its trace.

use std::collections::BTreeMap;

use refsim::{
    exec::Step,
    isa::{Instruction, Opcode, OpcodeClass, Program, Register, RegisterFile, Source, Stage, Version},
    machine::FragmentTrace,
    num::Format,
};

use super::{
    number::{Compared, Number},
    side::{TraceSide, component},
};

/// Register that an instruction read, with its value on each side before swizzle and modifier.
#[derive(Clone, Debug, PartialEq)]
pub struct Operand {
    /// The register's four components.
    pub values: Vec<Compared>,
    /// `true` if a component differs between the sides.
    pub differs: bool,
}

/// Returns the registers read by step `k` of two traces that agree in all earlier steps. Registers without numbers are
/// omitted.
pub(super) fn operands(
    left: (&TraceSide<'_>, &FragmentTrace),
    right: (&TraceSide<'_>, &FragmentTrace),
    k: usize,
) -> Vec<Operand> {
    let program = left.0.program;
    let Some(instruction) = left.1.shading.steps.get(k).and_then(|step| program.instructions.get(step.instruction))
    else {
        return Vec::new();
    };
    let states = [left, right].map(|(side, fragment)| RegisterValues::before(side, fragment, k));
    registers_read(instruction)
        .into_iter()
        .filter_map(|register| {
            let single = reads_coordinates(program.version, instruction, &register);
            let [a, b] = [(left, &states[0]), (right, &states[1])].map(|((side, fragment), state)| {
                if single {
                    let set = fragment.shading.input.t.get(usize::from(register.index)).copied();
                    return set.map(|set| set.map(|bits| Number { format: Format::FP32, bits }));
                }
                state.value(side, &register).map(|v| v.map(|bits| Number { format: side.format, bits }))
            });
            let (a, b) = (a?, b?);
            let values = [0, 1, 2, 3].map(|c| Compared::registers(component(program, &register, c), &a[c], &b[c]));
            let differs = a.iter().zip(&b).any(|(a, b)| !a.equals(b));
            Some(Operand { values: values.into(), differs })
        })
        .collect()
}

fn registers_read(instruction: &Instruction) -> Vec<Register> {
    let rows = instruction.opcode.matrix().map_or(1, |(rows, _)| rows);
    let mut registers = Vec::new();
    for (place, Source { register, .. }) in instruction.sources.iter().enumerate() {
        for row in 0..if place == 1 { rows } else { 1 } {
            let register = Register { index: register.index.saturating_add(row), ..*register };
            if register.relative.is_none() && !registers.contains(&register) {
                registers.push(register);
            }
        }
    }
    registers
}

/// Returns `true` if a register is read as interpolated, before conversion to the register format.
fn reads_coordinates(version: Version, instruction: &Instruction, register: &Register) -> bool {
    let coordinates = version == Version::Ps1_4 || version.is_ps_2();
    let texture = instruction.opcode.info().class == OpcodeClass::Texture;
    coordinates && texture && register.file == RegisterFile::Texture && version.stage() == Stage::Pixel
}

/// Registers of a lane before an instruction.
struct RegisterValues(BTreeMap<(RegisterFile, u16), [u32; 4]>);

impl RegisterValues {
    fn before(side: &TraceSide<'_>, fragment: &FragmentTrace, k: usize) -> Self {
        let shading = &fragment.shading;
        let delivered = shading.delivered.iter().map(|(register, value)| ((register.file, register.index), *value));
        let mut state = Self(delivered.collect());
        let steps = &shading.steps[..k.min(shading.steps.len())];
        let at = shading.steps.get(k).map_or(usize::MAX, |step| step.instruction);
        // The second instruction of a co-issued pair reads the registers as they were before the pair.
        let paired = side.program.instructions.get(at).is_some_and(|i| i.coissue);
        let steps = if paired { &steps[..steps.len().saturating_sub(1)] } else { steps };
        let phase = side.program.phase_marker();
        let crosses = |from: usize, to: usize| phase.is_some_and(|phase| from < phase && phase < to);
        for (i, step) in steps.iter().enumerate() {
            state.write(side.program, step);
            let next = steps.get(i + 1).map_or(at, |next| next.instruction);
            if crosses(step.instruction, next) {
                state.phase();
            }
        }
        state
    }

    fn write(&mut self, program: &Program, step: &Step) {
        let Some(instruction) = program.instructions.get(step.instruction) else { return };
        let Some(destination) = instruction.destination.filter(|_| instruction.opcode != Opcode::Setp) else { return };
        let register = self.0.entry((destination.register.file, destination.register.index)).or_default();
        for c in step.mask.components() {
            register[c] = step.value[c];
        }
    }

    /// Executes the `phase` instruction, which clears the alpha of the temporaries.
    fn phase(&mut self) {
        for ((file, _), value) in &mut self.0 {
            if *file == RegisterFile::Temp {
                value[3] = 0;
            }
        }
    }

    fn value(&self, side: &TraceSide<'_>, register: &Register) -> Option<[u32; 4]> {
        match register.file {
            RegisterFile::Constant => {
                Some(side.constants.float.get(usize::from(register.index)).copied().unwrap_or_default())
            }
            RegisterFile::Temp | RegisterFile::Input | RegisterFile::Texture => {
                Some(self.0.get(&(register.file, register.index)).copied().unwrap_or_default())
            }
            _ => None,
        }
    }
}
