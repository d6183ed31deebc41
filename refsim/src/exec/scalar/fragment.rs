//! OpenGL's fragment programs: three precisions, condition codes, packing. Read beside GL_NV_fragment_program and
//! GL_ARB_fragment_program, whose instructions carry the same names.
//!
//! The order within an instruction: operands are loaded, swizzled, made absolute, negated, then converted into the format
//! of the operation; the result is saturated, converted into the format of its destination, and written where the mask and
//! the condition say; there the condition codes take it too, if the instruction asks.
//!
//! A packed word lies in `R#` as bits. `MOV` in full precision without modifiers carries bits; everything else, and the
//! end of the program, takes them for the number that they are a pattern of.

use super::alu::Alu;
use super::interpreter::{Interpreter, LANES};
use super::operation::{self, Context, Vector};
use super::pack;
use crate::device::Rules;
use crate::exec::{FragmentFormats, Observer};
use crate::isa::{
    Condition, ConditionTest, Instruction, Mask, Modifier, Opcode, OpcodeClass, Precision, Program, RegisterFile,
    Source, Version,
};
use crate::num::{Flags, Format, ops};

/// Half precision temporaries.
const HALVES: usize = 64;

/// What a component of the last result was beside zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Code {
    Less,
    Equal,
    Greater,
    Unordered,
}

impl Code {
    fn of(format: &Format, bits: u32) -> Self {
        if format.is_nan(bits) {
            Self::Unordered
        } else if format.is_zero(bits) {
            Self::Equal
        } else if format.is_negative(bits) {
            Self::Less
        } else {
            Self::Greater
        }
    }

    fn passes(self, test: ConditionTest) -> bool {
        match test {
            ConditionTest::Eq => self == Self::Equal,
            ConditionTest::Ne => self != Self::Equal,
            ConditionTest::Lt => self == Self::Less,
            ConditionTest::Le => matches!(self, Self::Less | Self::Equal),
            ConditionTest::Gt => self == Self::Greater,
            ConditionTest::Ge => matches!(self, Self::Greater | Self::Equal),
            ConditionTest::Tr => true,
            ConditionTest::Fl => false,
        }
    }
}

/// What a fragment program has besides the registers of Direct3D, for four lanes. All starts at zero, the codes at equal.
pub(super) struct FragmentState<'a> {
    formats: FragmentFormats,
    half: Alu<'a>,
    fixed: Alu<'a>,
    /// `H#`
    halves: [[Vector; HALVES]; LANES],
    /// `f[FOGC]`, in full precision.
    pub(super) fog: [Vector; LANES],
    /// `f[WPOS]`, in full precision.
    pub(super) position: [Vector; LANES],
    /// `o[COLH]`
    half_color: [Vector; LANES],
    codes: [[Code; 4]; LANES],
}

impl<'a> FragmentState<'a> {
    pub(super) fn new(rules: &'a Rules) -> Self {
        let formats = FragmentFormats::new(rules);
        Self {
            formats,
            half: Alu::new(rules, formats.half),
            fixed: Alu::new(rules, formats.fixed),
            halves: [[[0; 4]; HALVES]; LANES],
            fog: [[0; 4]; LANES],
            position: [[0; 4]; LANES],
            half_color: [[0; 4]; LANES],
            codes: [[Code::Equal; 4]; LANES],
        }
    }

    pub(super) fn take_flags(&mut self) -> Flags {
        self.half.take_flags() | self.fixed.take_flags()
    }

    /// The colour that the program leaves in a lane, in the register format: `o[COLR]`, which is given, or `o[COLH]`.
    pub(super) fn color(&self, program: &Program, lane: usize, full: Vector) -> Vector {
        let is_half = |i: &Instruction| i.destination.is_some_and(|d| d.register.file == RegisterFile::HalfColorOut);
        let (from, value) = match program.instructions.iter().any(is_half) {
            true => (self.formats.half, self.half_color[lane]),
            false => (self.formats.full, full),
        };
        value.map(|x| ops::convert(&from, self.formats.full, x).bits)
    }

