//! Components that an instruction reads: from the opcode table, refined for texture reads.

use crate::isa::{Instruction, Mask, Opcode, OpcodeClass, Usage, Version};

/// Number of rows of a matrix operation's second source.
pub fn matrix_rows(opcode: Opcode) -> Option<u16> {
    opcode.matrix().map(|(rows, _)| rows)
}

/// Lanes of source `index` that the instruction reads, before swizzling.
///
/// `sampler` is the declared type of the sampler of a ps_2_x texture read.
pub fn source_lanes(version: Version, instruction: &Instruction, index: usize, sampler: Option<Usage>) -> Mask {
    let written = instruction.destination.map_or(Mask::ALL, |d| d.mask);
    let lanes = match (instruction.opcode, index) {
        (Opcode::Nrm, _) => 0b0111,
        // Each component of the result depends on two others.
        (Opcode::Crs, _) => {
            let needs = [0b0110, 0b0101, 0b0011];
            (0..3).filter(|c| written.contains(*c)).fold(0, |lanes, c| lanes | needs[c])
        }
        (Opcode::TexLd | Opcode::TexLdB | Opcode::TexLdP | Opcode::TexLdD, 1) => 0,
        (Opcode::TexLd, _) if version == Version::Ps1_4 => 0b0111,
        (Opcode::TexLd | Opcode::TexLdD, _) => coordinates(sampler),
        (Opcode::TexLdB | Opcode::TexLdP, _) => coordinates(sampler) | 0b1000,
        (Opcode::TexBem | Opcode::TexBemL, _) => 0b0011,
        (Opcode::TexReg2Ar, _) => 0b1001,
        (Opcode::TexReg2Gb, _) => 0b0110,
        (Opcode::TexCrd | Opcode::Kil, _) => written.0,
        (opcode, _) if opcode.info().class == OpcodeClass::Texture => 0b0111,
        (opcode, _) => opcode.lanes_read(index, written).0,
    };
    Mask(lanes & 0b1111)
}

fn coordinates(sampler: Option<Usage>) -> u8 {
    match sampler {
        Some(Usage::SamplerCube | Usage::SamplerVolume) => 0b0111,
        _ => 0b0011,
    }
}

/// Components of the destination operand that the instruction *reads*: three in `texkill`, two in `texdepth`.
pub fn destination_reads(opcode: Opcode) -> Mask {
    match opcode {
        Opcode::TexKill => Mask(0b0111),
        Opcode::TexDepth => Mask(0b0011),
        _ => Mask(0),
    }
}
