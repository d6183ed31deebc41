//! Execution of pixel programs, one quad at a time.

use super::alu::Alu;
use super::interpreter::Interpreter;
use super::prepared::Prepared;
use super::registers::LANES;
use crate::device::{Rules, Storage};
use crate::event::SAMPLERS;
use crate::exec::usage::registers_delivered;
use crate::exec::{CheckedProgram, DepthValue, FragmentResult, Observer, PixelBindings, delivered_color};
use crate::isa::{Register, RegisterFile, Version};
use crate::num::{Format, ops};
use crate::raster::{COLOR_COMPONENT, ComponentMask, FragmentInput, POSITION_COMPONENT, TEXCOORD_COMPONENT};

/// A pixel program prepared for a draw.
pub struct PixelProgram<'a> {
    prepared: Prepared<'a>,
}

impl<'a> PixelProgram<'a> {
    /// Prepares a pixel program to run under `rules` with `bindings`, without a step budget.
    pub fn new(program: &'a CheckedProgram, rules: &'a Rules, bindings: &PixelBindings<'a>) -> Self {
        Self { prepared: Prepared::pixel(program, rules, bindings) }
    }

    pub(super) fn within(mut self, budget: u32) -> Self {
        self.prepared.set_budget(budget);
        self
    }

    /// Interpolated components that the program can read; other components need not be provided.
    pub fn inputs_read(&self) -> ComponentMask {
        self.prepared.reads
    }

    /// Converts an interpolated colour to the value that instructions read.
    fn color(&self, interpolated: [u32; 4]) -> [u32; 4] {
        let delivered = interpolated.map(|x| delivered_color(self.prepared.rules, x));
        self.stored(Storage::Colors, self.prepared.format, delivered)
    }

    /// Interpolated texture coordinates, rounded to their storage's format, single precision.
    fn delivered_coordinates(&self, interpolated: [u32; 4]) -> [u32; 4] {
        self.stored(Storage::Coordinates, Format::FP32, interpolated)
    }

    /// Rounds numbers of a format to the format of a storage.
    fn stored(&self, storage: Storage, format: Format, value: [u32; 4]) -> [u32; 4] {
        let rules = self.prepared.rules;
        match rules.storage.of(storage) {
            Some(storage) => value.map(|x| Alu::new(rules, format).stored(format, Some(storage), x)),
            None => value,
        }
    }

    /// Converts interpolated fp32 values to the values that arithmetic instructions read.
    fn coordinates(&self, interpolated: [u32; 4]) -> [u32; 4] {
        interpolated.map(|x| ops::convert(&Format::FP32, self.prepared.format, x).bits)
    }

    /// The fog coordinate as read by instructions of OpenGL programs: its fourth component is 1 for ARB, 0 for NV.
    fn fog(&self, input: &FragmentInput) -> [u32; 4] {
        let [x, ..] = self.coordinates([input.fog; 4]);
        let arb = self.prepared.program.version == Version::ArbFp1_0;
        [x, 0, 0, if arb { self.prepared.format.one() } else { 0 }]
    }

    /// Input registers with interpolated values, as read by instructions.
    pub(super) fn delivered(&self, input: &FragmentInput) -> Vec<(Register, [u32; 4])> {
        let value = |register: &Register| {
            let number = usize::from(register.index);
            match register.file {
                RegisterFile::Input => self.color(input.v[number]),
                RegisterFile::FogIn => self.fog(input),
                RegisterFile::WindowPosition => self.coordinates(input.position),
                _ => self.coordinates(self.delivered_coordinates(input.t[number])),
            }
        };
        registers_delivered(self.prepared.program).into_iter().map(|register| (register, value(&register))).collect()
    }

    /// Executes a quad with lanes (0, 0), (1, 0), (0, 1), (1, 1). Bit `i` of `covered` is set if lane `i` is a
    /// fragment; other lanes are helpers: the observer sees them, but their results are meaningless. Texture reads of
    /// covered lanes are added to `fetches`. Also returns, per lane, the instruction before which the step budget
    /// stopped the lane, if it did.
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
            run.coordinates[lane] = input.t.map(|set| self.delivered_coordinates(set));
            let registers = &mut run.lanes[lane];
            for (number, color) in input.v.iter().enumerate() {
                if prepared.reads.has(COLOR_COMPONENT + 4 * number) {
                    registers.input[number] = self.color(*color);
                }
            }
            for (number, set) in run.coordinates[lane].into_iter().enumerate() {
                if version.reads_coordinates() && prepared.reads.has(TEXCOORD_COMPONENT + 4 * number) {
                    registers.texture[number] = self.coordinates(set);
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
            // No version has both oDepth and a texture instruction that writes depth.
            result.depth = run.depth[lane]
                .or(registers.depth_out.map(|bits| (format, bits)))
                .map(|(format, bits)| DepthValue { format, bits });
            result.colors = registers.color_out;
            if let Some(fragment) = &run.fragment {
                result.colors[0] = fragment.color(prepared.program, lane, result.colors[0]);
            }
            if version.is_ps_1_x() {
                let clamped = registers.temp[0].map(|x| ops::saturate01(format, x).bits);
                result.colors[0] = self.stored(Storage::Outputs, format, clamped);
            }
        }
        (results, run.cut_at)
    }
}
