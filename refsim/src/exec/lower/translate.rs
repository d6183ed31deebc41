//! Translation of single instructions to graph nodes: operands, modifiers, results.

use std::collections::{BTreeMap, BTreeSet};

use refsim_lanes::{Slot, TRUE};

use super::arith::{GraphBuilder, NodeVector};
use super::formats::Formats;
use super::graph::{Arith, NodeId, NodeKind};
use crate::device::{ColorIterator, ResultRange, Rules, Storage};
use crate::exec::{BumpStage, PixelBindings, ResolvedConstants};
use crate::isa::{
    Comparison, Destination, Instruction, Modifier, Opcode, Precision, Program, Register, RegisterFile, Relative,
    Source, Stage, Version,
};
use crate::num::{Format, NumberOperation as Op};
use crate::raster::{COLOR_COMPONENT, FOG_COMPONENT, POSITION_COMPONENT, TEXCOORD_COMPONENT};

/// A component of a register: file, number, component.
pub(crate) type RegisterComponent = (RegisterFile, u16, u8);

/// A condition code as masks: less than, equal to, greater than zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CodeNodes {
    pub(super) less: NodeId,
    pub(super) equal: NodeId,
    pub(super) greater: NodeId,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Effect {
    /// Writes a component of a register; the second node is the mask of the predicate, if any.
    Write(RegisterComponent, NodeId, Option<NodeId>),
    /// Kills lanes in which the mask holds.
    Kill(NodeId),
    /// Sets the depth.
    Depth(Arith, NodeId),
}

pub(crate) struct Translator<'a> {
    pub(crate) make: GraphBuilder<'a>,
    pub(crate) program: &'a Program,
    pub(crate) constants: &'a ResolvedConstants,
    pub(crate) bindings: Option<&'a PixelBindings<'a>>,
    /// Current values of registers. In a program with flow control each component has its own slot, and its value is
    /// unknown.
    pub(crate) registers: BTreeMap<RegisterComponent, NodeId>,
    /// The slot of `aL` in a program with flow control.
    pub(crate) loop_counter: Option<Slot>,
    /// Dot products stored by `texm3x2pad` and `texm3x3pad`, and how many are stored.
    pub(crate) padded: [NodeId; 2],
    pub(crate) pads: usize,
    /// Condition codes of an OpenGL program.
    pub(crate) codes: [CodeNodes; 4],
    /// Nodes that may be arbitrary 32 bits rather than canonical numbers.
    pub(crate) words: BTreeSet<NodeId>,
    /// Sampler of each texture read, one entry per instruction.
    pub(crate) fetches: Vec<usize>,
    /// `true` if float constants are inputs from [`CONSTANT_INPUTS`] on, four per register, in the format of the
    /// program; `false` if they are constants of the graph.
    pub(crate) open_constants: bool,
}

/// The first input for constants, after those for 16 attributes.
pub(crate) const CONSTANT_INPUTS: u16 = 64;

impl<'a> Translator<'a> {
    pub(crate) fn new(
        program: &'a Program,
        rules: &'a Rules,
        formats: Formats,
        constants: &'a ResolvedConstants,
        bindings: Option<&'a PixelBindings<'a>>,
    ) -> Self {
        let mut make = GraphBuilder::new(formats, rules, program.version.stage() == Stage::Pixel);
        let zero = make.zero();
        let codes = Self::first_codes(&mut make);
        Self {
            make,
            program,
            constants,
            bindings,
            registers: BTreeMap::new(),
            loop_counter: None,
            padded: [zero; 2],
            pads: 0,
            codes,
            words: BTreeSet::new(),
            fetches: Vec::new(),
            open_constants: false,
        }
    }

    fn is_pixel(&self) -> bool {
        self.program.version.stage() == Stage::Pixel
    }

    pub(crate) fn bump(&self, stage: u16) -> BumpStage {
        self.bindings.and_then(|b| b.bump.get(usize::from(stage)).copied()).unwrap_or_default()
    }

