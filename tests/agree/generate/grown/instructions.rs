//! Random instructions, and groups of them.

use super::super::bare;
use super::Writer;
use crate::random::Random;
use refsim::isa::{
    Comparison, Destination, DestinationRule, Instruction, Mask, Modifier, Opcode, OpcodeClass, Predicate, Register,
    RegisterFile, Relative, Source, Span, Stage, Swizzle, Version,
};

use Opcode as O;
use RegisterFile as F;

fn source(register: Register, swizzle: Swizzle) -> Source {
    Source { register, swizzle, modifier: Modifier::None, span: Span::default() }
}

fn component(r: &mut Random) -> Swizzle {
    Swizzle::replicate(r.below(4))
}

impl Writer {
    pub(super) fn insert(&self, list: &mut Vec<Instruction>, r: &mut Random) {
        let has_flow = matches!(self.version, Version::Ps2A | Version::Vs2_0);
        let at = r.below(list.len() + 1);
        let within = |r: &mut Random| self.begin + r.below(list.len() + 1 - self.begin - self.end);
        match r.below(8) {
            0 if has_flow => {
                let (one, other) = (within(r), within(r));
                let (from, to) = (one.min(other), one.max(other));
                let [open, close] = self.block(r);
                let is_branch = close.opcode == O::EndIf;
                list.insert(to, close);
                if is_branch && r.coin() {
                    list.insert(from + r.below(to - from + 1), bare(O::Else));
                }
                list.insert(from, open);
            }
            1 if has_flow => {
                let place = within(r);
                list.insert(place, self.jump(r));
            }
            0 | 1 if self.version.is_ps_1_1_to_1_3() => drop(list.splice(at..at, self.matrix_reads(r))),
            _ => list.insert(at, self.instruction(r)),
        }
    }

    fn condition(&self, r: &mut Random) -> Source {
        let modifier = r.of(&[Modifier::None, Modifier::Not]);
        let register = match self.version == Version::Ps2A && r.coin() {
            true => source(Register::new(F::Predicate, 0), component(r)),
            false => source(Register::new(F::ConstantBool, r.below(2)), Swizzle::IDENTITY),
        };
        Source { modifier, ..register }
    }

    fn compared(&self, opcode: Opcode, r: &mut Random) -> Instruction {
        let sources = (0..2).map(|_| Source { swizzle: component(r), ..self.number(r) }).collect();
        Instruction { comparison: Some(r.of(&Comparison::ALL)), sources, ..bare(opcode) }
    }

    /// The first and the last instruction of a branch or loop.
    fn block(&self, r: &mut Random) -> [Instruction; 2] {
        let count = source(Register::new(F::ConstantInt, r.below(2)), Swizzle::IDENTITY);
        let with = |opcode, sources| Instruction { sources, ..bare(opcode) };
        match r.below(5) {
            0 => [with(O::Rep, vec![count]), bare(O::EndRep)],
            1 | 2 if self.version == Version::Ps2A => [self.compared(O::IfC, r), bare(O::EndIf)],
            1 | 2 => {
                let counter = source(Register::new(F::Loop, 0), Swizzle::IDENTITY);
                [with(O::Loop, vec![counter, count]), bare(O::EndLoop)]
            }
            _ => [with(O::If, vec![self.condition(r)]), bare(O::EndIf)],
        }
    }

    /// A call, or in pixel programs a break.
    fn jump(&self, r: &mut Random) -> Instruction {
        let label = source(Register::new(F::Label, r.below(2)), Swizzle::IDENTITY);
        let sources = vec![label, self.condition(r)];
        match r.below(if self.version == Version::Ps2A { 5 } else { 2 }) {
            0 => Instruction { sources: vec![label], ..bare(O::Call) },
            1 => Instruction { sources, ..bare(O::CallNz) },
            2 => bare(O::Break),
            3 => Instruction { sources: vec![sources[1]], ..bare(O::BreakP) },
            _ => self.compared(O::BreakC, r),
        }
    }

