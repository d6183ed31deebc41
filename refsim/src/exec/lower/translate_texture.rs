//! Translation of texture instructions to graph nodes.

use super::arith::NodeVector;
use super::graph::{Arith, Detail, NodeId, NodeKind};
use super::translate::{Effect, Translator};
use crate::device::{Storage, TexcrdOverflow, TexdepthDenominator, TexkillComponents};
use crate::exec::Projection;
use crate::exec::fragment::zero_components;
use crate::isa::{Destination, Instruction, Modifier, Opcode, Register, RegisterFile, Source, Version};
use crate::num::NumberOperation as Op;
use crate::texture::TextureKind;
use crate::texture::unbound;

const S: Arith = Arith::Single;

impl Translator<'_> {
    pub(crate) fn texture(&mut self, instruction: &Instruction, effects: &mut Vec<Effect>) {
        let Some(destination) = &instruction.destination else { return };
        match instruction.opcode {
            Opcode::TexKill => self.texkill(instruction, destination, effects),
            Opcode::TexDepth => self.texdepth(destination, effects),
            Opcode::TexM3x2Depth => self.texm3x2depth(instruction, destination, effects),
            Opcode::TexM3x2Pad | Opcode::TexM3x3Pad => {
                if let Some(source) = instruction.sources.first() {
                    let row = self.row(destination.register.index, source);
                    self.padded[self.pads.min(1)] = row;
                    self.pads += 1;
                }
            }
            Opcode::TexCoord | Opcode::TexCrd | Opcode::TexDp3 | Opcode::TexM3x3 => {
                let mut value = self.without_texel(instruction, destination);
                if instruction.format.is_some() {
                    let k = self.arith(instruction);
                    value = self.through(k, value);
                }
                self.writes(instruction, value, effects);
            }
            _ => {
                let value = self.with_texel(instruction, destination);
                self.writes(instruction, value, effects);
            }
        }
    }

    /// Coordinate set `number`, single precision.
    fn set(&mut self, number: u16) -> NodeVector {
        std::array::from_fn(|c| self.coordinate(number, c))
    }

    fn single(&mut self, x: NodeId) -> NodeId {
        self.make.convert(Arith::Main, S, x)
    }

    fn main(&mut self, x: NodeId) -> NodeId {
        self.make.convert(S, Arith::Main, x)
    }

    fn in_single(&mut self, source: &Source) -> NodeVector {
        self.operand(Arith::Main, source).map(|x| self.single(x))
    }

    fn address_of(&mut self, source: &Source) -> NodeVector {
        if source.register.file == RegisterFile::Texture {
            let set = self.set(source.register.index);
            source.swizzle.0.map(|c| set[usize::from(c & 3)])
        } else {
            self.in_single(source)
        }
    }

    /// The operand of `texld` and `texcrd` in ps_1_4: divided by `_dz` and `_dw`, or set to 1 if the divisor is zero.
    fn selected(&mut self, source: &Source) -> NodeVector {
        let plain = Source { modifier: Modifier::None, ..*source };
        let [x, y, z, w] = self.address_of(&plain);
        let divisor = match source.modifier {
            Modifier::Dz => z,
            Modifier::Dw => w,
            _ => return [x, y, z, w],
        };
        let (zero, one) = (self.make.zero(), self.make.one(S));
        let is_zero = self.make.holds(S, Op::Equal, divisor, zero);
        let [x, y] = [x, y].map(|c| {
            let quotient = self.make.div(S, c, divisor);
            self.make.select(is_zero, one, quotient)
        });
        [x, y, zero, zero]
    }

    /// A row of a texture matrix.
    fn row(&mut self, stage: u16, source: &Source) -> NodeId {
        let (own, vector) = (self.set(stage), self.in_single(source));
        self.make.dot(S, 3, &own, &vector)
    }

    fn coordinates_of(&mut self, instruction: &Instruction, destination: &Destination) -> NodeVector {
        let stage = destination.register.index;
        let (zero, one) = (self.make.zero(), self.make.one(S));
        let Some(source) = instruction.sources.first() else { return self.projected(stage) };
        match instruction.opcode {
            Opcode::TexLd if self.program.version == Version::Ps1_4 => self.selected(source),
            Opcode::TexLdP => {
                let [x, y, z, w] = self.address_of(source);
                let [x, y, z] = [x, y, z].map(|c| self.make.div(S, c, w));
                [x, y, z, w]
            }
            Opcode::TexLd | Opcode::TexLdB | Opcode::TexLdD => self.address_of(source),
            Opcode::TexReg2Ar => {
                let v = self.in_single(source);
                [v[3], v[0], zero, one]
            }
            Opcode::TexReg2Gb => {
                let v = self.in_single(source);
                [v[1], v[2], zero, one]
            }
            Opcode::TexReg2Rgb => {
                let v = self.in_single(source);
                [v[0], v[1], v[2], one]
            }
            Opcode::TexBem | Opcode::TexBemL => self.bumped(source, stage),
            Opcode::TexDp3Tex => [self.row(stage, source), zero, zero, one],
            Opcode::TexM3x2Tex => [self.padded[0], self.row(stage, source), zero, one],
            Opcode::TexM3x3Tex => [self.padded[0], self.padded[1], self.row(stage, source), one],
            Opcode::TexM3x3Spec => {
                let normal = [self.padded[0], self.padded[1], self.row(stage, source)];
                let eye = match instruction.sources.get(1) {
                    Some(eye) => self.in_single(eye),
                    None => [zero; 4],
                };
                self.reflected(normal, [eye[0], eye[1], eye[2]])
            }
            Opcode::TexM3x3VSpec => {
                let normal = [self.padded[0], self.padded[1], self.row(stage, source)];
                let eye = [2, 1, 0].map(|back| self.coordinate(stage.saturating_sub(back), 3));
                self.reflected(normal, eye)
            }
            _ => self.set(stage),
        }
    }

    fn projected(&mut self, stage: u16) -> NodeVector {
        let [x, y, z, w] = self.set(stage);
        match self.bindings.and_then(|b| b.projections.get(usize::from(stage)).copied()).unwrap_or_default() {
            Projection::None => [x, y, z, w],
            Projection::Z => [self.make.div(S, x, z), self.make.div(S, y, z), z, w],
            Projection::W => [self.make.div(S, x, w), self.make.div(S, y, w), self.make.div(S, z, w), w],
        }
    }

    fn bumped(&mut self, source: &Source, stage: u16) -> NodeVector {
        let own = self.projected(stage);
        let offset = self.in_single(source);
        let m = self.bump(stage).matrix.map(|bits| self.make.pattern(S, bits));
        let mut moved = |base: NodeId, r: NodeId, g: NodeId| {
            let first = self.make.mul(S, r, offset[0]);
            let sum = self.make.add(S, base, first);
            let second = self.make.mul(S, g, offset[1]);
            self.make.add(S, sum, second)
        };
        [moved(own[0], m[0], m[2]), moved(own[1], m[1], m[3]), own[2], own[3]]
    }

    fn reflected(&mut self, n: [NodeId; 3], e: [NodeId; 3]) -> NodeVector {
        let ne = self.make.dot(S, 3, &n, &e);
        let nn = self.make.dot(S, 3, &n, &n);
        let q = self.make.div(S, ne, nn);
        let twice = self.make.add(S, q, q);
        let [x, y, z] = std::array::from_fn(|i| {
            let along = self.make.mul(S, twice, n[i]);
            self.make.sub(S, along, e[i])
        });
        [x, y, z, self.make.one(S)]
    }

    fn with_texel(&mut self, instruction: &Instruction, destination: &Destination) -> NodeVector {
        let stage = match instruction.sources.get(1) {
            Some(sampler) if self.program.version.is_ps_2() => usize::from(sampler.register.index),
            _ => usize::from(destination.register.index),
        };
        let coordinates = self.coordinates_of(instruction, destination);
        self.pads = 0;
        let detail = match (instruction.opcode, instruction.sources.get(2), instruction.sources.get(3)) {
            (Opcode::TexLdB, ..) => Detail::Biased(coordinates[3]),
            (Opcode::TexLdD, Some(x), Some(y)) => Detail::Gradients(self.in_single(x), self.in_single(y)),
            _ => Detail::Implicit,
        };
        let mut texel = self.fetch(stage, coordinates, detail);
        if let (Opcode::TexBemL, Some(source)) = (instruction.opcode, instruction.sources.first()) {
            texel = self.brightened(source, destination.register.index, texel);
        }
        let k = self.arith(instruction);
        self.through(k, texel)
    }

    /// A texture read, rounded to the format of texels.
    pub(super) fn fetch(&mut self, stage: usize, coordinates: NodeVector, detail: Detail) -> NodeVector {
        let storage = self.make.rules.storage.of(Storage::Texels);
        let binding = self.bindings.and_then(|b| b.samplers.get(stage)).and_then(Option::as_ref);
        let zeros = zero_components(self.program.version, binding.map(|binding| binding.image.format()));
        let mut texel = self.sampled(stage, coordinates, detail);
        texel[zeros].fill(self.make.zero());
        texel.map(|x| self.make.stored(Arith::Main, storage, x))
    }

    fn sampled(&mut self, stage: usize, coordinates: NodeVector, detail: Detail) -> NodeVector {
        self.fetches.push(stage);
        let binding = self.bindings.and_then(|b| b.samplers.get(stage)).and_then(Option::as_ref);
        let Some(binding) = binding else {
            return unbound(self.make.rules.format).map(|bits| self.make.pattern(Arith::Main, bits));
        };
        let detail = if binding.needs_detail() { detail } else { Detail::Implicit };
        // Components without a texture axis are dropped, so that reads don't depend on them.
        let axes = match binding.image.kind() {
            TextureKind::D1 => 1,
            TextureKind::D2 | TextureKind::Rectangle => 2,
            TextureKind::Cube | TextureKind::Volume => 3,
        };
        let zero = self.make.zero();
        let coordinates = std::array::from_fn(|i| if i < axes { coordinates[i] } else { zero });
        let fetch = self.make.graph.node(NodeKind::Fetch(stage as u8, coordinates, detail));
        std::array::from_fn(|c| self.make.graph.node(NodeKind::Texel(fetch, c as u8)))
    }

    fn brightened(&mut self, source: &Source, stage: u16, texel: NodeVector) -> NodeVector {
        let blue = self.in_single(source)[2];
        let bump = self.bump(stage);
        let scale = self.make.pattern(S, bump.luminance_scale);
        let offset = self.make.pattern(S, bump.luminance_offset);
        let scaled = self.make.mul(S, blue, scale);
        let sum = self.make.add(S, scaled, offset);
        let factor = self.main(sum);
        texel.map(|x| self.make.mul(Arith::Main, x, factor))
    }

    fn without_texel(&mut self, instruction: &Instruction, destination: &Destination) -> NodeVector {
        let stage = destination.register.index;
        match (instruction.opcode, instruction.sources.first()) {
            (Opcode::TexCrd, Some(source)) => self.selected(source).map(|x| {
                let format = self.make.rules.format;
                if self.make.rules.texcrd_overflow == TexcrdOverflow::PreserveWrap && format.is_fixed() {
                    self.make.convert(S, Arith::Wrapped, x)
                } else {
                    self.main(x)
                }
            }),
            (Opcode::TexDp3, Some(source)) => {
                let row = self.row(stage, source);
                [self.main(row); 4]
            }
            (Opcode::TexM3x3, Some(source)) => {
                let row = self.row(stage, source);
                self.pads = 0;
                let [x, y, z] = [self.padded[0], self.padded[1], row].map(|x| self.main(x));
                [x, y, z, self.make.one(Arith::Main)]
            }
            _ => {
                let [x, y, z, _] = self.set(stage).map(|x| {
                    let clamped = self.make.unary(S, Op::Saturate, x);
                    self.main(clamped)
                });
                [x, y, z, self.make.one(Arith::Main)]
            }
        }
    }

    fn texm3x2depth(&mut self, instruction: &Instruction, destination: &Destination, effects: &mut Vec<Effect>) {
        let Some(source) = instruction.sources.first() else { return };
        let w = self.row(destination.register.index, source);
        let (zero, one) = (self.make.zero(), self.make.one(S));
        let quotient = self.make.div(S, self.padded[0], w);
        let is_zero = self.make.holds(S, Op::Equal, w, zero);
        effects.push(Effect::Depth(S, self.make.select(is_zero, one, quotient)));
        self.pads = 0;
    }

    fn texdepth(&mut self, destination: &Destination, effects: &mut Vec<Effect>) {
        let k = Arith::Main;
        let register = Register::new(RegisterFile::Temp, destination.register.index);
        let [r, g] = [0, 1].map(|c| self.held(&register, c));
        let (zero, one) = (self.make.zero(), self.make.one(k));
        let divisor = match self.make.rules.texdepth_denominator {
            TexdepthDenominator::Raw => g,
            TexdepthDenominator::Min1 => self.make.binary(k, Op::Min, g, one),
        };
        let quotient = self.make.div(k, r, divisor);
        let is_zero = self.make.holds(k, Op::Equal, divisor, zero);
        effects.push(Effect::Depth(k, self.make.select(is_zero, one, quotient)));
    }

    fn texkill(&mut self, instruction: &Instruction, destination: &Destination, effects: &mut Vec<Effect>) {
        let version = self.program.version;
        let four = version.is_ps_2() && self.make.rules.texkill_components == TexkillComponents::Four;
        let register = destination.register;
        let interpolated = version.is_ps_1_x() && register.file == RegisterFile::Texture;
        let zero = self.make.zero();
        for c in 0..if four { 4 } else { 3 } {
            let (k, value) = if interpolated {
                (S, self.coordinate(register.index, c))
            } else {
                (Arith::Main, self.held(&register, c))
            };
            let mut below = self.make.holds(k, Op::Less, value, zero);
            if let Some(allowed) = self.predicate(instruction, c) {
                below = self.make.binary(S, Op::And, below, allowed);
            }
            effects.push(Effect::Kill(below));
        }
    }
}
