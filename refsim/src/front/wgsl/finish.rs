//! Register allocation: removes unread results, and packs components into temporaries.

use std::collections::BTreeMap;

use super::super::Refusal;
use crate::isa::{Instruction, Mask, Opcode, RegisterFile, Source, Span, Swizzle};

/// Number of temporaries of a program.
const TEMPORARIES: usize = 32;

/// Lanes that an instruction reads of one of its operands.
fn lanes(instruction: &Instruction, index: usize) -> Mask {
    match (instruction.opcode, index) {
        (Opcode::TexLd | Opcode::TexLdD, _) => Mask(0b0011),
        (opcode, _) => opcode.lanes_read(index, instruction.destination.map_or(Mask(0), |d| d.mask)),
    }
}

fn is_temporary(source: &Source) -> bool {
    source.register.file == RegisterFile::Temp
}

/// Removes instructions whose results are never read.
pub(super) fn without_unused(instructions: Vec<Instruction>) -> Vec<Instruction> {
    let mut live: BTreeMap<u16, u8> = BTreeMap::new();
    let mut codes = false;
    let mut kept = Vec::new();
    for instruction in instructions.into_iter().rev() {
        let conditional = instruction.fragment.condition.is_some();
        if let Some(destination) = instruction.destination {
            match destination.register.file {
                RegisterFile::Temp => {
                    let read = live.entry(destination.register.index).or_default();
                    if *read & destination.mask.0 == 0 {
                        continue;
                    }
                    if !conditional {
                        *read &= !destination.mask.0;
                    }
                }
                RegisterFile::Discard if !std::mem::take(&mut codes) => continue,
                _ => {}
            }
        }
        codes |= conditional;
        for (index, source) in instruction.sources.iter().enumerate().filter(|(_, source)| is_temporary(source)) {
            let read = lanes(&instruction, index).components().fold(0, |read, lane| read | 1 << source.swizzle.0[lane]);
            *live.entry(source.register.index).or_default() |= read;
        }
        kept.push(instruction);
    }
    kept.reverse();
    kept
}

/// Allocation of a virtual register: a temporary, and the component in it at which the register starts.
#[derive(Clone, Copy)]
struct PackedRegister {
    register: u16,
    first: u8,
    mask: u8,
}

/// Assigns temporaries to virtual registers. The components of one register stay together; several registers can share
/// a temporary.
///
/// # Errors
/// If the temporaries do not suffice.
pub(super) fn numbered(instructions: &mut [Instruction]) -> Result<(), Refusal> {
    let (mut widths, mut last): (BTreeMap<u16, u32>, BTreeMap<u16, usize>) = (BTreeMap::new(), BTreeMap::new());
    for (at, instruction) in instructions.iter().enumerate() {
        if let Some(destination) = instruction.destination.filter(|d| d.register.file == RegisterFile::Temp) {
            let width = widths.entry(destination.register.index).or_default();
            *width = (8 - destination.mask.0.leading_zeros()).max(*width);
            last.insert(destination.register.index, at);
        }
        for source in instruction.sources.iter().filter(|source| is_temporary(source)) {
            last.insert(source.register.index, at);
        }
    }
    let mut taken = [0_u8; TEMPORARIES];
    let mut windows: BTreeMap<u16, PackedRegister> = BTreeMap::new();
    for (at, instruction) in instructions.iter_mut().enumerate() {
        let read: Vec<u16> = instruction.sources.iter().filter(|s| is_temporary(s)).map(|s| s.register.index).collect();
        let written = instruction.destination.filter(|d| d.register.file == RegisterFile::Temp);
        let written = written.map(|d| d.register.index);
        let from = |index: &u16| windows.get(index).copied();
        let sources: Vec<Option<PackedRegister>> =
            instruction.sources.iter().map(|s| from(&s.register.index)).collect();
        for index in read.iter().filter(|index| last[index] == at && Some(**index) != written) {
            if let Some(window) = windows.remove(index) {
                taken[usize::from(window.register)] &= !window.mask;
            }
        }
        if let Some(index) = written
            && !windows.contains_key(&index)
        {
            let window = free(&taken, widths[&index]).ok_or_else(|| full(instruction.span))?;
            taken[usize::from(window.register)] |= window.mask;
            windows.insert(index, window);
        }
        let to = written.and_then(|index| windows.get(&index).copied());
        moved(instruction, to, &sources);
        // No later instruction uses the register.
        if let (Some(index), Some(window)) = (written, to)
            && last[&index] == at
        {
            windows.remove(&index);
            taken[usize::from(window.register)] &= !window.mask;
        }
    }
    Ok(())
}

fn full(span: Span) -> Refusal {
    let message = format!("the shader needs more live numbers than {TEMPORARIES} vectors hold");
    Refusal::new(message, span).with_help("compute values just before their use, or split the shader into passes")
}

/// Finds `width` adjacent free components, in the fullest temporary that has them.
fn free(taken: &[u8; TEMPORARIES], width: u32) -> Option<PackedRegister> {
    let mask = (1_u8 << width) - 1;
    let fits = (0..TEMPORARIES).flat_map(|register| (0..=4 - width).map(move |first| (register, first)));
    let fits = fits.filter(|(register, first)| taken[*register] & mask << first == 0);
    fits.max_by_key(|(register, first)| (taken[*register].count_ones(), std::cmp::Reverse((*register, *first))))
        .map(|(register, first)| PackedRegister { register: register as u16, first: first as u8, mask: mask << first })
}

/// Rewrites an instruction for the temporaries allocated to its registers.
fn moved(instruction: &mut Instruction, to: Option<PackedRegister>, sources: &[Option<PackedRegister>]) {
    // The operands of a component-wise operation are shifted along with the destination.
    let each = match instruction.opcode {
        Opcode::Dp3 | Opcode::Dp4 | Opcode::TexLd | Opcode::TexLdD => false,
        opcode => !opcode.is_scalar(),
    };
    let shift = to.map_or(0, |window| usize::from(window.first));
    let turned = |swizzle: Swizzle| Swizzle([0, 1, 2, 3].map(|lane: usize| swizzle.0[lane.saturating_sub(shift)]));
    for (source, window) in instruction.sources.iter_mut().zip(sources) {
        if is_temporary(source)
            && let Some(window) = window
        {
            source.register.index = window.register;
            source.swizzle = Swizzle(source.swizzle.0.map(|lane| (lane + window.first).min(3)));
        }
        if each {
            source.swizzle = turned(source.swizzle);
        }
    }
    if let Some(condition) = &mut instruction.fragment.condition {
        condition.swizzle = turned(condition.swizzle);
    }
    if let (Some(destination), Some(window)) = (&mut instruction.destination, to) {
        destination.register.index = window.register;
        destination.mask = Mask(destination.mask.0 << window.first);
    }
}
