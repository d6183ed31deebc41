//! Inputs and outputs of a program, found from its text; shared by the executors.

use crate::isa::{Opcode, Program, Register, RegisterFile};
use crate::raster::{COLOR_COMPONENT, ComponentMask, FOG_COMPONENT, POSITION_COMPONENT, TEXCOORD_COMPONENT};

/// Components that a pixel program can read, including the window position. Other components need not be interpolated.
pub fn inputs_read(program: &Program) -> ComponentMask {
    let mut mask = ComponentMask::NONE;
    let mut set = |number: u16| {
        if number < 8 {
            mask = mask.with_texcoord(usize::from(number));
        }
    };
    let mut colors = [false; 2];
    let mut fog = false;
    let mut position = false;
    for instruction in &program.instructions {
        let registers = instruction.sources.iter().map(|s| s.register);
        for register in registers.chain(instruction.destination.map(|d| d.register)) {
            match register.file {
                RegisterFile::Texture => set(register.index),
                RegisterFile::FogIn => fog = true,
                RegisterFile::WindowPosition => position = true,
                RegisterFile::Input => {
                    if let Some(color) = colors.get_mut(usize::from(register.index)) {
                        *color = true;
                    }
                }
                _ => {}
            }
        }
        // The eye ray is in the fourth components of this stage and the two previous stages.
        if let (Opcode::TexM3x3VSpec, Some(destination)) = (instruction.opcode, instruction.destination) {
            set(destination.register.index.saturating_sub(1));
            set(destination.register.index.saturating_sub(2));
        }
    }
    for (number, read) in colors.into_iter().enumerate() {
        if read {
            mask = mask.with_color(number);
        }
    }
    if fog {
        mask = mask.with(FOG_COMPONENT);
    }
    if position { mask.with_position() } else { mask }
}

/// Input registers whose values a pixel program reads in the register format.
pub(crate) fn registers_delivered(program: &Program) -> Vec<Register> {
    let reads = inputs_read(program);
    let colors = (0u16..2).map(|n| (RegisterFile::Input, n, COLOR_COMPONENT + 4 * usize::from(n)));
    let sets = (0u16..8).filter(|_| program.version.reads_coordinates());
    let sets = sets.map(|n| (RegisterFile::Texture, n, TEXCOORD_COMPONENT + 4 * usize::from(n)));
    let others = [(RegisterFile::FogIn, 0, FOG_COMPONENT), (RegisterFile::WindowPosition, 0, POSITION_COMPONENT)];
    let all = colors.chain(sets).chain(others);
    all.filter(|&(_, _, first)| reads.has(first)).map(|(file, n, _)| Register::new(file, n)).collect()
}

/// Colours that a pixel program writes: bit `i` for `oC#i`. A colour counts as written even if flow control skips the
/// instruction that writes it. ps_1_x writes colour 0.
pub fn colors_written(program: &Program) -> u8 {
    if program.version.is_ps_1_x() {
        return 1;
    }
    let destinations = program.instructions.iter().filter_map(|i| i.destination);
    destinations
        .filter(|d| {
            matches!(d.register.file, RegisterFile::ColorOut | RegisterFile::HalfColorOut) && d.register.index < 4
        })
        .fold(0, |written, d| written | 1 << d.register.index)
}
