//! Texture instructions. Addresses are single precision for any register format: coordinates `t#` reach a sampler
//! unrounded, registers are converted exactly, and address arithmetic (`texbem`, `texm3x3tex`, `_dw`) rounds once per
//! step and sums dot products in the device's order.

use super::interpreter::{ArithmeticUnit, Interpreter};
use super::registers::{Components, LANES};
use crate::device::{Storage, TexcrdOverflow};
use crate::exec::fragment::zero_components;
use crate::exec::{Observer, Projection, TextureRead};
use crate::isa::{Destination, Instruction, Mask, Modifier, Opcode, RegisterFile, Source, Version};
use crate::num::{Format, Overflow, ops};
use crate::texture::{Lod, lod_from_derivatives, sample, unbound};

const ONE: u32 = 0x3f80_0000;

/// One vector per lane.
pub(super) type Quad = [Components; LANES];

/// Source of a read's level of detail.
pub(super) enum Detail {
    /// Differences of the coordinates across the quad.
    Implicit,
    /// [`Detail::Implicit`] plus a bias per lane.
    Biased([u32; LANES]),
    /// Derivatives along x and y given by the program.
    Gradients(Box<[Quad; 2]>),
}

impl<O: Observer> Interpreter<'_, '_, O> {
    /// Executes a texture instruction in the active lanes.
    pub(super) fn texture(&mut self, at: usize, instruction: &Instruction) {
        let Some(destination) = &instruction.destination else {
            return;
        };
        match instruction.opcode {
            Opcode::TexKill => self.texkill(at, instruction, destination),
            Opcode::TexDepth => self.texdepth(at, destination),
            Opcode::TexM3x2Depth => self.texm3x2depth(at, instruction, destination),
            Opcode::TexM3x2Pad | Opcode::TexM3x3Pad => self.pad(at, instruction, destination),
            Opcode::TexCoord | Opcode::TexCrd | Opcode::TexDp3 | Opcode::TexM3x3 => {
                self.without_texel(at, instruction, destination);
            }
            _ => self.with_texel(at, instruction, destination),
        }
    }

    fn with_texel(&mut self, at: usize, instruction: &Instruction, destination: &Destination) {
        let version = self.prepared.program.version;
        let stage = match instruction.sources.get(1) {
            Some(sampler) if version.is_ps_2() => usize::from(sampler.register.index),
            _ => usize::from(destination.register.index),
        };
        let mut coordinates = [[0; 4]; LANES];
        for (lane, slot) in coordinates.iter_mut().enumerate() {
            *slot = self.coordinates_of(lane, instruction, destination);
            self.assign_flags(lane);
        }
        self.pads = 0;
        let detail = match instruction.opcode {
            Opcode::TexLdB => Detail::Biased([0, 1, 2, 3].map(|lane: usize| coordinates[lane][3])),
            Opcode::TexLdD => Detail::Gradients(Box::new([
                self.gradient(instruction.sources.get(2)),
                self.gradient(instruction.sources.get(3)),
            ])),
            _ => Detail::Implicit,
        };
        for lane in self.active_lanes() {
            let mut texel = self.fetch(stage, lane, &coordinates, &detail);
            if instruction.opcode == Opcode::TexBemL {
                texel = self.brightened(lane, instruction, stage, texel);
            }
            let hint = self.prepared.rules.partial.filter(|_| destination.partial_precision);
            let value = self.through(instruction.format.or(hint), texel);
            self.store(at, lane, instruction, value);
        }
    }

