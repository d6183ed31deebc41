//! Number formats of single instructions: a device of mixed precision.

use std::collections::BTreeMap;

use crate::isa::{Instruction, Program, RegisterFile, ResultKind};
use crate::num::Format;

/// Largest number of different formats that instructions of one program may have.
pub const MAX_INSTRUCTION_FORMATS: usize = 32;

/// Number formats of instructions, by [`Program::digest`] and the instruction's index in the program.
///
/// [`crate::check`] copies them to the instructions of a program, after the expansion of fog options; executors read
/// them from the instructions.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct InstructionFormats(BTreeMap<u64, BTreeMap<usize, Format>>);

/// Returns `true` if an instruction can have its own format: if it writes numbers to a register. Kills, flow control,
/// matrix rows for a later texture read, depth from texture coordinates, packing, and writes of addresses cannot.
pub fn takes_format(instruction: &Instruction) -> bool {
    matches!(instruction.opcode.info().result, ResultKind::Numbers | ResultKind::Texel)
        && instruction.destination.is_some_and(|destination| destination.register.file != RegisterFile::Address)
}

/// Returns `true` if a program has this instruction and it can have its own format.
fn takes(program: &Program, index: usize) -> bool {
    program.instructions.get(index).is_some_and(takes_format)
}

impl InstructionFormats {
    /// Sets or removes the format of an instruction, as [`super::Profile::set_instruction_format`] describes.
    pub(super) fn set(&mut self, program: &Program, index: usize, format: Option<Format>) -> bool {
        if !takes(program, index) || format.is_some_and(|f| f.for_registers().is_err()) {
            return false;
        }
        let digest = program.digest();
        let mut formats = self.0.get(&digest).cloned().unwrap_or_default();
        match format {
            Some(format) => formats.insert(index, format),
            None => formats.remove(&index),
        };
        self.insert(digest, formats)
    }

    /// Replaces the formats of a program's instructions. Returns `false`, without effect, if [`Self::set`] would refuse
    /// one.
    pub(super) fn set_all(&mut self, program: &Program, formats: BTreeMap<usize, Format>) -> bool {
        formats.iter().all(|(&index, format)| takes(program, index) && format.for_registers().is_ok())
            && self.insert(program.digest(), formats)
    }

    /// Replaces the formats of the program with this digest. Returns `false`, without effect, if there are too many of
    /// them.
    pub(super) fn insert(&mut self, digest: u64, formats: BTreeMap<usize, Format>) -> bool {
        let mut different: Vec<Format> = Vec::new();
        for &format in formats.values() {
            if !different.contains(&format) {
                different.push(format);
            }
        }
        if different.len() > MAX_INSTRUCTION_FORMATS {
            return false;
        }
        match formats.is_empty() {
            true => self.0.remove(&digest),
            false => self.0.insert(digest, formats),
        };
        true
    }

    /// Digests of programs, and the formats of their instructions by index.
    pub fn iter(&self) -> impl Iterator<Item = (u64, &BTreeMap<usize, Format>)> {
        self.0.iter().map(|(digest, formats)| (*digest, formats))
    }

    /// Formats that have no effect in these programs. A format for another program is listed by the program's digest; a
    /// format for an instruction that a program lacks, or that cannot have a format, by the digest and the
    /// instruction's index.
    pub fn unused(&self, programs: &[&Program]) -> Vec<(u64, Option<usize>)> {
        let mut found = Vec::new();
        for (digest, formats) in self.iter() {
            let program = programs.iter().find(|program| program.digest() == digest);
            let Some(program) = program else {
                found.push((digest, None));
                continue;
            };
            let idle = formats.keys().filter(|&&index| !takes(program, index));
            found.extend(idle.map(|index| (digest, Some(*index))));
        }
        found
    }

    /// Sets the formats of a program's instructions; others are removed.
    pub(crate) fn assign(&self, program: &mut Program) {
        // Digests are not computed for the many devices without such formats.
        let formats = if self.0.is_empty() { None } else { self.0.get(&program.digest()) };
        for (index, instruction) in program.instructions.iter_mut().enumerate() {
            let format = formats.and_then(|f| f.get(&index).copied());
            instruction.format = format.filter(|_| takes_format(instruction));
        }
    }
}
