//! Texture reads of OpenGL fragment programs. As in Direct3D's programs, addresses are single precision for any
//! register format. The texel is converted to full precision, then to the destination's format.

use super::interpreter::Interpreter;
use super::registers::{Components, LANES, modified};
use super::texture::{Detail, Quad};
use crate::exec::Observer;
use crate::isa::{Instruction, Mask, Opcode, RegisterFile, Source, TextureTarget, Version};
use crate::num::{Format, ops};

impl<O: Observer> Interpreter<'_, '_, O> {
    /// `TEX`, `TXP`, `TXB`, `TXD`.
    pub(super) fn fragment_texture(&mut self, at: usize, instruction: &Instruction) {
        let (Some(destination), [source, sampler, rest @ ..]) = (&instruction.destination, &*instruction.sources)
        else {
            return;
        };
        let nv = self.prepared.program.version == Version::Fp1_0;
        // NV's instruction does not divide the directions of a cube map; ARB's does (sections 3.11.5.40 and 3.11.6.2).
        let projects =
            instruction.opcode == Opcode::TexLdP && !(nv && instruction.fragment.target == Some(TextureTarget::Cube));
        let mut coordinates: Quad = [[0; 4]; LANES];
        for (lane, slot) in coordinates.iter_mut().enumerate() {
            let [x, y, z, w] = self.address(lane, source);
            *slot = match projects {
                true => [self.address.div(x, w), self.address.div(y, w), self.address.div(z, w), w],
                false => [x, y, z, w],
            };
            self.assign_flags(lane);
        }
        let detail = match (instruction.opcode, rest) {
            (Opcode::TexLdB, _) => Detail::Biased([0, 1, 2, 3].map(|lane: usize| coordinates[lane][3])),
            (Opcode::TexLdD, [x, y]) => {
                let mut gradient = |source| [0, 1, 2, 3].map(|lane: usize| self.address(lane, source));
                Detail::Gradients(Box::new([gradient(x), gradient(y)]))
            }
            _ => Detail::Implicit,
        };
        let stage = usize::from(sampler.register.index);
        let to = self.fragment_formats().of_file(destination.register.file);
        let storage = self.prepared.written(destination.register.file);
        for lane in 0..LANES {
            let texel = self.fetch(stage, lane, &coordinates, &detail);
            let texel = self.through(instruction.format, texel);
            let value = texel.map(|x| {
                let clamped = if destination.saturate { self.full.saturate_number(x) } else { x };
                let left = self.full.leave(to, clamped);
                self.full.stored(to, storage, left)
            });
            self.fragment_store(at, lane, instruction, value);
        }
    }

    /// An operand in single precision: `f[TEX#]` as interpolated, other registers converted.
    fn address(&mut self, lane: usize, source: &Source) -> Components {
        if source.register.file == RegisterFile::Texture {
            let set = self.coordinate_set(lane, source.register.index);
            return source.swizzle.0.map(|c| modified(&mut self.address, source.modifier, set[usize::from(c & 3)]));
        }
        let from = self.fragment_formats().of_file(source.register.file);
        self.loaded(lane, source, Mask::ALL, 0).map(|x| ops::convert(&from, Format::FP32, x).bits)
    }
}
