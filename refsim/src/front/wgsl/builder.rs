//! Emits instructions on virtual registers: each instruction writes a new register, with few exceptions.

use std::collections::{BTreeMap, BTreeSet};

use super::super::Refusal;
use super::values::{Component, Value};
use crate::isa::{
    Condition, ConditionTest, Destination, FIRST_LITERAL, FragmentPart, Instruction, Mask, Modifier, Opcode, Precision,
    Register, RegisterFile, Source, Span, Swizzle, TextureTarget,
};

/// Maximum number of instructions before unused ones are removed.
const MAX_INSTRUCTIONS: usize = 1 << 15;

/// Four literals of the text in one register; `None` for free components.
type Literal = [Option<u32>; 4];

/// The instructions emitted so far, and the state that they share.
#[derive(Default)]
pub(super) struct Builder {
    pub(super) instructions: Vec<Instruction>,
    pub(super) literals: Vec<Literal>,
    pub(super) span: Span,
    /// `true` if the next instruction computes in f16.
    pub(super) half: bool,
    gathered: BTreeMap<Value, (Register, Vec<u8>)>,
    /// The conditions from which the condition codes were last set.
    codes: Value,
    codes_vary: bool,
    /// Temporaries whose values differ between fragments.
    varying: BTreeSet<u16>,
    /// The loops that are being unrolled, outermost first.
    pub(super) loops: Vec<Span>,
    registers: u16,
}

/// The bits of a component known at translation, as a single-precision number.
fn known(component: &Component) -> Option<u32> {
    match component {
        Component::Float(bits) => Some(*bits),
        Component::Bool(value) => Some(f32::from(u8::from(*value)).to_bits()),
        _ => None,
    }
}

impl Builder {
    pub(super) fn refuse<T>(&self, message: impl Into<String>) -> Result<T, Refusal> {
        Err(Refusal::new(message, self.span))
    }

    /// Returns the error for programs with too many steps.
    pub(super) fn too_long<T>(&self) -> Result<T, Refusal> {
        let most = MAX_INSTRUCTIONS;
        Err(match self.loops.last() {
            Some(span) => Refusal::new(
                format!("this loop has no known end, or is unrolled into more than {most} instructions"),
                *span,
            )
            .with_help("bound loops by constants: `for (var i = 0; i < 16; i++)`"),
            None => Refusal::new(format!("the shader has more than {most} instructions after translation"), self.span)
                .with_help("functions are inlined at every call: shorten the shader, or use fewer calls"),
        })
    }

    /// Returns `true` if a component differs between fragments.
    pub(super) fn varies(&self, component: Component) -> bool {
        matches!(component, Component::Place(register, _) if self.is_varying(register))
    }

    fn is_varying(&self, register: Register) -> bool {
        match register.file {
            RegisterFile::Temp => self.varying.contains(&register.index),
            file => matches!(file, RegisterFile::Texture | RegisterFile::WindowPosition),
        }
    }

    fn new_register(&mut self) -> Register {
        self.registers += 1;
        Register::new(RegisterFile::Temp, self.registers)
    }

    fn push(&mut self, opcode: Opcode, to: Option<(Register, u8)>, sources: Vec<Source>) -> Result<(), Refusal> {
        if self.instructions.len() >= MAX_INSTRUCTIONS {
            return self.too_long();
        }
        let is_read = matches!(opcode, Opcode::TexLd | Opcode::TexLdD);
        let varies = is_read || sources.iter().any(|source| self.is_varying(source.register));
        match to {
            Some((Register { file: RegisterFile::Temp, index, .. }, _)) if varies => drop(self.varying.insert(index)),
            Some((Register { file: RegisterFile::Discard, .. }, _)) => self.codes_vary = varies,
            _ => {}
        }
        let destination = to.map(|(register, mask)| Destination::new(register, Mask(mask), self.span));
        let precision = (self.half && !is_read && opcode != Opcode::Kil).then_some(Precision::Half);
        let target = is_read.then_some(TextureTarget::D2);
        let fragment = FragmentPart { precision, target, ..FragmentPart::default() };
        let instruction = Instruction::new(opcode, destination, sources, self.span);
        self.instructions.push(Instruction { fragment, ..instruction });
        Ok(())
    }