    /// An interpolated coordinate, single precision, rounded to the format of coordinates; zero beyond the last set.
    pub(crate) fn coordinate(&mut self, set: u16, component: usize) -> NodeId {
        if set >= 8 {
            return self.make.zero();
        }
        let number = TEXCOORD_COMPONENT + 4 * usize::from(set) + component;
        let input = self.make.graph.node(NodeKind::Input(number as u16));
        self.make.stored(Arith::Single, self.make.rules.storage.of(Storage::Coordinates), input)
    }

    /// A colour as the program reads it: clamped, rounded to the iterator's precision, converted to the register
    /// format, and rounded to the storage format of colors.
    fn color(&mut self, number: u16, component: usize) -> NodeId {
        let delivered = self.delivered_color(number, component);
        self.make.stored(Arith::Main, self.make.rules.storage.of(Storage::Colors), delivered)
    }

    fn delivered_color(&mut self, number: u16, component: usize) -> NodeId {
        if number >= 2 {
            return self.make.zero();
        }
        let input = COLOR_COMPONENT + 4 * usize::from(number) + component;
        let node = self.make.graph.node(NodeKind::Input(input as u16));
        match self.make.rules.color_iterator {
            ColorIterator::Unorm(width) => {
                let steps = (1u32 << width.clamp(1, 16)) - 1;
                self.make.graph.node(NodeKind::Steps(steps, node))
            }
            ColorIterator::Full => {
                let clamped = self.make.unary(Arith::Single, Op::Saturate, node);
                self.make.convert(Arith::Single, Arith::Main, clamped)
            }
        }
    }

    /// Contents of a register component, in the register format.
    pub(crate) fn held(&mut self, register: &Register, component: usize) -> NodeId {
        let place = (register.file, register.index, component as u8);
        if let Some(&node) = self.registers.get(&place) {
            return node;
        }
        match register.file {
            RegisterFile::Input if self.is_pixel() => self.color(register.index, component),
            RegisterFile::Input if register.index < 16 => {
                let node = self.make.graph.node(NodeKind::Input(4 * register.index + component as u16));
                self.make.convert(Arith::Single, Arith::Main, node)
            }
            RegisterFile::FogIn => match component {
                0 => {
                    let node = self.make.graph.node(NodeKind::Input(FOG_COMPONENT as u16));
                    self.make.convert(Arith::Single, Arith::Main, node)
                }
                3 if self.program.version == Version::ArbFp1_0 => self.make.one(Arith::Main),
                _ => self.make.zero(),
            },
            RegisterFile::WindowPosition => {
                let node = self.make.graph.node(NodeKind::Input((POSITION_COMPONENT + component) as u16));
                self.make.convert(Arith::Single, Arith::Main, node)
            }
            RegisterFile::Texture if self.program.version.reads_coordinates() => {
                let node = self.coordinate(register.index, component);
                self.make.convert(Arith::Single, Arith::Main, node)
            }
            RegisterFile::Constant => self.constant(register, component),
            // Unwritten registers are zero.
            _ => self.make.zero(),
        }
    }

    fn constant(&mut self, register: &Register, component: usize) -> NodeId {
        let address = match register.relative {
            None if self.open_constants => {
                let input = CONSTANT_INPUTS + 4 * register.index + component as u16;
                return self.make.graph.node(NodeKind::Input(input));
            }
            None => {
                let bits = self.constants.float.get(usize::from(register.index)).map_or(0, |c| c[component]);
                return self.make.pattern(Arith::Main, bits);
            }
            Some(Relative::Address(c)) => {
                let zero = self.make.zero();
                self.registers.get(&(RegisterFile::Address, 0, c & 3)).copied().unwrap_or(zero)
            }
            Some(Relative::Loop) => match self.loop_counter {
                Some(slot) => self.make.graph.node(NodeKind::Held(slot)),
                None => self.make.zero(),
            },
        };
        self.make.graph.node(NodeKind::Relative(i32::from(register.index), component as u8, address))
    }

    /// The arithmetic of an instruction: its own format, the format of its precision or of `_pp`, or the register
    /// format.
    pub(crate) fn arith(&self, instruction: &Instruction) -> Arith {
        let partial = instruction.destination.is_some_and(|d| d.partial_precision);
        match instruction.format {
            Some(own) => self.make.formats.arith_of(own),
            None if self.program.version.is_fragment_program() => match instruction.precision() {
                Precision::Full => Arith::Main,
                Precision::Half => Arith::Half,
                Precision::Fixed => Arith::Fixed,
            },
            None if partial && self.is_pixel() && self.make.rules.partial.is_some() => Arith::Partial,
            None => Arith::Main,
        }
    }

