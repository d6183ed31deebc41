//! Decodes the records of a traced lane.

use crate::device::Rules;
use crate::exec::lower::{Arith, Formats, of_file};
use crate::exec::trace::as_written;
use crate::exec::usage::registers_delivered;
use crate::exec::{CheckedProgram, Step, program};
use crate::isa::{Mask, Register, RegisterFile};
use crate::num::{Flags, ops};

/// Words per executed instruction: its index, the components written, four raw values. Records of input registers come
/// first, with indices after those of the instructions.
pub const TRACE_WORDS: usize = 6;

/// Decodes the steps of a lane (0 to 3) from the `q_traced` words recorded by a traced shader
/// ([`super::PixelShader::new`]), in the form of [`crate::exec::Shading`].
pub fn trace_steps(words: &[u32], checked: &CheckedProgram, rules: &Rules, lane: usize) -> Vec<Step> {
    let source = program(checked);
    let formats = Formats::pixel(source, rules);
    let fragment = source.version.is_fragment_program();
    let step = |words: &[u32]| {
        let (instruction, mask) = (words[0] as usize, Mask((words[1] & 15) as u8));
        let destination = source.instructions.get(instruction).and_then(|i| i.destination);
        let arith = destination.map_or(Arith::Main, |d| of_file(d.register.file));
        let format = formats.format(arith);
        let is_predicate = destination.is_some_and(|d| d.register.file == RegisterFile::Predicate);
        let value = [2, 3, 4, 5].map(|i| match words[i] {
            raw if is_predicate => u32::from(raw != 0),
            // A packed word is shown as the number that it encodes.
            raw if fragment => ops::convert(&format, format, formats.encode(arith, raw)).bits,
            raw => formats.encode(arith, raw),
        });
        as_written(Step { instruction, lane, mask, value, flags: Flags::empty() }, source)
    };
    let told = words.chunks_exact(TRACE_WORDS);
    told.filter(|words| (words[0] as usize) < source.instructions.len()).map(step).collect()
}

/// Decodes the input registers, as read by instructions, from the same words.
pub fn trace_delivered(words: &[u32], checked: &CheckedProgram, rules: &Rules) -> Vec<(Register, [u32; 4])> {
    let source = program(checked);
    let formats = Formats::pixel(source, rules);
    let first = source.instructions.len();
    let told = |at: usize| words.chunks_exact(TRACE_WORDS).find(|words| words[0] as usize == at);
    let registers = (first..).zip(registers_delivered(source));
    registers
        .filter_map(|(at, register)| {
            told(at).map(|words| (register, [2, 3, 4, 5].map(|i| formats.encode(Arith::Main, words[i]))))
        })
        .collect()
}