    fn last(&mut self) -> Option<&mut FragmentPart> {
        self.instructions.last_mut().map(|instruction| &mut instruction.fragment)
    }

    /// Returns a register of literals that contains these numbers, and the components where they are.
    fn literal(&mut self, numbers: &[u32]) -> (Register, Vec<u8>) {
        let fits = |literal: &Literal| {
            let mut filled = *literal;
            let place = |number: &u32| {
                let at = filled.iter().position(|n| *n == Some(*number));
                let at = at.or_else(|| filled.iter().position(Option::is_none))?;
                filled[at] = Some(*number);
                Some(at as u8)
            };
            let lanes: Option<Vec<u8>> = numbers.iter().map(place).collect();
            lanes.map(|lanes| (filled, lanes))
        };
        let found = (0..self.literals.len()).find_map(|index| Some((index, fits(&self.literals[index])?)));
        let (index, (filled, lanes)) = found.unwrap_or_else(|| {
            self.literals.push([None; 4]);
            // An empty register always has room for up to four numbers.
            (self.literals.len() - 1, fits(&[None; 4]).unwrap_or_default())
        });
        self.literals[index] = filled;
        (Register::new(RegisterFile::Constant, FIRST_LITERAL + index as u16), lanes)
    }

    /// Returns a register that contains all components, and the components where they are; moves them into one register
    /// if they are in several.
    fn gather(&mut self, components: &[Component]) -> Result<(Register, Vec<u8>), Refusal> {
        if let Some(numbers) = components.iter().map(known).collect::<Option<Vec<u32>>>() {
            return Ok(self.literal(&numbers));
        }
        let mut places = Vec::new();
        for component in components {
            places.push(match (component, known(component)) {
                (Component::Place(register, lane), _) => (*register, *lane),
                (_, Some(number)) => {
                    let (register, lanes) = self.literal(&[number]);
                    (register, lanes[0])
                }
                _ => return self.unknown(),
            });
        }
        // An interpolated operand would force a half-precision instruction to full precision.
        let direct = !(self.half && matches!(places[0].0.file, RegisterFile::Texture | RegisterFile::WindowPosition));
        if direct && places.iter().all(|(register, _)| *register == places[0].0) {
            return Ok((places[0].0, places.iter().map(|(_, lane)| *lane).collect()));
        }
        if let Some(known) = self.gathered.get(components) {
            return Ok(known.clone());
        }
        let (register, half) = (self.new_register(), std::mem::take(&mut self.half));
        let mut done = 0;
        for first in 0..places.len() {
            if done >> first & 1 == 1 {
                continue;
            }
            let mut swizzle = [places[first].1; 4];
            let mut mask = 0;
            for (lane, place) in places.iter().enumerate().filter(|(_, place)| place.0 == places[first].0) {
                swizzle[lane] = place.1;
                mask |= 1 << lane;
            }
            done |= mask;
            let source = self.operand(places[first].0, swizzle, Modifier::None);
            self.push(Opcode::Mov, Some((register, mask)), vec![source])?;
        }
        self.half = half;
        let lanes: Vec<u8> = (0..components.len() as u8).collect();
        self.gathered.insert(components.to_vec(), (register, lanes.clone()));
        Ok((register, lanes))
    }

    /// Returns the error for a use of [`Component::Unknown`].
    pub(super) fn unknown<T>(&self) -> Result<T, Refusal> {
        let message = "expected a whole number that is known when the shader is translated, found one that is computed";
        Err(Refusal::new(message, self.span).with_help("count with constants, and compute with f32 or f16"))
    }

    fn operand(&self, register: Register, swizzle: [u8; 4], modifier: Modifier) -> Source {
        Source { register, swizzle: Swizzle(swizzle), modifier, span: self.span }
    }

