//! The interpreter: executes a program on the four lanes of a quad in lockstep, including stores and observer calls.
//!
//! A vertex is executed as a quad with one active lane. Lanes masked off by flow control keep their registers. Helper
//! lanes (outside the primitive) also execute, to provide derivatives; their results are discarded.

use super::alu::Alu;
use super::fragment_state::FragmentState;
use super::operation::{self, Context};
use super::prepared::Prepared;
use super::registers::{Components, LANES, Registers, finished, operand};
use crate::event::SAMPLERS;
use crate::exec::{Observer, Step};
use crate::isa::{Comparison, Instruction, Mask, Opcode, OpcodeClass, RegisterFile, Source};
use crate::num::{Flags, Format};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ArithmeticUnit {
    /// The register format.
    Full,
    /// The format of `_pp` instructions, or the register format if the device has none.
    Partial,
    /// Suffix H in OpenGL's fragment programs.
    Half,
    /// Suffix X in OpenGL's fragment programs.
    Fixed,
    /// The current instruction's own format.
    Own,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum OpenBlock {
    /// `if`
    If {
        /// Lanes reactivated at `endif`.
        restore: u8,
        /// Lanes that execute `else`.
        otherwise: u8,
    },
    /// `rep`, `loop`
    Loop {
        /// Lanes that have not left by `break`.
        live: u8,
        /// Lanes reactivated after the loop.
        restore: u8,
        /// Remaining iterations, including the current one.
        left: i32,
        /// Increment of `aL`.
        step: i32,
        /// Value of `aL` outside the loop.
        outer_counter: i32,
    },
    /// `call`
    Call {
        /// Lanes reactivated after the call.
        restore: u8,
        /// The instruction after the call.
        back: usize,
    },
}

/// Execution state of a quad.
pub(super) struct Interpreter<'p, 'a, O> {
    pub(super) prepared: &'p Prepared<'a>,
    pub(super) lanes: [Registers; LANES],
    /// Interpolated coordinates `t#`, single precision patterns, before any conversion.
    pub(super) coordinates: [[Components; 8]; LANES],
    /// Dot products stored by `texm3x2pad` and `texm3x3pad`, single precision.
    pub(super) padded: [[u32; 2]; LANES],
    /// Number of dot products in `padded`.
    pub(super) pads: usize,
    pub(super) full: Alu<'a>,
    /// Arithmetic of `_pp` instructions, if the device has a format for them.
    partial: Option<Alu<'a>>,
    /// Arithmetic of the current instruction, if it has its own format.
    pub(super) own: Option<Alu<'a>>,
    /// Single precision arithmetic of texture addresses.
    pub(super) address: Alu<'a>,
    /// Lanes enabled by flow control, one bit each.
    pub(super) active: u8,
    /// Lanes covered by the primitive.
    pub(super) covered: u8,
    pub(super) killed: u8,
    /// Depth written by the program, per lane.
    pub(super) depth: [Option<(Format, u32)>; LANES],
    pub(super) loop_counter: i32,
    pub(super) open: Vec<OpenBlock>,
    /// Instruction slots executed while at least one lane was active.
    pub(super) slots: u64,
    pub(super) fetches: [u64; SAMPLERS],
    pub(super) flags: [Flags; LANES],
    /// Steps executed, if a budget is enforced, and the instruction before which a lane was stopped.
    pub(super) steps: [u32; LANES],
    pub(super) cut_at: [Option<usize>; LANES],
    pub(super) fragment: Option<Box<FragmentState<'a>>>,
    pub(super) observer: &'p mut O,
}

impl<'p, 'a, O: Observer> Interpreter<'p, 'a, O> {
    pub(super) fn new(prepared: &'p Prepared<'a>, active: u8, observer: &'p mut O) -> Self {
        let rules = prepared.rules;
        let unit = |format| prepared.alu(format);
        Self {
            prepared,
            lanes: [const { Registers::new() }; LANES],
            coordinates: [[[0; 4]; 8]; LANES],
            padded: [[0; 2]; LANES],
            pads: 0,
            full: unit(prepared.format),
            partial: rules.partial.filter(|_| prepared.is_pixel()).map(unit),
            own: None,
            address: Alu::plain(rules, Format::FP32),
            active,
            covered: active,
            killed: 0,
            depth: [None; LANES],
            loop_counter: 0,
            open: Vec::new(),
            slots: 0,
            fetches: [0; SAMPLERS],
            flags: [Flags::empty(); LANES],
            steps: [0; LANES],
            cut_at: [None; LANES],
            fragment: prepared.program.version.is_fragment_program().then(|| Box::new(FragmentState::new(rules))),
            observer,
        }
    }

    /// The unit of an arithmetic instruction: its own format, or else `otherwise`.
    pub(super) fn unit_of(&mut self, instruction: &Instruction, otherwise: ArithmeticUnit) -> ArithmeticUnit {
        let Some(format) = instruction.format else { return otherwise };
        self.own = Some(self.prepared.alu(format));
        ArithmeticUnit::Own
    }

    pub(super) fn alu(&mut self, unit: ArithmeticUnit) -> &mut Alu<'a> {
        let chosen = match unit {
            ArithmeticUnit::Full => None,
            ArithmeticUnit::Partial => self.partial.as_mut(),
            ArithmeticUnit::Half => self.fragment.as_mut().map(|f| &mut f.half),
            ArithmeticUnit::Fixed => self.fragment.as_mut().map(|f| &mut f.fixed),
            ArithmeticUnit::Own => self.own.as_mut(),
        };
        chosen.unwrap_or(&mut self.full)
    }

    /// Executes the program to its end.
    pub(super) fn run(&mut self) {
        let program = self.prepared.program;
        let mut at = 0;
        loop {
            let Some(instruction) = program.instructions.get(at) else {
                match self.return_from_call() {
                    Some(back) => at = back,
                    None => return,
                }
                continue;
            };
            // In Direct3D programs `arithmetic` executes a co-issued pair at once. In OpenGL programs the second
            // instruction is executed separately, but does not count as a step.
            if let Some(budget) = self.prepared.budget
                && instruction.opcode != Opcode::Phase
                && !(self.fragment.is_some() && instruction.coissue)
            {
                self.charge(at, budget);
            }
            if self.active != 0 {
                let cost = instruction.opcode.info().slot_cost(program.version);
                self.slots += u64::from(cost.arithmetic) + u64::from(cost.texture);
            }
            if self.fragment.is_some() {
                self.fragment_instruction(at, instruction);
                at += 1;
                continue;
            }
            at = match instruction.opcode.info().class {
                OpcodeClass::Flow => match self.flow(at, instruction) {
                    Some(next) => next,
                    None => return,
                },
                OpcodeClass::Marker => {
                    if instruction.opcode == Opcode::Phase {
                        self.phase();
                    }
                    at + 1
                }
                OpcodeClass::Texture => {
                    if self.active != 0 {
                        self.texture(at, instruction);
                    }
                    at + 1
                }
                OpcodeClass::Arithmetic => self.arithmetic(at, instruction),
            };
        }
    }

    pub(super) fn active_lanes(&self) -> impl Iterator<Item = usize> + use<'p, 'a, O> {
        let active = self.active;
        (0..LANES).filter(move |&lane| active >> lane & 1 == 1)
    }

    /// `phase`: keeps the colour of every temporary and clears its alpha. Cards leave alpha undefined; here it is zero.
    fn phase(&mut self) {
        for lane in &mut self.lanes {
            for register in &mut lane.temp {
                register[3] = 0;
            }
        }
    }

    /// Executes an arithmetic instruction, or a co-issued pair, which reads the state before the pair. Returns the next
    /// instruction.
    fn arithmetic(&mut self, at: usize, instruction: &Instruction) -> usize {
        let program = self.prepared.program;
        let partner = program.instructions.get(at + 1).filter(|_| self.prepared.flow.pairs_with_next(at));
        let next = if partner.is_some() { at + 2 } else { at + 1 };
        if self.active == 0 {
            return next;
        }
        let mut results = [[0; 4]; LANES];
        let mut paired = [[0; 4]; LANES];
        for lane in self.active_lanes() {
            results[lane] = self.result(lane, instruction);
            if let Some(partner) = partner {
                let kept = self.flags[lane];
                paired[lane] = self.result(lane, partner);
                self.flags[lane] |= kept;
            }
        }
        for lane in self.active_lanes() {
            self.store(at, lane, instruction, results[lane]);
            if let Some(partner) = partner {
                self.store(at + 1, lane, partner, paired[lane]);
            }
        }
        next
    }

    /// Computes the result of an arithmetic instruction in one lane, ready to be stored.
    fn result(&mut self, lane: usize, instruction: &Instruction) -> Components {
        let Some(destination) = &instruction.destination else {
            return [0; 4];
        };
        let opcode = instruction.opcode;
        let bump = match opcode {
            Opcode::Bem => self.prepared.bump_in_format(destination.register.index),
            _ => [0; 4],
        };
        let registers = self.prepared.format;
        let hint = if destination.partial_precision { ArithmeticUnit::Partial } else { ArithmeticUnit::Full };
        let unit = self.unit_of(instruction, hint);
        let s = self.operands(lane, instruction, |this, lane, source, wanted| this.source(lane, source, wanted, unit));
        let rows = opcode.matrix();
        let mut matrix = [[0; 4]; 4];
        if let (Some((count, _)), Some(source)) = (rows, instruction.sources.get(1)) {
            for (row, slot) in (0..count).zip(&mut matrix) {
                let mut source = *source;
                source.register.index = source.register.index.saturating_add(row);
                *slot = self.source(lane, &source, opcode.lanes_read(1, destination.mask), unit);
            }
        }
        let version = self.prepared.program.version;
        let alu = self.alu(unit);
        let raw = match rows {
            Some((_, terms)) => {
                let mut product = [0; 4];
                for i in destination.mask.components() {
                    product[i] = alu.dot(&s[0][..terms], &matrix[i][..terms]);
                }
                product
            }
            None => {
                let bump = bump.map(|element| alu.enter(registers, element));
                let context = Context { version, bump, mask: destination.mask };
                operation::compute(alu, opcode, &s, &context)
            }
        };
        let done = match opcode {
            // A comparison mask or an address is not a number of the register format, so it needs no final steps.
            Opcode::Setp => {
                let comparison = instruction.comparison.unwrap_or(Comparison::Eq);
                let mut truth = [0; 4];
                for i in destination.mask.components() {
                    truth[i] = u32::from(compare(alu, comparison, s[0][i], s[1][i]));
                }
                truth
            }
            Opcode::Mova => s[0],
            _ if destination.register.file == RegisterFile::Address => s[0],
            _ => finished(alu, registers, destination, raw),
        };
        self.flags[lane] = alu.take_flags();
        done
    }

    /// The operands of an instruction in one lane, each loaded by `load`. For `dsx` and `dsy` the two operands come
    /// from the two lanes of a row or column of the quad, and the second is subtracted from the first: both lanes get
    /// the same value, and inactive lanes contribute the contents of their registers.
    pub(super) fn operands(
        &mut self,
        lane: usize,
        instruction: &Instruction,
        mut load: impl FnMut(&mut Self, usize, &Source, Mask) -> Components,
    ) -> [Components; 3] {
        let opcode = instruction.opcode;
        let written = instruction.destination.map_or(Mask::ALL, |destination| destination.mask);
        let pair = match opcode {
            Opcode::Dsx => Some([lane | 1, lane & 2]),
            Opcode::Dsy => Some([lane | 2, lane & 1]),
            _ => None,
        };
        let mut operands = [[0; 4]; 3];
        if let (Some(pair), Some(source)) = (pair, instruction.sources.first()) {
            for (operand, lane) in operands.iter_mut().zip(pair) {
                *operand = load(self, lane, source, written);
            }
            return operands;
        }
        for (index, (operand, source)) in operands.iter_mut().zip(&instruction.sources).enumerate() {
            *operand = load(self, lane, source, opcode.lanes_read(index, written));
        }
        operands
    }

    /// Loads an operand of one lane in the format of the operation.
    pub(super) fn source(&mut self, lane: usize, source: &Source, wanted: Mask, unit: ArithmeticUnit) -> Components {
        let prepared = self.prepared;
        let value = self.lanes[lane].value(&source.register, &prepared.constants, self.loop_counter);
        operand(self.alu(unit), prepared.format, source, value, wanted)
    }

    /// Clamps a result to the rules' range, rounds it to its storage's format, writes it subject to mask and predicate,
    /// and notifies the observer.
    pub(super) fn store(&mut self, at: usize, lane: usize, instruction: &Instruction, mut value: Components) {
        let Some(destination) = &instruction.destination else {
            return;
        };
        let prepared = self.prepared;
        let registers = &mut self.lanes[lane];
        let mut mask = destination.mask;
        if let Some(predicate) = &instruction.predicate {
            for i in destination.mask.components() {
                let bit = registers.predicate[usize::from(predicate.swizzle.0[i] & 3)];
                if bit == predicate.not {
                    mask.0 &= !(1 << i);
                }
            }
        }
        match destination.register.file {
            RegisterFile::Predicate => {
                for i in mask.components() {
                    registers.predicate[i] = value[i] != 0;
                }
            }
            RegisterFile::Address => {
                for i in mask.components() {
                    registers.address[i] = super::address_value(self.prepared.format, instruction.opcode, value[i]);
                }
            }
            _ => {
                let storage = prepared.written(destination.register.file);
                for i in mask.components() {
                    value[i] = self.full.in_range(value[i]);
                    value[i] = self.full.stored(prepared.format, storage, value[i]);
                }
                registers.write(&destination.register, mask, value);
            }
        }
        self.notify(at, lane, Some((mask, value)));
    }

    /// Notifies the observer that a lane has executed an instruction.
    pub(super) fn notify(&mut self, at: usize, lane: usize, written: Option<(Mask, Components)>) {
        self.assign_flags(lane);
        let flags = std::mem::take(&mut self.flags[lane]);
        if O::ACTIVE {
            let (mask, value) = written.unwrap_or((Mask(0), [0; 4]));
            self.observer.executed(&Step { instruction: at, lane, mask, value, flags });
        }
    }

    /// Assigns the flags raised since the last call to a lane; discards them if the lane is inactive.
    pub(super) fn assign_flags(&mut self, lane: usize) {
        let partial = self.partial.as_mut().map(Alu::take_flags).unwrap_or_default();
        let own = self.own.as_mut().map(Alu::take_flags).unwrap_or_default();
        let fragment = self.fragment.as_mut().map(|f| f.take_flags()).unwrap_or_default();
        let raised = self.full.take_flags() | self.address.take_flags() | partial | own | fragment;
        if self.active >> lane & 1 == 1 {
            self.flags[lane] |= raised;
        }
    }

    /// Compares the first components of two operands of one lane (`if_`, `break_`).
    pub(super) fn compare_sources(&mut self, lane: usize, instruction: &Instruction) -> bool {
        let [a, b] = [instruction.sources.first(), instruction.sources.get(1)];
        let (Some(a), Some(b)) = (a, b) else {
            return false;
        };
        let x = self.source(lane, a, Mask(1), ArithmeticUnit::Full)[0];
        let y = self.source(lane, b, Mask(1), ArithmeticUnit::Full)[0];
        // A branch writes no result, so it reports no flags.
        self.full.take_flags();
        compare(&self.full, instruction.comparison.unwrap_or(Comparison::Eq), x, y)
    }
}

/// Compares two numbers. A comparison with NaN is false, except `ne`.
fn compare(alu: &Alu<'_>, comparison: Comparison, a: u32, b: u32) -> bool {
    match comparison {
        Comparison::Gt => alu.less(b, a),
        Comparison::Lt => alu.less(a, b),
        Comparison::Ge => alu.less_or_equal(b, a),
        Comparison::Le => alu.less_or_equal(a, b),
        Comparison::Eq => alu.equal(a, b),
        Comparison::Ne => !alu.equal(a, b),
    }
}
