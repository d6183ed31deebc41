//! One of the two sides of a comparison of traces.

use refsim::{
    asm,
    exec::ResolvedConstants,
    isa::{Program, Register},
    machine::FragmentTrace,
    num::Format,
};

/// One side's trace of a pixel, with the context needed to read it.
#[derive(Clone, Copy, Debug)]
pub struct TraceSide<'a> {
    /// Pixel program; both sides run the same text.
    pub program: &'a Program,
    /// Format of the program's registers.
    pub format: Format,
    /// Constants as this side's instructions read them.
    pub constants: &'a ResolvedConstants,
    /// Fragments of the pixel in order.
    pub fragments: &'a [FragmentTrace],
}

/// Name of a component of a register in program syntax.
pub fn component(program: &Program, register: &Register, component: usize) -> String {
    let name = asm::register_name(program, register);
    if register.file.is_scalar() {
        return name;
    }
    format!("{name}.{}", ['x', 'y', 'z', 'w'][component & 3])
}
