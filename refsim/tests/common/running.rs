//! Runs a program from text on one quad, and records every step; draws over a whole target.
#![allow(dead_code, reason = "shared by several test binaries, each of which takes what it needs")]

use refsim::asm::assemble;
use refsim::device::{Profile, Rules};
use refsim::exec::scalar::{PixelProgram, VertexProgram, VertexResult};
use refsim::exec::{CheckedProgram, Constants, FragmentResult, NoObserver, PixelBindings, Step, Trace};
use refsim::isa::Program;
use refsim::machine::{DrawCall, TextureId, VertexSource};
use refsim::num::{Format, ops};
use refsim::raster::{FragmentInput, PixelCenter, Primitive, Vertex, full_screen_quad};
use refsim::texture::{Image, TargetRounding, TexelFormat, TextureKind};

/// Assembles and checks a program; panics with all errors if it fails.
pub(crate) fn checked(text: &str, profile: &Profile) -> CheckedProgram {
    let program = assemble(text).unwrap_or_else(|e| panic!("{text}\n{e:?}"));
    ready(program, profile).unwrap_or_else(|e| panic!("{text}\n{e}"))
}

pub(crate) fn ready(program: Program, profile: &Profile) -> Result<CheckedProgram, String> {
    refsim::check::check(program, profile).map_err(|e| format!("{e:?}"))
}

pub(crate) fn ideal(format: &str) -> Profile {
    Profile::named(&format!("ideal-{format}")).unwrap()
}

/// Single precision patterns.
pub(crate) fn bits(v: [f32; 4]) -> [u32; 4] {
    v.map(f32::to_bits)
}

/// Converts a single-precision vector to a format.
pub(crate) fn into(format: Format, v: [f32; 4]) -> [u32; 4] {
    bits(v).map(|x| ops::convert(&Format::FP32, format, x).bits)
}

/// Constants from c0 on.
pub(crate) fn constants(values: &[[f32; 4]]) -> Constants {
    Constants { float: values.iter().map(|&v| bits(v)).collect(), ..Constants::default() }
}

/// Result of a program on a quad whose lanes have equal inputs.
pub(crate) struct QuadRun {
    pub(crate) results: [FragmentResult; 4],
    pub(crate) steps: Vec<Step>,
    pub(crate) fetches: [u64; 16],
}

impl QuadRun {
    /// Value that the last execution of instruction `index` wrote in lane 0.
    pub(crate) fn value(&self, index: usize) -> [u32; 4] {
        let step = self.steps.iter().rev().find(|s| s.instruction == index);
        step.unwrap_or_else(|| panic!("instruction {index} did not run")).value
    }
}

/// Runs a pixel program on a quad of inputs.
pub(crate) fn run_quad(
    text: &str,
    profile: &Profile,
    bindings: &PixelBindings<'_>,
    inputs: &[FragmentInput; 4],
) -> QuadRun {
    let program = checked(text, profile);
    run_program(&program, &profile.rules, bindings, inputs)
}

pub(crate) fn run_program(
    program: &CheckedProgram,
    rules: &Rules,
    bindings: &PixelBindings<'_>,
    inputs: &[FragmentInput; 4],
) -> QuadRun {
    let mut trace = Trace::of_lane(0);
    let mut fetches = [0; 16];
    let prepared = PixelProgram::new(program, rules, bindings);
    let results = prepared.run(inputs, 0b1111, &mut fetches, &mut trace).0;
    QuadRun { results, steps: trace.steps, fetches }
}

/// Runs a pixel program that reads only constants.
pub(crate) fn run(text: &str, profile: &Profile, values: &[[f32; 4]]) -> QuadRun {
    let constants = constants(values);
    run_quad(text, profile, &PixelBindings::new(&constants), &[FragmentInput::default(); 4])
}

/// Runs a pixel program with coordinate sets from t0 on.
pub(crate) fn run_with_coordinates(text: &str, profile: &Profile, sets: &[[f32; 4]]) -> QuadRun {
    let constants = Constants::default();
    run_quad(text, profile, &PixelBindings::new(&constants), &[input(sets); 4])
}

/// A fragment with coordinate sets from t0 on.
pub(crate) fn input(sets: &[[f32; 4]]) -> FragmentInput {
    let mut input = FragmentInput::default();
    for (slot, &set) in input.t.iter_mut().zip(sets) {
        *slot = bits(set);
    }
    input
}

/// Runs a vertex program on attributes from v0 on.
pub(crate) fn run_vertex(text: &str, profile: &Profile, constants: &Constants, values: &[[f32; 4]]) -> VertexResult {
    let program = checked(text, profile);
    let mut attributes = [[0; 4]; 16];
    for (slot, &v) in attributes.iter_mut().zip(values) {
        *slot = bits(v);
    }
    VertexProgram::new(&program, &profile.rules, constants).run(&attributes, &mut NoObserver).0
}

/// A quad over the whole target; its coordinates go from (0, 0) in the first row to (1, 1).
pub(crate) fn screen() -> [Vertex; 4] {
    full_screen_quad(|u, v| [[u, v, 0.0, 1.0]; 8])
}

/// A draw of quads with pixel centers at one half.
pub(crate) fn quads<'a>(
    vertices: &'a [Vertex],
    program: &'a CheckedProgram,
    constants: &'a Constants,
    target: TextureId,
) -> DrawCall<'a> {
    let call = DrawCall::new(VertexSource::Transformed(vertices), Primitive::QuadList, program, constants, target);
    DrawCall { center: PixelCenter::OpenGl, ..call }
}

/// A texture from texels in single precision, row by row.
pub(crate) fn image(format: TexelFormat, [width, height]: [u32; 2], texels: &[[u32; 4]]) -> Image {
    let (kind, extents) = (TextureKind::D2, [width, height, 1]);
    Image::from_values(format, kind, extents, Format::FP32, texels, TargetRounding::Nearest).unwrap()
}