    /// Texture coordinates of a lane, single precision.
    fn coordinates_of(&mut self, lane: usize, instruction: &Instruction, destination: &Destination) -> Components {
        let own = self.coordinate_set(lane, destination.register.index);
        let Some(source) = instruction.sources.first() else {
            return self.projected(own, destination.register.index); // tex
        };
        match instruction.opcode {
            Opcode::TexLd if self.prepared.program.version == Version::Ps1_4 => self.selected(lane, source),
            Opcode::TexLdP => {
                let [x, y, z, w] = self.address_of(lane, source);
                [self.address.div(x, w), self.address.div(y, w), self.address.div(z, w), w]
            }
            Opcode::TexLd | Opcode::TexLdB | Opcode::TexLdD => self.address_of(lane, source),
            Opcode::TexReg2Ar => {
                let v = self.in_single(lane, source);
                [v[3], v[0], 0, ONE]
            }
            Opcode::TexReg2Gb => {
                let v = self.in_single(lane, source);
                [v[1], v[2], 0, ONE]
            }
            Opcode::TexReg2Rgb => {
                let v = self.in_single(lane, source);
                [v[0], v[1], v[2], ONE]
            }
            Opcode::TexBem | Opcode::TexBemL => {
                let own = self.projected(own, destination.register.index);
                self.bumped(lane, own, source, destination.register.index)
            }
            Opcode::TexDp3Tex => [self.row(lane, own, source), 0, 0, ONE],
            Opcode::TexM3x2Tex => [self.padded[lane][0], self.row(lane, own, source), 0, ONE],
            Opcode::TexM3x3Tex => {
                let [x, y] = self.padded[lane];
                [x, y, self.row(lane, own, source), ONE]
            }
            Opcode::TexM3x3Spec => {
                let normal = self.normal(lane, own, source);
                let eye = match instruction.sources.get(1) {
                    Some(eye) => self.in_single(lane, eye),
                    None => [0; 4],
                };
                self.reflected(normal, [eye[0], eye[1], eye[2]])
            }
            Opcode::TexM3x3VSpec => {
                let normal = self.normal(lane, own, source);
                let stage = destination.register.index;
                let w = |back: u16| self.coordinate_set(lane, stage.saturating_sub(back))[3];
                let eye = [w(2), w(1), w(0)];
                self.reflected(normal, eye)
            }
            _ => own,
        }
    }

    /// Interpolated coordinate set `number`; zero if it does not exist.
    pub(super) fn coordinate_set(&self, lane: usize, number: u16) -> Components {
        self.coordinates[lane].get(usize::from(number)).copied().unwrap_or_default()
    }

    /// Divides coordinates by the stage's projection, in IEEE single precision (division by zero included).
    fn projected(&mut self, [x, y, z, w]: Components, stage: u16) -> Components {
        let unit = &mut self.address;
        match self.prepared.projection(stage) {
            Projection::None => [x, y, z, w],
            Projection::Z => [unit.div(x, z), unit.div(y, z), z, w],
            Projection::W => [unit.div(x, w), unit.div(y, w), unit.div(z, w), w],
        }
    }

    /// A register after its source modifier, converted to single precision.
    fn in_single(&mut self, lane: usize, source: &Source) -> Components {
        let format = self.prepared.format;
        self.source(lane, source, Mask::ALL, ArithmeticUnit::Full).map(|x| ops::convert(&format, Format::FP32, x).bits)
    }

    /// A coordinate operand: `t#` as interpolated, other registers converted to single precision.
    fn address_of(&mut self, lane: usize, source: &Source) -> Components {
        if source.register.file == RegisterFile::Texture {
            let set = self.coordinate_set(lane, source.register.index);
            source.swizzle.0.map(|c| set[usize::from(c & 3)])
        } else {
            self.in_single(lane, source)
        }
    }

    /// The operand of `texld` and `texcrd` in ps_1_4. `_dz` and `_dw` divide x and y by z or w, or set them to 1.0 if
    /// the divisor is zero. The third and fourth component are undefined on the cards; here they are 0.
    fn selected(&mut self, lane: usize, source: &Source) -> Components {
        let plain = Source { modifier: Modifier::None, ..*source };
        let [x, y, z, w] = self.address_of(lane, &plain);
        let divisor = match source.modifier {
            Modifier::Dz => z,
            Modifier::Dw => w,
            _ => return [x, y, z, w],
        };
        if divisor & 0x7fff_ffff == 0 {
            return [ONE, ONE, 0, 0];
        }
        [self.address.div(x, divisor), self.address.div(y, divisor), 0, 0]
    }

    /// `texbem`: `u' = (u + M00*r) + M10*g`, `v' = (v + M01*r) + M11*g`, with the matrix of the destination's stage.
    fn bumped(&mut self, lane: usize, own: Components, source: &Source, stage: u16) -> Components {
        let offset = self.in_single(lane, source);
        let m = self.prepared.bump(stage).matrix;
        let unit = &mut self.address;
        let mut moved = |base: u32, m_r: u32, m_g: u32| {
            let first = unit.mul(m_r, offset[0]);
            let sum = unit.add(base, first);
            let second = unit.mul(m_g, offset[1]);
            unit.add(sum, second)
        };
        [moved(own[0], m[0], m[2]), moved(own[1], m[1], m[3]), own[2], own[3]]
    }