    fn passes(&self, lane: usize, condition: &Condition, component: usize) -> bool {
        self.codes[lane][usize::from(condition.swizzle.0[component] & 3)].passes(condition.test)
    }
}

impl<'a, O: Observer> Interpreter<'_, 'a, O> {
    /// One instruction in all lanes.
    pub(super) fn fragment_instruction(&mut self, at: usize, instruction: &Instruction) {
        match (instruction.opcode, instruction.opcode.info().class) {
            (Opcode::Kil, _) => self.kil(instruction),
            (_, OpcodeClass::Texture) => self.fragment_texture(at, instruction),
            (_, OpcodeClass::Arithmetic) => {
                let mut results = [[0; 4]; LANES];
                for (lane, result) in results.iter_mut().enumerate() {
                    *result = self.fragment_result(lane, instruction);
                }
                for (lane, result) in results.into_iter().enumerate() {
                    self.fragment_store(at, lane, instruction, result);
                }
            }
            _ => {}
        }
    }

    pub(super) fn fragment_formats(&self) -> FragmentFormats {
        FragmentFormats::new(self.prepared.rules)
    }

    /// The arithmetic of a precision.
    pub(super) fn unit(&mut self, precision: Precision) -> &mut Alu<'a> {
        match (&mut self.fragment, precision) {
            (Some(fragment), Precision::Half) => &mut fragment.half,
            (Some(fragment), Precision::Fixed) => &mut fragment.fixed,
            _ => &mut self.full,
        }
    }

    /// What a register holds, in the format of its file.
    fn fragment_value(&self, lane: usize, source: &Source) -> Vector {
        let register = &source.register;
        let number = usize::from(register.index);
        match (&self.fragment, register.file) {
            (Some(f), RegisterFile::Half) => f.halves[lane].get(number).copied().unwrap_or_default(),
            (Some(f), RegisterFile::FogIn) => f.fog[lane],
            (Some(f), RegisterFile::WindowPosition) => f.position[lane],
            _ => self.lanes[lane].value(register, &self.prepared.constants, 0),
        }
    }

    /// The bits of a component without any conversion.
    fn bits(&self, lane: usize, source: &Source, component: usize) -> u32 {
        self.fragment_value(lane, source)[usize::from(source.swizzle.0[component] & 3)]
    }

    /// An operand in the format of its file: swizzled, absolute, negated. Components outside `wanted` are zero.
    pub(super) fn loaded(&mut self, lane: usize, source: &Source, wanted: Mask, negate: u8) -> Vector {
        let value = self.fragment_value(lane, source);
        let half = source.register.file.is_half();
        let unit = self.unit(if half { Precision::Half } else { Precision::Full });
        let format = unit.format;
        let mut out = [0; 4];
        for i in wanted.components() {
            let raw = match source.swizzle.0[i] {
                4 => 0,
                5 => format.one(),
                c => unit.convert(format, value[usize::from(c & 3)]),
            };
            let modified = super::registers::modified(unit, source.modifier, raw);
            out[i] = if negate >> i & 1 == 1 { unit.neg(modified) } else { modified };
        }
        out
    }

    /// An operand in the format of the operation.
    fn fragment_operand(&mut self, lane: usize, source: &Source, to: Precision, wanted: Mask, negate: u8) -> Vector {
        let mut out = self.loaded(lane, source, wanted, negate);
        let from = self.fragment_formats().of_file(source.register.file);
        let unit = self.unit(to);
        for i in wanted.components() {
            out[i] = unit.enter(from, out[i]);
        }
        out
    }

    /// The result in the format of the destination.
    fn fragment_result(&mut self, lane: usize, instruction: &Instruction) -> Vector {
        let Some(destination) = &instruction.destination else { return [0; 4] };
        let to = self.fragment_formats().of_file(destination.register.file);
        if let Some(word) = self.moved_bits(lane, instruction) {
            return word;
        }
        let precision = instruction.precision();
        let raw = self.fragment_raw(lane, instruction, precision, destination.mask);
        let unit = self.unit(precision);
        let mut out = [0; 4];
        for i in destination.mask.components() {
            let x = if destination.saturate { unit.saturate(raw[i]) } else { raw[i] };
            out[i] = unit.leave(to, x);
        }
        self.settle(lane);
        out
    }

    /// What is carried as bits: packed words, and what a plain `MOV` finds in `R#`. `None` for everything else.
    fn moved_bits(&mut self, lane: usize, instruction: &Instruction) -> Option<Vector> {
        let destination = instruction.destination.as_ref()?;
        let source = instruction.sources.first()?;
        if destination.register.file.is_half() || destination.saturate {
            return None;
        }
        let plain = source.modifier == Modifier::None && source.register.file == RegisterFile::Temp;
        match instruction.opcode {
            Opcode::Mov if plain && instruction.precision() == Precision::Full => {
                Some([0, 1, 2, 3].map(|i| self.bits(lane, source, i)))
            }
            Opcode::Pk2h | Opcode::Pk2us | Opcode::Pk4b | Opcode::Pk4ub => {
                let word = self.packed(lane, instruction, source);
                Some([pack::kept(self.full.format, word); 4])
            }
            _ => None,
        }
    }

    fn packed(&mut self, lane: usize, instruction: &Instruction, source: &Source) -> u32 {
        let formats = self.fragment_formats();
        let value = self.fragment_operand(lane, source, Precision::Full, Mask::ALL, 0);
        pack::pack(&formats, instruction.opcode, &value)
    }

    /// The result in the format of the operation, before saturation.
    fn fragment_raw(&mut self, lane: usize, instruction: &Instruction, k: Precision, mask: Mask) -> Vector {
        let opcode = instruction.opcode;
        match opcode {
            Opcode::Dsx | Opcode::Dsy => return self.fragment_difference(lane, instruction, k, mask),
            Opcode::Pk2h | Opcode::Pk2us | Opcode::Pk4b | Opcode::Pk4ub => {
                // Into half precision: the number that the word is a pattern of.
                let Some(source) = instruction.sources.first() else { return [0; 4] };
                let word = self.packed(lane, instruction, source);
                let full = self.full.format;
                let number = ops::convert(&full, full, pack::kept(full, word)).bits;
                return [self.unit(k).enter(full, number); 4];
            }
            Opcode::Up2h | Opcode::Up2us | Opcode::Up4b | Opcode::Up4ub => {
                let value = self.unpacked(lane, instruction);
                let full = self.full.format;
                return value.map(|x| self.unit(k).enter(full, x));
            }
            _ => {}
        }
        let wanted = operation::read_mask(opcode, mask);
        let mut s = [[0; 4]; 3];
        for (slot, source) in s.iter_mut().zip(&instruction.sources) {
            *slot = self.fragment_operand(lane, source, k, wanted, instruction.fragment.negate);
        }
        let arb = self.prepared.program.version == Version::ArbFp1_0;
        let unit = self.unit(k);
        if arb && opcode == Opcode::Rsq {
            // ARB takes the magnitude, whatever the card's own instruction does.
            s[0] = s[0].map(|x| unit.abs(x));
        }
        if opcode == Opcode::Cmp {
            // ARB chooses by `< 0`, Direct3D by `>= 0`: a NaN chooses the other operand.
            return operation::each(mask, |i| if unit.less(s[0][i], 0) { s[1][i] } else { s[2][i] });
        }
        operation::compute(unit, opcode, &s, &Context { bump: [0; 4], mask })
    }

    fn unpacked(&mut self, lane: usize, instruction: &Instruction) -> Vector {
        let Some(source) = instruction.sources.first() else { return [0; 4] };
        let plain = source.modifier == Modifier::None && source.register.file == RegisterFile::Temp;
        let word = match plain {
            true => self.bits(lane, source, 0),
            false => self.fragment_operand(lane, source, Precision::Full, Mask(1), 0)[0],
        };
        pack::unpack(&self.fragment_formats(), instruction.opcode, word)
    }

    /// `DDX`, `DDY`: the difference across the quad's row or column, the same for both lanes of it.
    fn fragment_difference(&mut self, lane: usize, instruction: &Instruction, k: Precision, mask: Mask) -> Vector {
        let Some(source) = instruction.sources.first() else { return [0; 4] };
        let (low, high) = match instruction.opcode {
            Opcode::Dsx => (lane & 2, lane | 1),
            _ => (lane & 1, lane | 2),
        };
        let from = self.fragment_operand(low, source, k, mask, 0);
        let to = self.fragment_operand(high, source, k, mask, 0);
        let unit = self.unit(k);
        operation::each(mask, |i| unit.sub(to[i], from[i]))
    }

    /// Writes a result, in the format of its destination, where the mask and the condition say, and lets the condition
    /// codes take it there. The observer is told what the masked components hold then.
    pub(super) fn fragment_store(&mut self, at: usize, lane: usize, instruction: &Instruction, value: Vector) {
        let Some(destination) = &instruction.destination else { return };
        let file = destination.register.file;
        let format = self.fragment_formats().of_file(file);
        let Some(fragment) = &mut self.fragment else { return };
        let condition = &instruction.fragment.condition;
        let allowed = |f: &FragmentState<'_>, i: usize| condition.as_ref().is_none_or(|c| f.passes(lane, c, i));
        let mask = destination.mask.components().filter(|&i| allowed(fragment, i)).fold(0, |mask, i| mask | 1 << i);
        let mask = Mask(mask);
        if instruction.fragment.updates {
            for i in mask.components() {
                fragment.codes[lane][i] = Code::of(&format, value[i]);
            }
        }
        let number = usize::from(destination.register.index);
        let slot = match file {
            RegisterFile::Half => fragment.halves[lane].get_mut(number),
            RegisterFile::HalfColorOut => Some(&mut fragment.half_color[lane]),
            RegisterFile::Discard | RegisterFile::HalfDiscard => None,
            RegisterFile::Temp => self.lanes[lane].temp.get_mut(number),
            RegisterFile::ColorOut => self.lanes[lane].color_out.get_mut(number),
            _ => {
                // Depth: a scalar, which a condition keeps from being written but not from being replaced by zero.
                let old = self.lanes[lane].depth_out.unwrap_or(0);
                let kept = destination.mask.components().next();
                let new = kept.map_or(old, |c| if mask.contains(c) { value[c] } else { old });
                self.lanes[lane].depth_out = Some(ops::convert(&format, format, new).bits);
                return self.tell(at, lane, Some((destination.mask, [new; 4])));
            }
        };
        let Some(slot) = slot else { return self.tell(at, lane, None) };
        for i in mask.components() {
            slot[i] = value[i];
        }
        let holds = slot.map(|x| ops::convert(&format, format, x).bits);
        self.tell(at, lane, Some((destination.mask, holds)));
    }

    /// `KIL`: a fragment is dropped if one of the four condition codes passes; ARB's, if a component is below zero.
    fn kil(&mut self, instruction: &Instruction) {
        for lane in 0..LANES {
            let mut killed = false;
            if let (Some(fragment), Some(condition)) = (&self.fragment, &instruction.fragment.condition) {
                killed = (0..4).any(|i| fragment.passes(lane, condition, i));
            }
            if let Some(source) = instruction.sources.first() {
                let value = self.loaded(lane, source, Mask::ALL, 0);
                killed |= value.iter().any(|&x| self.full.less(x, 0));
            }
            self.killed |= u8::from(killed) << lane;
            self.settle(lane);
        }
    }
}
