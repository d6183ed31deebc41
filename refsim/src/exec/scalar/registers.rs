//! Registers of one lane, and how instructions read and write them.

use super::alu::Alu;
use crate::exec::ResolvedConstants;
use crate::isa::{Destination, Mask, Modifier, Register, RegisterFile, Relative, Source};
use crate::num::Format;

/// Number of temporaries: the maximum of all versions.
const TEMPORARIES: usize = 32;

/// Lanes of a quad: (0, 0), (1, 0), (0, 1), (1, 1).
pub(super) const LANES: usize = 4;

/// Four components of one register.
pub(super) type Components = [u32; 4];

/// Registers of one fragment or vertex, as patterns of the register format. All start at zero, so that unwritten
/// registers read as zero.
#[derive(Clone)]
pub(super) struct Registers {
    pub(super) temp: [Components; TEMPORARIES],
    /// `v#`
    pub(super) input: [Components; 16],
    /// `t#` as read by arithmetic: texture results in ps_1_1 to 1_3, coordinates in ps_2_x.
    pub(super) texture: [Components; 8],
    pub(super) color_out: [Components; 4],
    /// Value written to `oDepth`, if any.
    pub(super) depth_out: Option<u32>,
    pub(super) position: Components,
    pub(super) fog: Components,
    pub(super) point_size: Components,
    pub(super) diffuse: [Components; 2],
    pub(super) texcoord: [Components; 8],
    pub(super) predicate: [bool; 4],
    pub(super) address: [i32; 4],
}

impl Registers {
    pub(super) const fn new() -> Self {
        Self {
            temp: [[0; 4]; TEMPORARIES],
            input: [[0; 4]; 16],
            texture: [[0; 4]; 8],
            color_out: [[0; 4]; 4],
            depth_out: None,
            position: [0; 4],
            fog: [0; 4],
            point_size: [0; 4],
            diffuse: [[0; 4]; 2],
            texcoord: [[0; 4]; 8],
            predicate: [false; 4],
            address: [0; 4],
        }
    }

    /// Register number with relative addressing resolved; `None` if it is negative.
    fn number(&self, register: &Register, loop_counter: i32) -> Option<usize> {
        let offset = match register.relative {
            None => 0,
            Some(Relative::Address(component)) => self.address[usize::from(component & 3)],
            Some(Relative::Loop) => loop_counter,
        };
        usize::try_from(i64::from(register.index) + i64::from(offset)).ok()
    }

    /// Value of a register before swizzle and modifiers. Registers outside their file (for example by relative
    /// addressing) and files without numbers read as zero.
    pub(super) fn value(&self, register: &Register, constants: &ResolvedConstants, loop_counter: i32) -> Components {
        let Some(number) = self.number(register, loop_counter) else {
            return [0; 4];
        };
        let file: &[Components] = match register.file {
            RegisterFile::Temp => &self.temp,
            RegisterFile::Input => &self.input,
            RegisterFile::Texture => &self.texture,
            RegisterFile::Constant => &constants.float,
            _ => &[],
        };
        file.get(number).copied().unwrap_or_default()
    }

    /// Writes the components of `mask`; ignores registers outside their file.
    pub(super) fn write(&mut self, register: &Register, mask: Mask, value: Components) {
        let number = usize::from(register.index);
        let slot = match register.file {
            RegisterFile::Temp => self.temp.get_mut(number),
            RegisterFile::Texture => self.texture.get_mut(number),
            RegisterFile::ColorOut => self.color_out.get_mut(number),
            RegisterFile::DiffuseOut => self.diffuse.get_mut(number),
            RegisterFile::TexCoordOut => self.texcoord.get_mut(number),
            RegisterFile::PositionOut => Some(&mut self.position),
            RegisterFile::FogOut => Some(&mut self.fog),
            RegisterFile::PointSizeOut => Some(&mut self.point_size),
            RegisterFile::DepthOut => {
                // A scalar is taken from the lowest component of the mask.
                if let Some(component) = mask.components().next() {
                    self.depth_out = Some(value[component]);
                }
                None
            }
            _ => None,
        };
        if let Some(slot) = slot {
            for i in mask.components() {
                slot[i] = value[i];
            }
        }
    }
}

/// An operand as an operation reads it: converted to the operation's format if that differs from the register format
/// (`_pp`), swizzled, modified. Components outside `wanted` are zero.
pub(super) fn operand(
    alu: &mut Alu<'_>,
    registers: Format,
    source: &Source,
    value: Components,
    wanted: Mask,
) -> Components {
    let mut out = [0; 4];
    for i in wanted.components() {
        let raw = value[usize::from(source.swizzle.0[i] & 3)];
        let converted = alu.enter(registers, raw);
        out[i] = modified(alu, source.modifier, converted);
    }
    out
}

/// Applies a source modifier to a component. Each step rounds once; negation comes last.
///
/// Division (`_dz`, `_dw`) applies to texture addressing, and logical negation to predicates; neither has an effect
/// here.
pub(super) fn modified(alu: &mut Alu<'_>, modifier: Modifier, x: u32) -> u32 {
    match modifier {
        Modifier::None | Modifier::Dz | Modifier::Dw | Modifier::Not => x,
        Modifier::Negate => alu.neg(x),
        Modifier::Absolute => alu.abs(x),
        Modifier::AbsoluteNegate => {
            let magnitude = alu.abs(x);
            alu.neg(magnitude)
        }
        Modifier::Invert => alu.sub(alu.one(), x),
        Modifier::Bias => alu.sub(x, alu.half()),
        Modifier::BiasNegate => {
            let biased = alu.sub(x, alu.half());
            alu.neg(biased)
        }
        Modifier::Bx2 => {
            let biased = alu.sub(x, alu.half());
            alu.scale(biased, 1)
        }
        Modifier::Bx2Negate => {
            let biased = alu.sub(x, alu.half());
            let doubled = alu.scale(biased, 1);
            alu.neg(doubled)
        }
        Modifier::X2 => alu.scale(x, 1),
        Modifier::X2Negate => {
            let doubled = alu.scale(x, 1);
            alu.neg(doubled)
        }
    }
}

/// Finishes a result for a register: shift, then saturation, then conversion to the register format if the operation
/// has another format (`_pp`).
pub(super) fn finished(
    alu: &mut Alu<'_>,
    registers: Format,
    destination: &Destination,
    result: Components,
) -> Components {
    let mut out = [0; 4];
    for i in destination.mask.components() {
        let mut x = alu.scale(result[i], destination.shift);
        if destination.saturate {
            x = alu.saturate(x);
        }
        out[i] = alu.leave(registers, x);
    }
    out
}