    /// `texbeml`: multiplies all four channels by `b * scale + offset`. The factor is computed in single precision with
    /// two roundings and then converted to the register format.
    fn brightened(&mut self, lane: usize, instruction: &Instruction, stage: usize, texel: Components) -> Components {
        let Some(source) = instruction.sources.first() else {
            return texel;
        };
        let blue = self.in_single(lane, source)[2];
        let bump = self.prepared.bump(u16::try_from(stage).unwrap_or(u16::MAX));
        let scaled = self.address.mul(blue, bump.luminance_scale);
        let single = self.address.add(scaled, bump.luminance_offset);
        let factor = self.full.convert(Format::FP32, single);
        texel.map(|x| self.full.mul(x, factor))
    }

    /// A row of a texture matrix: the dot product of coordinate set and source register.
    fn row(&mut self, lane: usize, own: Components, source: &Source) -> u32 {
        let vector = self.in_single(lane, source);
        self.address.dot(&own[..3], &vector[..3])
    }

    /// The three matrix rows: two stored by pad instructions, and a new row.
    fn normal(&mut self, lane: usize, own: Components, source: &Source) -> [u32; 3] {
        let [x, y] = self.padded[lane];
        [x, y, self.row(lane, own, source)]
    }

    /// The eye ray reflected at the normal, `(2 (n.e) / (n.n)) n - e`, in the steps `q = dp3(n, e) / dp3(n, n)`,
    /// `q + q`, multiply by n, subtract e.
    fn reflected(&mut self, n: [u32; 3], e: [u32; 3]) -> Components {
        let unit = &mut self.address;
        let (ne, nn) = (unit.dot(&n, &e), unit.dot(&n, &n));
        let q = unit.div(ne, nn);
        let twice = unit.add(q, q);
        let mut out = [0, 0, 0, ONE];
        for i in 0..3 {
            let along = unit.mul(twice, n[i]);
            out[i] = unit.sub(along, e[i]);
        }
        out
    }

    /// Derivatives passed to `texldd`, in all lanes.
    fn gradient(&mut self, source: Option<&Source>) -> Quad {
        let mut out = [[0; 4]; LANES];
        if let Some(source) = source {
            for (lane, slot) in out.iter_mut().enumerate() {
                *slot = self.in_single(lane, source);
            }
        }
        out
    }

    /// Reads a texel for one lane, rounded to the storage format of texels, and counts the read. An unbound sampler
    /// returns (0, 0, 0, 1), or zeros in `!!FP1.0`.
    pub(super) fn fetch(&mut self, stage: usize, lane: usize, coordinates: &Quad, detail: &Detail) -> Components {
        let (format, storage) = (self.prepared.format, self.prepared.rules.storage.of(Storage::Texels));
        let image = self.prepared.sampler(stage).map(|binding| binding.image.format());
        let mut texel = self.sampled(stage, lane, coordinates, detail);
        texel[zero_components(self.prepared.program.version, image)].fill(0);
        texel.map(|x| self.full.stored(format, storage, x))
    }

    fn sampled(&mut self, stage: usize, lane: usize, coordinates: &Quad, detail: &Detail) -> Components {
        let prepared = self.prepared;
        if self.covered >> lane & 1 == 1
            && let Some(count) = self.fetches.get_mut(stage)
        {
            *count += 1;
        }
        let Some(binding) = prepared.sampler(stage) else {
            return unbound(prepared.format);
        };
        let lod = if binding.needs_detail() {
            let (ddx, ddy) = match detail {
                Detail::Gradients(gradients) => (gradients[0][lane], gradients[1][lane]),
                _ => (self.across(coordinates, lane & 2, lane | 1), self.across(coordinates, lane & 1, lane | 2)),
            };
            let bits = prepared.rules.lod_fraction_bits;
            let level = lod_from_derivatives(binding.image, coordinates[lane], ddx, ddy, bits);
            Lod::Level(match detail {
                Detail::Biased(bias) => self.address.add(level, bias[lane]),
                _ => level,
            })
        } else {
            Lod::Base
        };
        if O::READS && self.covered >> lane & 1 == 1 {
            self.observer.reads(&TextureRead { sampler: stage, coordinates: coordinates[lane], lod });
        }
        sample(Some(binding.image), &binding.state, &prepared.sample_rules, coordinates[lane], lod)
    }