    /// Rounds a result in the register format to another, and returns it in the register format.
    pub(crate) fn through(&mut self, k: Arith, value: NodeVector) -> NodeVector {
        value.map(|x| {
            let narrowed = self.make.convert(Arith::Main, k, x);
            self.make.convert(k, Arith::Main, narrowed)
        })
    }

    /// All components of an operand in format `k`, after swizzle and modifier.
    pub(crate) fn operand(&mut self, k: Arith, source: &Source) -> NodeVector {
        std::array::from_fn(|i| {
            let raw = self.held(&source.register, usize::from(source.swizzle.0[i] & 3));
            let converted = self.make.convert(Arith::Main, k, raw);
            self.make.modified(k, source.modifier, converted)
        })
    }

    /// Finishes a component of a result: shift, saturation, conversion to the register format.
    fn finished(&mut self, k: Arith, destination: &Destination, x: NodeId) -> NodeId {
        let shifted = if destination.shift == 0 { x } else { self.make.scale(k, x, destination.shift) };
        let clamped = if destination.saturate { self.make.unary(k, Op::Saturate, shifted) } else { shifted };
        self.make.convert(k, Arith::Main, clamped)
    }

    /// Mask of a predicate for a component; `None` without a predicate.
    pub(crate) fn predicate(&mut self, instruction: &Instruction, component: usize) -> Option<NodeId> {
        let predicate = instruction.predicate?;
        let register = Register::new(RegisterFile::Predicate, 0);
        let bit = self.held(&register, usize::from(predicate.swizzle.0[component] & 3));
        Some(if predicate.not { self.inverted(bit) } else { bit })
    }

    pub(crate) fn inverted(&mut self, mask: NodeId) -> NodeId {
        let all = self.make.graph.constant(TRUE);
        self.make.binary(Arith::Single, Op::AndNot, mask, all)
    }

    /// Clamps a result for a pixel register to [-1, 1] if the rules require it.
    fn in_range(&mut self, x: NodeId) -> NodeId {
        if !self.is_pixel() || self.make.rules.result_range == ResultRange::Format {
            return x;
        }
        let one = self.make.one(Arith::Main);
        let minus = self.make.neg(Arith::Main, one);
        let below = self.make.binary(Arith::Main, Op::Min, x, one);
        self.make.binary(Arith::Main, Op::Max, below, minus)
    }

    /// Format of the values that instructions write to a register file, if different from the file's format.
    pub(crate) fn storage(&self, file: RegisterFile) -> Option<Format> {
        self.make.rules.storage.written(file).filter(|_| self.is_pixel())
    }

    /// Writes the components in the destination's mask.
    pub(crate) fn writes(&mut self, instruction: &Instruction, mut value: NodeVector, effects: &mut Vec<Effect>) {
        let Some(destination) = &instruction.destination else { return };
        let (file, index) = (destination.register.file, destination.register.index);
        if !matches!(file, RegisterFile::Predicate | RegisterFile::Address) {
            let storage = self.storage(file);
            value = value.map(|x| {
                let clamped = self.in_range(x);
                self.make.stored(Arith::Main, storage, clamped)
            });
        }
        if file == RegisterFile::DepthOut {
            // A scalar is taken from the lowest component of the mask.
            if let Some(c) = destination.mask.components().next() {
                let allowed = self.predicate(instruction, c);
                effects.push(Effect::Write((file, 0, 0), value[c], allowed));
            }
            return;
        }
        for c in destination.mask.components() {
            let allowed = self.predicate(instruction, c);
            effects.push(Effect::Write((file, index, c as u8), value[c], allowed));
        }
    }