    /// A product with a matrix of coordinate sets in ps_1_1 to ps_1_3.
    fn matrix_reads(&self, r: &mut Random) -> Vec<Instruction> {
        let (pads, last) = match r.coin() {
            true => (vec![O::TexM3x2Pad], r.of(&[O::TexM3x2Tex, O::TexM3x2Depth])),
            false => {
                let last = r.of(&[O::TexM3x3Tex, O::TexM3x3Spec, O::TexM3x3VSpec, O::TexM3x3]);
                (vec![O::TexM3x3Pad; 2], last)
            }
        };
        let stage = 1 + r.below(3 - pads.len() as u16);
        let modifier = r.of(&[Modifier::None, Modifier::None, Modifier::Bx2]);
        let from = source(Register::new(F::Texture, r.below(stage)), Swizzle::IDENTITY);
        let one = |(to, opcode): (u16, Opcode)| {
            let destination = Some(plain_destination(Register::new(F::Texture, to), Mask::ALL));
            let mut sources = vec![Source { modifier, ..from }];
            if opcode == O::TexM3x3Spec {
                sources.push(source(Register::new(F::Constant, r.below(8)), Swizzle::IDENTITY));
            }
            Instruction { destination, sources, ..bare(opcode) }
        };
        (stage..).zip(pads.into_iter().chain([last])).map(one).collect()
    }

    fn instruction(&self, r: &mut Random) -> Instruction {
        let version = self.version;
        let reads = self.sampling && !self.reads.is_empty() && r.coin();
        let mut opcode = r.of(if reads { &self.reads } else { &self.opcodes });
        if opcode == O::TexKill && !r.one_in(4) {
            // Otherwise few fragments are left.
            opcode = O::Mov;
        }
        let info = opcode.info();
        let count = info.source_count(version).unwrap_or(0).into();
        let is_predicable = version == Version::Ps2A && !matches!(opcode, O::TexKill | O::Nop | O::Setp);
        let predicate = |r: &mut Random| {
            let swizzle = if r.one_in(3) { Swizzle::IDENTITY } else { component(r) };
            Predicate { not: r.coin(), swizzle, span: Span::default() }
        };
        Instruction {
            comparison: info.comparison.then(|| r.of(&Comparison::ALL)),
            destination: (info.destination != DestinationRule::None).then(|| self.destination(opcode, r)),
            sources: (0..count).map(|k| self.operand(opcode, k, r)).collect(),
            coissue: version.is_ps_1_x() && r.one_in(4),
            predicate: (is_predicable && r.one_in(6)).then(|| predicate(r)),
            ..bare(opcode)
        }
    }

    fn destination(&self, opcode: Opcode, r: &mut Random) -> Destination {
        let (version, reads) = (self.version, opcode.info().class == OpcodeClass::Texture);
        let (file, index) = match opcode {
            O::Setp => (F::Predicate, 0),
            O::Mova => (F::Address, 0),
            O::Mov if version == Version::Vs1_1 && r.one_in(8) => (F::Address, 0),
            O::TexDepth => (F::Temp, 5),
            O::TexKill if r.coin() => (F::Texture, r.below(self.sets)),
            _ if version.is_ps_1_1_to_1_3() && (reads || r.one_in(6)) => (F::Texture, r.below(4)),
            _ if version.stage() == Stage::Vertex && r.one_in(5) => {
                let outputs =
                    [(F::TexCoordOut, r.below(8)), (F::DiffuseOut, r.below(2)), (F::FogOut, 0), (F::PointSizeOut, 0)];
                r.of(&outputs)
            }
            _ => (F::Temp, r.below(self.temps)),
        };
        let mask = match (opcode, file) {
            (_, F::FogOut | F::PointSizeOut) => r.of(&[1, 15]),
            (_, F::Address) if version == Version::Vs1_1 => 1,
            (O::TexCrd, _) => r.of(&[7, 7, 3]),
            (O::Bem, _) => 3,
            (O::SinCos, _) => 1 + r.below(3),
            (O::Crs, _) => 1 + r.below(7),
            (O::Nrm, _) => r.of(&[7, 15]),
            (O::Frc, _) if version == Version::Vs1_1 => 2 + r.below(2),
            _ if reads => 15,
            _ if version.is_ps_1_1_to_1_3() => r.of(&[7, 8, 15]),
            _ if r.one_in(3) => 15,
            _ => 1 + r.below(15),
        };
        let mask = opcode.matrix().map_or(mask, |(rows, _)| (1 << rows) - 1);
        let computes = opcode.info().class == OpcodeClass::Arithmetic;
        Destination {
            shift: if version.is_ps_1_x() && computes && r.coin() { r.below(7i8) - 3 } else { 0 },
            saturate: version.stage() == Stage::Pixel && computes && r.one_in(4),
            partial_precision: version.is_ps_2() && r.one_in(3),
            ..plain_destination(Register::new(file, index), Mask(mask))
        }
    }

