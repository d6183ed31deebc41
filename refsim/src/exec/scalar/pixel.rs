//! Pixel programs, a quad at a time.

use super::interpreter::Interpreter;
use super::prepared::Prepared;
use super::registers::LANES;
use crate::device::Rules;
use crate::event::SAMPLERS;
use crate::exec::usage::registers_delivered;
use crate::exec::{CheckedProgram, DepthValue, FragmentResult, Observer, PixelBindings, delivered_color};
use crate::isa::{Register, RegisterFile};
use crate::num::{Format, ops};
use crate::raster::{COLOR_COMPONENT, ComponentMask, FragmentInput, POSITION_COMPONENT, TEXCOORD_COMPONENT};

/// A pixel program ready to run on fragments.
pub struct PixelProgram<'a> {
    prepared: Prepared<'a>,
}

impl<'a> PixelProgram<'a> {
    /// Prepares a program, which must be a pixel program, to run under `rules` with `bindings`, however long that
    /// takes.
    pub fn new(program: &'a CheckedProgram, rules: &'a Rules, bindings: &PixelBindings<'a>) -> Self {
        Self { prepared: Prepared::pixel(program, rules, bindings) }
    }

    /// The same within a step budget.
    pub(super) fn within(mut self, budget: u32) -> Self {
        self.prepared.set_budget(budget);
        self
    }

    /// The interpolated components that the program can read; the others need not be filled in.
    pub fn inputs_read(&self) -> ComponentMask {
        self.prepared.reads
    }

    /// A colour as instructions read it.
    fn color(&self, interpolated: [u32; 4]) -> [u32; 4] {
        interpolated.map(|x| delivered_color(self.prepared.rules, x))
    }

    /// What is interpolated in FP32 as arithmetic instructions read it.
    fn coordinates(&self, interpolated: [u32; 4]) -> [u32; 4] {
        interpolated.map(|x| ops::convert(&Format::FP32, self.prepared.format, x).bits)
    }

    /// The fog coordinate as instructions of OpenGL's programs read it.
    fn fog(&self, input: &FragmentInput) -> [u32; 4] {
        let [x, ..] = self.coordinates([input.fog; 4]);
        [x, 0, 0, self.prepared.format.one()]
    }

    /// The input registers that hold interpolated values, as instructions read them.
    pub(super) fn delivered(&self, input: &FragmentInput) -> Vec<(Register, [u32; 4])> {
        let value = |register: &Register| {
            let number = usize::from(register.index);
            match register.file {
                RegisterFile::Input => self.color(input.v[number]),
                RegisterFile::FogIn => self.fog(input),
                RegisterFile::WindowPosition => self.coordinates(input.position),
                _ => self.coordinates(input.t[number]),
            }
        };
        registers_delivered(self.prepared.program).into_iter().map(|register| (register, value(&register))).collect()
    }

    /// Runs a quad: lanes (0, 0), (1, 0), (0, 1), (1, 1). Bit `i` of `covered` is set for lanes that are fragments; the
    /// others run as helpers, of which the observer is told too, but whose results mean nothing. Texture reads of
    /// covered lanes are added to `fetches`. Gives also the instruction in front of which each lane was cut off, if it
    /// was.
    pub fn run<O: Observer>(
        &self,
        inputs: &[FragmentInput; LANES],
        covered: u8,
        fetches: &mut [u64; SAMPLERS],
        observer: &mut O,
    ) -> ([FragmentResult; LANES], [Option<usize>; LANES]) {
        let prepared = &self.prepared;
        let (format, version) = (prepared.format, prepared.program.version);
        let mut run = Interpreter::new(prepared, 0b1111, observer);
        run.covered = covered;
        for (lane, input) in inputs.iter().enumerate() {
            run.coordinates[lane] = input.t;
            let registers = &mut run.lanes[lane];
            for (number, color) in input.v.iter().enumerate() {
                if prepared.reads.has(COLOR_COMPONENT + 4 * number) {
                    registers.input[number] = self.color(*color);
                }
            }
            for (number, set) in input.t.iter().enumerate() {
                if version.reads_coordinates() && prepared.reads.has(TEXCOORD_COMPONENT + 4 * number) {
                    registers.texture[number] = self.coordinates(*set);
                }
            }
        }
        if let Some(fragment) = &mut run.fragment {
            for (lane, input) in inputs.iter().enumerate() {
                fragment.fog[lane] = self.fog(input);
                if prepared.reads.has(POSITION_COMPONENT) {
                    fragment.position[lane] = self.coordinates(input.position);
                }
            }
        }
        run.run();
        for (total, more) in fetches.iter_mut().zip(run.fetches) {
            *total += more;
        }
        let mut results = [FragmentResult::default(); LANES];
        for (lane, result) in results.iter_mut().enumerate() {
            let registers = &run.lanes[lane];
            result.killed = run.killed >> lane & 1 == 1;
            result.depth = run.depth[lane]
                .or(registers.depth_out.map(|bits| (format, bits)))
                .map(|(format, bits)| DepthValue { format, bits });
            result.colors = registers.color_out;
            if let Some(fragment) = &run.fragment {
                result.colors[0] = fragment.color(prepared.program, lane, result.colors[0]);
            }
            if version.is_ps_1_x() {
                result.colors[0] = registers.temp[0].map(|x| ops::saturate01(format, x).bits);
            }
        }
        (results, run.cut_at)
    }
}