    pub(crate) fn arithmetic(&mut self, instruction: &Instruction, effects: &mut Vec<Effect>) {
        let Some(destination) = &instruction.destination else { return };
        let k = self.arith(instruction);
        let zero = self.make.zero();
        let mut s = [[zero; 4]; 3];
        for (slot, source) in s.iter_mut().zip(&instruction.sources) {
            *slot = self.operand(k, source);
        }
        let raw = match instruction.opcode {
            Opcode::Setp => {
                let comparison = instruction.comparison.unwrap_or(Comparison::Eq);
                let value = std::array::from_fn(|i| self.comparison(k, comparison, s[0][i], s[1][i]));
                return self.writes(instruction, value, effects);
            }
            opcode if opcode == Opcode::Mova || destination.register.file == RegisterFile::Address => {
                let code = if opcode == Opcode::Mova { Op::AddressNearest } else { Op::AddressFloor };
                let value = s[0].map(|x| self.make.unary(Arith::Main, code, x));
                return self.writes(instruction, value, effects);
            }
            opcode => match opcode.matrix() {
                Some((rows, terms)) => self.matrix(k, instruction, &s[0], rows, terms),
                None => {
                    let bump = self.bump(destination.register.index).matrix;
                    let bump = bump.map(|bits| {
                        let single = self.make.pattern(Arith::Single, bits);
                        let main = self.make.convert(Arith::Single, Arith::Main, single);
                        self.make.convert(Arith::Main, k, main)
                    });
                    self.make.operation(k, (opcode, self.program.version), &s, &bump)
                }
            },
        };
        let value = raw.map(|x| self.finished(k, destination, x));
        self.writes(instruction, value, effects);
    }

    fn matrix(
        &mut self,
        k: Arith,
        instruction: &Instruction,
        vector: &NodeVector,
        rows: u16,
        terms: usize,
    ) -> NodeVector {
        let mut product = [self.make.zero(); 4];
        if let Some(source) = instruction.sources.get(1) {
            for row in 0..rows {
                let mut source = *source;
                source.register.index = source.register.index.saturating_add(row);
                let operand = self.operand(k, &source);
                product[usize::from(row)] = self.make.dot(k, terms, vector, &operand);
            }
            for slot in product.iter_mut().skip(rows.into()) {
                let zeros = [self.make.zero(); 4];
                *slot = self.make.dot(k, terms, vector, &zeros);
            }
        }
        product
    }

    /// Mask of a comparison of two numbers.
    pub(crate) fn comparison(&mut self, k: Arith, comparison: Comparison, a: NodeId, b: NodeId) -> NodeId {
        let (code, a, b) = match comparison {
            Comparison::Gt => (Op::Less, b, a),
            Comparison::Lt => (Op::Less, a, b),
            Comparison::Ge => (Op::LessEqual, b, a),
            Comparison::Le => (Op::LessEqual, a, b),
            Comparison::Eq | Comparison::Ne => (Op::Equal, a, b),
        };
        let holds = self.make.holds(k, code, a, b);
        if comparison == Comparison::Ne { self.inverted(holds) } else { holds }
    }

    /// Mask of a flow instruction's condition.
    pub(crate) fn condition(&mut self, instruction: &Instruction) -> NodeId {
        let [a, b] = [instruction.sources.first(), instruction.sources.get(1)];
        match instruction.opcode {
            Opcode::IfC | Opcode::BreakC => {
                let (Some(a), Some(b)) = (a, b) else { return self.make.zero() };
                let x = self.operand(Arith::Main, a)[0];
                let y = self.operand(Arith::Main, b)[0];
                self.comparison(Arith::Main, instruction.comparison.unwrap_or(Comparison::Eq), x, y)
            }
            Opcode::CallNz => self.boolean_value(b),
            _ => self.boolean_value(a),
        }
    }

    /// Mask of a boolean operand.
    fn boolean_value(&mut self, source: Option<&Source>) -> NodeId {
        let Some(source) = source else { return self.make.zero() };
        let value = match source.register.file {
            RegisterFile::Predicate => {
                let register = Register::new(RegisterFile::Predicate, 0);
                self.held(&register, usize::from(source.swizzle.0[0] & 3))
            }
            RegisterFile::ConstantBool => {
                let set = self.constants.boolean.get(usize::from(source.register.index)).copied().unwrap_or(false);
                self.make.graph.constant(if set { TRUE } else { 0 })
            }
            _ => self.make.zero(),
        };
        if source.modifier == Modifier::Not { self.inverted(value) } else { value }
    }
}