    /// Source `k` of an instruction.
    fn operand(&self, opcode: Opcode, k: usize, r: &mut Random) -> Source {
        let (version, reads) = (self.version, opcode.info().class == OpcodeClass::Texture);
        let fixed = |file, index| source(Register::new(file, index), Swizzle::IDENTITY);
        let temp = |r: &mut Random| fixed(F::Temp, r.below(self.temps));
        match (opcode, k) {
            (O::SinCos, 1 | 2) => return fixed(F::Constant, k as u16 + if r.one_in(4) { 0 } else { 5 }),
            (O::Sgn, 1 | 2) => return temp(r),
            (O::Cnd, 0) if version.is_ps_1_1_to_1_3() => {
                return source(Register::new(F::Temp, 0), Swizzle::replicate(3));
            }
            (_, 1) if opcode.matrix().is_some() => return Source { swizzle: Swizzle::IDENTITY, ..self.constant(r) },
            (_, 1) if reads && version.is_ps_2() => {
                return fixed(F::Sampler, if self.samplers.is_empty() { 0 } else { r.of(&self.samplers) });
            }
            _ => {}
        }
        let several = !(opcode.is_scalar() || matches!((opcode, k), (O::SinCos, 0) | (O::Dp2Add, 2)));
        if !reads || k > 1 {
            let number = self.number(r);
            return if several { number } else { Source { swizzle: component(r), ..number } };
        }
        // The coordinates of a texture read.
        let set = r.below(self.sets);
        let from_set = version.is_ps_1_1_to_1_3() || r.coin();
        let mut from = if from_set { fixed(F::Texture, set) } else { temp(r) };
        if version == Version::Ps1_4 {
            // A coordinate set must always have the same selector.
            let odd = from_set && set % 2 == 1;
            from.swizzle = if odd { Swizzle([0, 1, 3, 3]) } else { Swizzle::IDENTITY };
            let divided = r.one_in(4) && (odd || !from_set);
            from.modifier = [Modifier::None, if odd { Modifier::Dw } else { Modifier::Dz }][usize::from(divided)];
        } else if version.is_ps_1_x() && r.one_in(3) {
            from.modifier = Modifier::Bx2;
        } else if version == Version::Ps2A && r.one_in(6) {
            from.swizzle = Swizzle([0; 4].map(|_: u8| r.below(4)));
        }
        from
    }

    /// A constant, in vertex programs sometimes relative to an address.
    fn constant(&self, r: &mut Random) -> Source {
        let count = if r.one_in(3) { 12 } else { 8 };
        let mut register = Register::new(F::Constant, r.below(count));
        if self.version.stage() == Stage::Vertex && r.coin() {
            let components = if self.version == Version::Vs1_1 { 1 } else { 4 };
            let by_loop = self.version == Version::Vs2_0 && r.one_in(3);
            register.index %= 6;
            register.relative = Some(if by_loop { Relative::Loop } else { Relative::Address(r.below(components)) });
        }
        source(register, Swizzle::IDENTITY)
    }

    /// An operand of arithmetic.
    fn number(&self, r: &mut Random) -> Source {
        let version = self.version;
        let mut out = match r.below(12) {
            0..3 => self.constant(r),
            3 | 4 => source(Register::new(F::Input, r.below(self.inputs)), Swizzle::IDENTITY),
            5 | 6 if version != Version::Ps1_4 && version.stage() == Stage::Pixel => {
                source(Register::new(F::Texture, r.below(self.sets)), Swizzle::IDENTITY)
            }
            _ => source(Register::new(F::Temp, r.below(self.temps)), Swizzle::IDENTITY),
        };
        out.swizzle = match r.below(8) {
            0 if version.is_ps_1_1_to_1_3() => Swizzle::replicate(2 + r.below(2)),
            0 | 1 => component(r),
            2 if version.is_ps_2() => Swizzle(r.of(&[[1, 2, 0, 3], [2, 0, 1, 3], [3, 2, 1, 0]])),
            3..6 if matches!(version, Version::Ps2A | Version::Vs1_1 | Version::Vs2_0) => {
                Swizzle([0; 4].map(|_: u8| r.below(4)))
            }
            _ => Swizzle::IDENTITY,
        };
        // Negation and the modifiers of ps_1_x after it; constants of ps_1_4 take none.
        if version == Version::Ps1_4 && out.register.file == F::Constant {
            return out;
        }
        out.modifier = match r.below(4) {
            0 if version.is_ps_1_x() => r.of(&Modifier::DIRECT3D[1..9]),
            0 => Modifier::Negate,
            _ => Modifier::None,
        };
        out
    }
}

fn plain_destination(register: Register, mask: Mask) -> Destination {
    let [saturate, partial_precision, centroid] = [false; 3];
    Destination { register, mask, shift: 0, saturate, partial_precision, centroid, span: Span::default() }
}