    fn across(&mut self, coordinates: &Quad, from: usize, to: usize) -> Components {
        let (a, b) = (coordinates[from], coordinates[to]);
        [0, 1, 2, 3].map(|i: usize| self.address.sub(b[i], a[i]))
    }

    /// Rounds a result to the instruction's own format, or to the format of `_pp`, and returns it in the register
    /// format.
    pub(super) fn through(&self, own: Option<Format>, value: Components) -> Components {
        let format = self.prepared.format;
        match own {
            Some(own) => value.map(|x| {
                let narrowed = ops::convert(&format, own, x).bits;
                ops::convert(&own, format, narrowed).bits
            }),
            None => value,
        }
    }

    /// Executes an instruction that converts coordinates to register values.
    fn without_texel(&mut self, at: usize, instruction: &Instruction, destination: &Destination) {
        for lane in self.active_lanes() {
            let own = self.coordinate_set(lane, destination.register.index);
            let value = match (instruction.opcode, instruction.sources.first()) {
                (Opcode::TexCrd, Some(source)) => {
                    let selected = self.selected(lane, source);
                    selected.map(|x| self.coordinate_in_register(x))
                }
                (Opcode::TexDp3, Some(source)) => [self.row(lane, own, source); 4].map(|x| self.delivered(x)),
                (Opcode::TexM3x3, Some(source)) => {
                    let [x, y, z] = self.normal(lane, own, source);
                    [self.delivered(x), self.delivered(y), self.delivered(z), self.full.one()]
                }
                // texcoord: clamped to [0, 1], w = 1.
                _ => {
                    let [x, y, z, _] = own.map(|x| {
                        let clamped = self.address.saturate(x);
                        self.delivered(clamped)
                    });
                    [x, y, z, self.full.one()]
                }
            };
            let value = self.through(instruction.format, value);
            self.store(at, lane, instruction, value);
        }
        if instruction.opcode == Opcode::TexM3x3 {
            self.pads = 0;
        }
    }

    fn delivered(&mut self, single: u32) -> u32 {
        self.full.convert(Format::FP32, single)
    }

    /// `texcrd`: converts a coordinate to the register format. A coordinate out of range saturates, or in fixed point
    /// wraps with its fraction preserved, according to the rules.
    fn coordinate_in_register(&mut self, single: u32) -> u32 {
        let format = self.prepared.format;
        match self.prepared.rules.texcrd_overflow {
            TexcrdOverflow::Clamp => self.delivered(single),
            TexcrdOverflow::PreserveWrap if format.is_fixed() => {
                let wrapped = ops::convert(&Format::FP32, format.with_overflow(Overflow::Wrap), single);
                self.full.flags |= wrapped.flags;
                wrapped.bits
            }
            TexcrdOverflow::PreserveWrap => self.delivered(single),
        }
    }

    /// `texm3x2pad`, `texm3x3pad`: stores a row for the instruction that completes the matrix.
    fn pad(&mut self, at: usize, instruction: &Instruction, destination: &Destination) {
        let Some(source) = instruction.sources.first() else {
            return;
        };
        let slot = self.pads.min(1);
        for lane in 0..LANES {
            let own = self.coordinate_set(lane, destination.register.index);
            self.padded[lane][slot] = self.row(lane, own, source);
            self.assign_flags(lane);
        }
        self.pads += 1;
        for lane in self.active_lanes() {
            self.notify(at, lane, None);
        }
    }

    /// `texm3x2depth`: the depth is the quotient of the two rows in single precision, or 1.0 if the divisor is zero.
    fn texm3x2depth(&mut self, at: usize, instruction: &Instruction, destination: &Destination) {
        let Some(source) = instruction.sources.first() else {
            return;
        };
        for lane in self.active_lanes() {
            let own = self.coordinate_set(lane, destination.register.index);
            let w = self.row(lane, own, source);
            let z = self.padded[lane][0];
            let depth = if w & 0x7fff_ffff == 0 { ONE } else { self.address.div(z, w) };
            self.depth[lane] = Some((Format::FP32, depth));
            self.notify(at, lane, None);
        }
        self.pads = 0;
    }
}
