//! Per-pixel execution traces.
//!
//! Traces are recorded separately from draws, so drawing costs nothing extra: the machine finds the triangles that
//! cover the pixel, and the scalar executor shades each into the pixel's targets. The other executors have no tracer:
//! their values equal the scalar executor's.

use super::{FragmentResult, Step};
use crate::isa::{Instruction, Mask, OpcodeClass, Program, Register, RegisterFile};
use crate::num::{Format, ops};
use crate::output::FragmentFate;
use crate::raster::FragmentInput;

/// Execution of a fragment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shading {
    /// Inputs from the rasteriser, single precision; inputs that the program cannot read are zero. NaNs are canonical.
    pub input: FragmentInput,
    /// Input registers with interpolated values as read by instructions, in the register format.
    pub delivered: Vec<(Register, [u32; 4])>,
    /// The executed instructions that write registers, read texels, kill or write depth, in order. Components outside a
    /// step's mask are zero; `oDepth` has only the lowest component of its mask.
    pub steps: Vec<Step>,
    /// Output of the program.
    pub output: FragmentResult,
    /// Outcome of the fragment.
    pub fate: FragmentFate,
}

/// Returns `true` if an instruction produces a step.
pub(crate) fn makes_step(instruction: &Instruction) -> bool {
    let class = instruction.opcode.info().class;
    instruction.destination.is_some() && matches!(class, OpcodeClass::Arithmetic | OpcodeClass::Texture)
}

/// Mask of a step whose instruction writes these components; for `oDepth`, the lowest component of its destination.
pub(crate) fn written_mask(instruction: &Instruction, components: impl Iterator<Item = u8>) -> Mask {
    match instruction.destination {
        Some(d) if d.register.file == RegisterFile::DepthOut => Mask(d.mask.0 & d.mask.0.wrapping_neg()),
        _ => Mask(components.fold(0, |mask, c| mask | 1 << c)),
    }
}

/// Converts a step to the form that [`Shading`] stores.
pub(crate) fn as_written(mut step: Step, program: &Program) -> Step {
    let destination = program.instructions.get(step.instruction).and_then(|i| i.destination);
    if destination.is_some_and(|d| d.register.file == RegisterFile::DepthOut) {
        // Only the lowest component of the mask is written.
        step.mask.0 &= step.mask.0.wrapping_neg();
    }
    for (c, value) in step.value.iter_mut().enumerate() {
        if !step.mask.contains(c) {
            *value = 0;
        }
    }
    step
}

/// Makes NaNs in the inputs canonical, because executors with host floats keep no payload.
pub(crate) fn canonical(mut input: FragmentInput) -> FragmentInput {
    let clean = |x: &mut u32| *x = ops::convert(&Format::FP32, Format::FP32, *x).bits;
    input.t.iter_mut().chain(&mut input.v).flatten().for_each(clean);
    input.position.iter_mut().for_each(clean);
    clean(&mut input.fog);
    clean(&mut input.depth);
    input
}
