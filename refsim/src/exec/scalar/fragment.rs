//! OpenGL fragment programs: three precisions, condition codes, packing. Follows GL_NV_fragment_program and
//! GL_ARB_fragment_program, and uses their mnemonics. The order within an instruction, and packed words, are defined in
//! docs/numbers.md, "OpenGL's fragment programs".

use super::fragment_state::{ConditionCode, FragmentState};
use super::interpreter::{ArithmeticUnit, Interpreter};
use super::operation::{self, Context};
use super::pack;
use super::registers::{Components, LANES};
use crate::exec::{FragmentFormats, Observer};
use crate::isa::{Instruction, Mask, Modifier, Opcode, OpcodeClass, Precision, RegisterFile, Source};
use crate::num::ops;

impl<'a, O: Observer> Interpreter<'_, 'a, O> {
    /// Executes an instruction in all lanes.
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

    /// Contents of a register, in the format of its file.
    fn fragment_value(&self, lane: usize, source: &Source) -> Components {
        let register = &source.register;
        let number = usize::from(register.index);
        match (&self.fragment, register.file) {
            (Some(f), RegisterFile::Half) => f.halves[lane].get(number).copied().unwrap_or_default(),
            (Some(f), RegisterFile::FogIn) => f.fog[lane],
            (Some(f), RegisterFile::WindowPosition) => f.position[lane],
            _ => self.lanes[lane].value(register, &self.prepared.constants, 0),
        }
    }

    fn bits(&self, lane: usize, source: &Source, component: usize) -> u32 {
        self.fragment_value(lane, source)[usize::from(source.swizzle.0[component] & 3)]
    }

    /// Loads an operand in the format of its file, then applies swizzle, absolute value and negation. Components
    /// outside `wanted` are zero.
    pub(super) fn loaded(&mut self, lane: usize, source: &Source, wanted: Mask, negate: u8) -> Components {
        let value = self.fragment_value(lane, source);
        let half = source.register.file.is_half();
        let unit = self.alu(if half { ArithmeticUnit::Half } else { ArithmeticUnit::Full });
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

    /// Loads an operand in the format of the operation.
    fn fragment_operand(
        &mut self,
        lane: usize,
        source: &Source,
        to: ArithmeticUnit,
        wanted: Mask,
        negate: u8,
    ) -> Components {
        let mut out = self.loaded(lane, source, wanted, negate);
        let from = self.fragment_formats().of_file(source.register.file);
        let unit = self.alu(to);
        for i in wanted.components() {
            out[i] = unit.enter(from, out[i]);
        }
        out
    }

    fn fragment_result(&mut self, lane: usize, instruction: &Instruction) -> Components {
        let Some(destination) = &instruction.destination else { return [0; 4] };
        let to = self.fragment_formats().of_file(destination.register.file);
        if let Some(word) = self.moved_bits(lane, instruction) {
            return word;
        }
        let precision = match instruction.precision() {
            Precision::Full => ArithmeticUnit::Full,
            Precision::Half => ArithmeticUnit::Half,
            Precision::Fixed => ArithmeticUnit::Fixed,
        };
        let k = self.unit_of(instruction, precision);
        let raw = self.fragment_raw(lane, instruction, k, destination.mask);
        let storage = self.prepared.written(destination.register.file);
        let unit = self.alu(k);
        let mut out = [0; 4];
        for i in destination.mask.components() {
            let x = if destination.saturate { unit.saturate_number(raw[i]) } else { raw[i] };
            let left = unit.leave(to, x);
            out[i] = unit.stored(to, storage, left);
        }
        self.assign_flags(lane);
        out
    }

    /// Computes a result that is moved as bits: a packed word, or the source of a plain `MOV` from `R#`. `None` for
    /// other instructions.
    fn moved_bits(&mut self, lane: usize, instruction: &Instruction) -> Option<Components> {
        let destination = instruction.destination.as_ref()?;
        let source = instruction.sources.first()?;
        if destination.register.file.is_half() || destination.saturate {
            return None;
        }
        let plain = source.modifier == Modifier::None && source.register.file == RegisterFile::Temp;
        match instruction.opcode {
            Opcode::Mov if plain && instruction.precision() == Precision::Full && instruction.format.is_none() => {
                Some([0, 1, 2, 3].map(|i| self.bits(lane, source, i)))
            }
            Opcode::Pk2h | Opcode::Pk2us | Opcode::Pk4b | Opcode::Pk4ub => {
                let word = self.packed(lane, instruction, source);
                Some([pack::stored_word(self.full.format, word); 4])
            }
            _ => None,
        }
    }

    fn packed(&mut self, lane: usize, instruction: &Instruction, source: &Source) -> u32 {
        let formats = self.fragment_formats();
        let value = self.fragment_operand(lane, source, ArithmeticUnit::Full, Mask::ALL, 0);
        pack::pack(&formats, instruction.opcode, &value)
    }

    /// Computes the result in the format of the operation, before saturation.
    fn fragment_raw(&mut self, lane: usize, instruction: &Instruction, k: ArithmeticUnit, mask: Mask) -> Components {
        let opcode = instruction.opcode;
        match opcode {
            Opcode::Pk2h | Opcode::Pk2us | Opcode::Pk4b | Opcode::Pk4ub => {
                // Half precision: reads the number that the word encodes.
                let Some(source) = instruction.sources.first() else { return [0; 4] };
                let word = self.packed(lane, instruction, source);
                let full = self.full.format;
                let number = ops::convert(&full, full, pack::stored_word(full, word)).bits;
                return [self.alu(k).enter(full, number); 4];
            }
            Opcode::Up2h | Opcode::Up2us | Opcode::Up4b | Opcode::Up4ub => {
                let value = self.unpacked(lane, instruction);
                let full = self.full.format;
                return value.map(|x| self.alu(k).enter(full, x));
            }
            _ => {}
        }
        let s = self.operands(lane, instruction, |this, lane, source, wanted| {
            this.fragment_operand(lane, source, k, wanted, instruction.fragment.negate)
        });
        let version = self.prepared.program.version;
        operation::compute(self.alu(k), opcode, &s, &Context { version, bump: [0; 4], mask })
    }

    fn unpacked(&mut self, lane: usize, instruction: &Instruction) -> Components {
        let Some(source) = instruction.sources.first() else { return [0; 4] };
        let plain = source.modifier == Modifier::None && source.register.file == RegisterFile::Temp;
        let word = match plain {
            true => self.bits(lane, source, 0),
            false => self.fragment_operand(lane, source, ArithmeticUnit::Full, Mask(1), 0)[0],
        };
        pack::unpack(&self.fragment_formats(), instruction.opcode, word)
    }

    /// Writes a result, in the format of its destination, subject to mask and condition, and updates the condition
    /// codes. The observer receives the resulting contents of the masked components.
    pub(super) fn fragment_store(&mut self, at: usize, lane: usize, instruction: &Instruction, value: Components) {
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
                fragment.codes[lane][i] = ConditionCode::of(&format, value[i]);
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
                // Depth is a scalar. If the condition disables the write, the old depth remains, or zero if there is none.
                let old = self.lanes[lane].depth_out.unwrap_or(0);
                let kept = destination.mask.components().next();
                let new = kept.map_or(old, |c| if mask.contains(c) { value[c] } else { old });
                self.lanes[lane].depth_out = Some(ops::convert(&format, format, new).bits);
                return self.notify(at, lane, Some((destination.mask, [new; 4])));
            }
        };
        let Some(slot) = slot else { return self.notify(at, lane, None) };
        for i in mask.components() {
            slot[i] = value[i];
        }
        let holds = slot.map(|x| ops::convert(&format, format, x).bits);
        self.notify(at, lane, Some((destination.mask, holds)));
    }

    /// `KIL`: kills the fragment if one of the four condition codes passes; in ARB, if a component is below zero.
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
            self.assign_flags(lane);
        }
    }
}