    fn source(&mut self, components: &[Component], modifier: Modifier) -> Result<Source, Refusal> {
        let (register, lanes) = self.gather(components)?;
        let last = lanes[lanes.len() - 1];
        Ok(self.operand(register, [0, 1, 2, 3].map(|i| lanes.get(i).copied().unwrap_or(last)), modifier))
    }

    /// Emits an operation on operands with modifiers. The result has `width` components, 1 to 4.
    pub(super) fn modified(
        &mut self,
        opcode: Opcode,
        operands: &[(&[Component], Modifier)],
        width: usize,
    ) -> Result<Value, Refusal> {
        let each = opcode.is_scalar();
        let mut sources = Vec::new();
        for (components, modifier) in operands {
            sources.push(self.source(components, *modifier)?);
        }
        let register = self.new_register();
        for lane in 0..if each { width } else { 1 } {
            let mask = if each { 1 << lane } else { (1 << width) - 1 };
            let one = |s: &Source| Source { swizzle: Swizzle::replicate(s.swizzle.0[lane]), ..*s };
            let sources = if each { sources.iter().map(one).collect() } else { sources.clone() };
            self.push(opcode, Some((register, mask)), sources)?;
        }
        Ok((0..width as u8).map(|lane| Component::Place(register, lane)).collect())
    }

    /// Emits an operation whose result is as wide as its widest operand.
    pub(super) fn op(&mut self, opcode: Opcode, operands: &[&[Component]]) -> Result<Value, Refusal> {
        let width = operands.iter().map(|operand| operand.len()).max().unwrap_or(1);
        self.wide(opcode, operands, width)
    }

    pub(super) fn wide(&mut self, opcode: Opcode, operands: &[&[Component]], width: usize) -> Result<Value, Refusal> {
        let plain: Vec<_> = operands.iter().map(|operand| (*operand, Modifier::None)).collect();
        self.modified(opcode, &plain, width)
    }

    pub(super) fn negate(&mut self, value: &[Component]) -> Result<Value, Refusal> {
        self.modified(Opcode::Mov, &[(value, Modifier::Negate)], value.len())
    }

    /// Emits a read of a texel from image unit `unit`.
    pub(super) fn texel(&mut self, opcode: Opcode, unit: u16, operands: &[&[Component]]) -> Result<Value, Refusal> {
        let half = std::mem::take(&mut self.half);
        let mut sources = Vec::new();
        for operand in operands {
            sources.push(self.source(operand, Modifier::None)?);
        }
        sources.insert(1, self.operand(Register::new(RegisterFile::Sampler, unit), [0, 1, 2, 3], Modifier::None));
        let register = self.new_register();
        self.push(opcode, Some((register, 0b1111)), sources)?;
        self.half = half;
        Ok((0..4).map(|lane| Component::Place(register, lane)).collect())
    }

    pub(super) fn output(&mut self, register: Register, mask: u8, value: &[Component]) -> Result<(), Refusal> {
        self.half = false;
        let source = self.source(value, Modifier::None)?;
        self.push(Opcode::Mov, Some((register, mask)), vec![source])
    }

    /// Sets the condition codes from conditions, each 0 or 1.
    fn set_codes(&mut self, conditions: &[Component]) -> Result<(), Refusal> {
        if self.codes != conditions {
            let source = self.source(conditions, Modifier::None)?;
            let mask = (1 << conditions.len()) - 1;
            self.push(Opcode::Mov, Some((Register::new(RegisterFile::Discard, 0), mask)), vec![source])?;
            self.last().into_iter().for_each(|fragment| fragment.updates = true);
            self.codes = conditions.to_vec();
        }
        Ok(())
    }

    fn set_condition(&mut self, swizzle: [u8; 4]) {
        let condition = Condition { test: ConditionTest::Ne, swizzle: Swizzle(swizzle), span: self.span };
        let written = self.instructions.last().and_then(|instruction| instruction.destination);
        self.varying.extend(written.filter(|_| self.codes_vary).map(|destination| destination.register.index));
        self.last().into_iter().for_each(|fragment| fragment.condition = Some(condition));
    }

