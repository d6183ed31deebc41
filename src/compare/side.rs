//! One side of a comparison of traces.

use refsim::{
    asm,
    exec::ResolvedConstants,
    isa::{Program, Register},
    machine::FragmentTrace,
    num::Format,
};

/// One side's trace of a pixel, and what is needed to read it.
#[derive(Clone, Copy, Debug)]
pub struct TraceSide<'a> {
    /// The pixel program; both sides run the same text.
    pub program: &'a Program,
    /// The format of its registers.
    pub format: Format,
    /// Its constants as this side's instructions read them.
    pub constants: &'a ResolvedConstants,
    /// The fragments of the pixel in order.
    pub fragments: &'a [FragmentTrace],
}

/// The name of a component of a register as programs write it.
pub fn component(program: &Program, register: &Register, component: usize) -> String {
    let name = asm::register_name(program, register);
    if register.file.is_scalar() {
        return name;
    }
    format!("{name}.{}", ['x', 'y', 'z', 'w'][component & 3])
}
