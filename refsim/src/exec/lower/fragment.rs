//! OpenGL fragment programs as graph nodes: three precisions, condition codes, packing. The scalar executor's
//! `fragment` documents the instructions.

use refsim_lanes::TRUE;

use super::arith::NodeVector;
use super::graph::{Arith, Detail, NodeId, NodeKind};
use super::translate::{CodeNodes, Effect, Translator};
use crate::isa::{
    Condition, ConditionTest, Instruction, Modifier, Opcode, OpcodeClass, Precision, RegisterFile, Source,
    TextureTarget, Version,
};
use crate::num::NumberOperation as Op;

pub(crate) fn of_file(file: RegisterFile) -> Arith {
    if file.is_half() { Arith::Half } else { Arith::Main }
}

impl Translator<'_> {
    pub(crate) fn fragment(&mut self, instruction: &Instruction, effects: &mut Vec<Effect>) {
        let value = match (instruction.opcode, instruction.opcode.info().class, instruction.destination) {
            (Opcode::Kil, ..) => return self.kil(instruction, effects),
            (_, OpcodeClass::Texture, Some(_)) => self.fragment_texture(instruction),
            (_, OpcodeClass::Arithmetic, Some(_)) => match self.carried(instruction) {
                Some(bits) => bits,
                None => self.fragment_arithmetic(instruction),
            },
            _ => return,
        };
        self.fragment_writes(instruction, value, effects);
    }

    /// Loads an operand in the format of its file, then applies swizzle, absolute value and negation.
    fn loaded(&mut self, source: &Source, negate: u8) -> NodeVector {
        let k = of_file(source.register.file);
        std::array::from_fn(|i| {
            let raw = match source.swizzle.0[i] {
                4 => self.make.zero(),
                5 => self.make.one(k),
                c => {
                    let held = self.held(&source.register, usize::from(c & 3));
                    self.number(held)
                }
            };
            let modified = self.make.modified(k, source.modifier, raw);
            if negate >> i & 1 == 1 { self.make.neg(k, modified) } else { modified }
        })
    }

    /// Loads an operand in the format of the operation.
    fn fragment_operand(&mut self, source: &Source, to: Arith, negate: u8) -> NodeVector {
        let from = of_file(source.register.file);
        self.loaded(source, negate).map(|x| self.make.convert(from, to, x))
    }

    /// Interprets a value that may be arbitrary bits as the encoded number.
    pub(crate) fn number(&mut self, node: NodeId) -> NodeId {
        if !self.words.contains(&node) {
            return node;
        }
        self.make.graph.node(NodeKind::Convert(Arith::Main, Arith::Main, node))
    }

    /// The bits of a full-precision register's contents.
    fn word(&mut self, node: NodeId) -> NodeId {
        if self.words.contains(&node) { node } else { self.make.unary(Arith::Main, Op::Encode, node) }
    }

    /// Returns `true` if full-precision registers can hold any 32 bits.
    fn keeps_words(&self) -> bool {
        let format = self.make.formats.format(Arith::Main);
        format.width() == 32 && !format.is_fixed()
    }

    /// A result that is moved as bits: a packed word, or the source of a plain `MOV` from `R#`.
    fn carried(&mut self, instruction: &Instruction) -> Option<NodeVector> {
        let destination = instruction.destination?;
        let source = instruction.sources.first()?;
        if destination.register.file.is_half() || destination.saturate {
            return None;
        }
        let plain = source.modifier == Modifier::None && source.register.file == RegisterFile::Temp;
        match instruction.opcode {
            Opcode::Mov if plain && instruction.precision() == Precision::Full && instruction.format.is_none() => {
                Some(source.swizzle.0.map(|c| self.held(&source.register, usize::from(c & 3))))
            }
            Opcode::Pk2h | Opcode::Pk2us | Opcode::Pk4b | Opcode::Pk4ub => {
                let word = self.packed(instruction.opcode, source);
                Some([self.stored_word(word); 4])
            }
            _ => None,
        }
    }

    /// Contents of a full-precision register after a word is written to it.
    fn stored_word(&mut self, word: NodeId) -> NodeId {
        if self.keeps_words() {
            self.words.insert(word);
            return word;
        }
        let mask = self.make.formats.format(Arith::Main).mask();
        let mask = self.make.graph.constant(mask);
        let low = self.make.binary(Arith::Single, Op::And, word, mask);
        self.make.unary(Arith::Main, Op::Decode, low)
    }

    /// The result of a packing instruction.
    fn packed(&mut self, opcode: Opcode, source: &Source) -> NodeId {
        let value = self.fragment_operand(source, Arith::Main, 0);
        let mut word = self.make.zero();
        if opcode == Opcode::Pk2h {
            for (i, shift) in [0, 16].into_iter().enumerate() {
                let half = self.make.convert(Arith::Main, Arith::Half, value[i]);
                word = self.make.join(Arith::Half, Op::JoinPattern, word, half, shift);
            }
            return word;
        }
        let (parts, code) = match opcode {
            Opcode::Pk2us => (2, Op::JoinShort),
            Opcode::Pk4ub => (4, Op::JoinByte),
            _ => (4, Op::JoinSignedByte),
        };
        for (i, &number) in (0u32..parts).zip(&value) {
            let single = self.make.convert(Arith::Main, Arith::Single, number);
            word = self.make.join(Arith::Single, code, word, single, i * (32 / parts));
        }
        word
    }

    fn unpacked(&mut self, opcode: Opcode, source: &Source) -> NodeVector {
        let plain = source.modifier == Modifier::None && source.register.file == RegisterFile::Temp;
        let word = match plain {
            true => {
                let held = self.held(&source.register, usize::from(source.swizzle.0[0] & 3));
                self.word(held)
            }
            false => {
                let value = self.fragment_operand(source, Arith::Main, 0)[0];
                self.make.unary(Arith::Main, Op::Encode, value)
            }
        };
        let mut part = |code, shift| self.make.immediate(Arith::Main, code, word, shift);
        match opcode {
            Opcode::Up2us => {
                let (x, y) = (part(Op::SplitShort, 0), part(Op::SplitShort, 16));
                [x, y, x, y]
            }
            Opcode::Up4ub => [0, 8, 16, 24].map(|shift| part(Op::SplitByte, shift)),
            Opcode::Up4b => [0, 8, 16, 24].map(|shift| part(Op::SplitSignedByte, shift)),
            _ => {
                let [x, y] = [0, 16].map(|shift| {
                    let half = self.make.immediate(Arith::Half, Op::SplitPattern, word, shift);
                    self.make.convert(Arith::Half, Arith::Main, half)
                });
                [x, y, x, y]
            }
        }
    }

    /// The result in the format of the destination.
    fn fragment_arithmetic(&mut self, instruction: &Instruction) -> NodeVector {
        let Some(destination) = instruction.destination else { return [self.make.zero(); 4] };
        let k = self.arith(instruction);
        let raw = self.fragment_raw(instruction, k);
        let (to, storage) = (of_file(destination.register.file), self.storage(destination.register.file));
        raw.map(|x| {
            let clamped = if destination.saturate { self.make.saturate_number(k, x) } else { x };
            let left = self.make.convert(k, to, clamped);
            self.make.stored(to, storage, left)
        })
    }

    /// The result in the format of the operation.
    fn fragment_raw(&mut self, instruction: &Instruction, k: Arith) -> NodeVector {
        let zero = self.make.zero();
        let opcode = instruction.opcode;
        match (opcode, instruction.sources.first()) {
            (Opcode::Pk2h | Opcode::Pk2us | Opcode::Pk4b | Opcode::Pk4ub, Some(source)) => {
                let word = self.packed(opcode, source);
                let stored = self.stored_word(word);
                let number = self.number(stored);
                return [self.make.convert(Arith::Main, k, number); 4];
            }
            (Opcode::Up2h | Opcode::Up2us | Opcode::Up4b | Opcode::Up4ub, Some(source)) => {
                return self.unpacked(opcode, source).map(|x| self.make.convert(Arith::Main, k, x));
            }
            _ => {}
        }
        let mut s = [[zero; 4]; 3];
        for (slot, source) in s.iter_mut().zip(&instruction.sources) {
            *slot = self.fragment_operand(source, k, instruction.fragment.negate);
        }
        self.make.operation(k, (opcode, self.program.version), &s, &[zero; 4])
    }

    fn fragment_texture(&mut self, instruction: &Instruction) -> NodeVector {
        let zero = self.make.zero();
        let (Some(destination), [source, sampler, rest @ ..]) = (instruction.destination, &*instruction.sources) else {
            return [zero; 4];
        };
        let mut coordinates = self.place(source);
        let cube = instruction.fragment.target == Some(TextureTarget::Cube);
        if instruction.opcode == Opcode::TexLdP && !(cube && self.program.version == Version::Fp1_0) {
            let w = coordinates[3];
            for c in &mut coordinates[..3] {
                *c = self.make.div(Arith::Single, *c, w);
            }
        }
        let detail = match (instruction.opcode, rest) {
            (Opcode::TexLdB, _) => Detail::Biased(coordinates[3]),
            (Opcode::TexLdD, [x, y]) => Detail::Gradients(self.place(x), self.place(y)),
            _ => Detail::Implicit,
        };
        let mut texel = self.fetch(usize::from(sampler.register.index), coordinates, detail);
        if instruction.format.is_some() {
            let k = self.arith(instruction);
            texel = self.through(k, texel);
        }
        let (to, storage) = (of_file(destination.register.file), self.storage(destination.register.file));
        texel.map(|x| {
            let clamped = if destination.saturate { self.make.saturate_number(Arith::Main, x) } else { x };
            let left = self.make.convert(Arith::Main, to, clamped);
            self.make.stored(to, storage, left)
        })
    }

    /// An operand in single precision: `f[TEX#]` as interpolated, other registers converted.
    fn place(&mut self, source: &Source) -> NodeVector {
        if source.register.file == RegisterFile::Texture {
            return source.swizzle.0.map(|c| {
                let own = self.coordinate(source.register.index, usize::from(c & 3));
                self.make.modified(Arith::Single, source.modifier, own)
            });
        }
        let from = of_file(source.register.file);
        self.loaded(source, 0).map(|x| self.make.convert(from, Arith::Single, x))
    }

    /// Mask of the lanes in which a component's condition holds.
    fn passes(&mut self, condition: &Condition, component: usize) -> NodeId {
        let code = self.codes[usize::from(condition.swizzle.0[component] & 3)];
        let all = self.make.graph.constant(TRUE);
        let mut either = |a, b| self.make.binary(Arith::Single, Op::Or, a, b);
        match condition.test {
            ConditionTest::Eq => code.equal,
            ConditionTest::Lt => code.less,
            ConditionTest::Gt => code.greater,
            ConditionTest::Le => either(code.less, code.equal),
            ConditionTest::Ge => either(code.greater, code.equal),
            ConditionTest::Ne => self.inverted(code.equal),
            ConditionTest::Tr => all,
            ConditionTest::Fl => self.make.zero(),
        }
    }

    /// `condition ? a : b`, simplified for constant conditions and equal operands.
    fn chosen(&mut self, condition: NodeId, a: NodeId, b: NodeId) -> NodeId {
        match self.make.graph.kind(condition) {
            NodeKind::Constant(TRUE) => a,
            NodeKind::Constant(0) => b,
            _ if a == b => a,
            _ => self.make.select(condition, a, b),
        }
    }

    /// Selects between two values of a register by a condition; packed words are selected as bits.
    fn merged(&mut self, condition: NodeId, new: NodeId, old: NodeId) -> NodeId {
        let words = self.words.contains(&new) || self.words.contains(&old);
        if !words {
            return self.chosen(condition, new, old);
        }
        let (new, old) = (self.word(new), self.word(old));
        let merged = self.chosen(condition, new, old);
        self.words.insert(merged);
        merged
    }

    /// Writes a result subject to mask and condition, and updates the condition codes.
    fn fragment_writes(&mut self, instruction: &Instruction, value: NodeVector, effects: &mut Vec<Effect>) {
        let Some(destination) = &instruction.destination else { return };
        let (file, index) = (destination.register.file, destination.register.index);
        let condition = instruction.fragment.condition;
        let mut allowed = [self.make.graph.constant(TRUE); 4];
        if let Some(condition) = &condition {
            allowed = std::array::from_fn(|i| self.passes(condition, i));
        }
        if instruction.fragment.updates {
            for i in destination.mask.components() {
                self.update(of_file(file), i, allowed[i], value[i]);
            }
        }
        if matches!(file, RegisterFile::Discard | RegisterFile::HalfDiscard) {
            return;
        }
        for i in destination.mask.components() {
            // Depth is a scalar: one component with any mask.
            let depth = file == RegisterFile::DepthOut;
            let place = if depth { (file, 0, 0) } else { (file, index, i as u8) };
            let zero = self.make.zero();
            let old = self.registers.get(&place).copied().unwrap_or(zero);
            let mut merged = self.merged(allowed[i], value[i], old);
            if depth {
                merged = self.number(merged);
            }
            effects.push(Effect::Write(place, merged, None));
            if depth {
                return;
            }
        }
    }

    fn update(&mut self, k: Arith, component: usize, allowed: NodeId, value: NodeId) {
        let value = self.number(value);
        let zero = self.make.zero();
        let new = CodeNodes {
            less: self.make.holds(k, Op::Less, value, zero),
            equal: self.make.holds(k, Op::Equal, value, zero),
            greater: self.make.holds(k, Op::Less, zero, value),
        };
        let old = self.codes[component];
        self.codes[component] = CodeNodes {
            less: self.chosen(allowed, new.less, old.less),
            equal: self.chosen(allowed, new.equal, old.equal),
            greater: self.chosen(allowed, new.greater, old.greater),
        };
    }

    /// Initial condition codes.
    pub(crate) fn first_codes(make: &mut super::arith::GraphBuilder<'_>) -> [CodeNodes; 4] {
        let (zero, all) = (make.zero(), make.graph.constant(TRUE));
        [CodeNodes { less: zero, equal: all, greater: zero }; 4]
    }

    fn kil(&mut self, instruction: &Instruction, effects: &mut Vec<Effect>) {
        if let Some(condition) = &instruction.fragment.condition {
            for i in 0..4 {
                let mask = self.passes(condition, i);
                effects.push(Effect::Kill(mask));
            }
        }
        if let Some(source) = instruction.sources.first() {
            let zero = self.make.zero();
            let k = of_file(source.register.file);
            for x in self.loaded(source, 0) {
                let below = self.make.holds(k, Op::Less, x, zero);
                effects.push(Effect::Kill(below));
            }
        }
    }

    /// The final colour, in the register format.
    pub(crate) fn fragment_color(&mut self, half: bool) -> NodeVector {
        let file = if half { RegisterFile::HalfColorOut } else { RegisterFile::ColorOut };
        std::array::from_fn(|c| {
            let zero = self.make.zero();
            let held = self.registers.get(&(file, 0, c as u8)).copied().unwrap_or(zero);
            let number = self.number(held);
            self.make.convert(of_file(file), Arith::Main, number)
        })
    }
}