    pub(super) fn kill(&mut self, condition: Component) -> Result<(), Refusal> {
        self.half = false;
        self.set_codes(&[condition])?;
        self.push(Opcode::Kil, None, Vec::new())?;
        self.set_condition([0; 4]);
        Ok(())
    }

    /// Selects `accept` where the conditions hold (one for all components, or one each), else `reject`; for any number
    /// of components.
    pub(super) fn select(
        &mut self,
        conditions: &[Component],
        accept: &[Component],
        reject: &[Component],
    ) -> Result<Value, Refusal> {
        let half = std::mem::take(&mut self.half);
        let mut result = reject.to_vec();
        let mut open = Vec::new();
        for (lane, value) in result.iter_mut().enumerate() {
            let condition = conditions[lane.min(conditions.len() - 1)];
            match (condition, accept[lane], reject[lane]) {
                (_, a, b) if a == b => {}
                (Component::Bool(true), a, _) => *value = a,
                (Component::Bool(false), _, _) => {}
                (Component::Unknown, _, _) => return self.unknown(),
                (_, Component::Int(_) | Component::Unknown, _) | (_, _, Component::Int(_) | Component::Unknown) => {
                    *value = Component::Unknown;
                }
                (condition, a @ Component::Bool(_), b) | (condition, a, b @ Component::Bool(_)) => {
                    *value = self.choose(condition, a, b)?;
                }
                (condition, ..) => open.push((lane, condition)),
            }
        }
        for chunk in open.chunks(4) {
            let of = |value: &[Component]| -> Value { chunk.iter().map(|(lane, _)| value[*lane]).collect() };
            let each: Value = chunk.iter().map(|(_, condition)| *condition).collect();
            let same = each.iter().all(|condition| *condition == each[0]);
            let (otherwise, chosen) = (of(reject), of(accept));
            self.set_codes(if same { &each[..1] } else { &each })?;
            let register = self.new_register();
            for (value, conditional) in [(otherwise, false), (chosen, true)] {
                let source = self.source(&value, Modifier::None)?;
                self.push(Opcode::Mov, Some((register, (1 << chunk.len()) - 1)), vec![source])?;
                if conditional {
                    self.set_condition(if same { [0; 4] } else { [0, 1, 2, 3] });
                }
            }
            for (lane, (at, _)) in chunk.iter().enumerate() {
                result[*at] = Component::Place(register, lane as u8);
            }
        }
        self.half = half;
        Ok(result)
    }

    /// Selects between two conditions by a third.
    fn choose(&mut self, condition: Component, a: Component, b: Component) -> Result<Component, Refusal> {
        let (a, b) = match (a, b) {
            (Component::Bool(true), b) => return self.or(condition, b),
            (a, Component::Bool(false)) => return self.and(condition, a),
            pair => pair,
        };
        let not = self.not(condition)?;
        if a == Component::Bool(false) { self.and(not, b) } else { self.or(not, a) }
    }

    pub(super) fn not(&mut self, a: Component) -> Result<Component, Refusal> {
        match a {
            Component::Bool(value) => Ok(Component::Bool(!value)),
            _ => Ok(self.op(Opcode::Seq, &[&[a], &[Component::Float(0)]])?[0]),
        }
    }

    pub(super) fn and(&mut self, a: Component, b: Component) -> Result<Component, Refusal> {
        match (a, b) {
            (Component::Bool(false), _) | (_, Component::Bool(false)) => Ok(Component::Bool(false)),
            (Component::Bool(true), x) | (x, Component::Bool(true)) => Ok(x),
            _ if a == b => Ok(a),
            _ => Ok(self.op(Opcode::Min, &[&[a], &[b]])?[0]),
        }
    }

    pub(super) fn or(&mut self, a: Component, b: Component) -> Result<Component, Refusal> {
        match (a, b) {
            (Component::Bool(true), _) | (_, Component::Bool(true)) => Ok(Component::Bool(true)),
            (Component::Bool(false), x) | (x, Component::Bool(false)) => Ok(x),
            _ if a == b => Ok(a),
            _ => Ok(self.op(Opcode::Max, &[&[a], &[b]])?[0]),
        }
    }
}
