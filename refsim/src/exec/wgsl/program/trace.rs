//! What a followed lane put down, as steps.

use crate::device::Rules;
use crate::exec::batch::graph::Arith;
use crate::exec::batch::program::pixel_formats;
use crate::exec::trace::as_written;
use crate::exec::{CheckedProgram, Step, program};
use crate::isa::{Mask, RegisterFile};
use crate::num::Flags;

/// Words that an executed instruction puts down: its number, the components written, four raw values.
pub const TRACE_WORDS: usize = 6;

/// The steps of a lane (0 to 3) out of the `q_traced` words that a shader made by [`super::PixelShader::traced`] put down,
/// as [`crate::exec::Shading`] holds them.
pub fn trace_steps(words: &[u32], checked: &CheckedProgram, rules: &Rules, lane: usize) -> Vec<Step> {
    let source = program(checked);
    let Some(formats) = pixel_formats(rules) else { return Vec::new() };
    let main = formats.lane(Arith::Main);
    let step = |words: &[u32]| {
        let (instruction, mask) = (words[0] as usize, Mask((words[1] & 15) as u8));
        let destination = source.instructions.get(instruction).and_then(|i| i.destination);
        let is_predicate = destination.is_some_and(|d| d.register.file == RegisterFile::Predicate);
        let value = [2, 3, 4, 5].map(|i| match words[i] {
            raw if is_predicate => u32::from(raw != 0),
            raw => main.encode(raw),
        });
        as_written(Step { instruction, lane, mask, value, flags: Flags::empty() }, source)
    };
    words.chunks_exact(TRACE_WORDS).map(step).collect()
}
