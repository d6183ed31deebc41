//! Per-pixel execution traces: the [`PixelTracer`] interface between the machine and the executors.
//!
//! A trace is made beside a draw, never during one, so that drawing pays nothing for it: the machine finds the
//! triangles that cover the pixel and hands each to a [`PixelTracer`] with the pixel's targets.

use super::{FragmentResult, Overrun, Step};
use crate::isa::{Instruction, Mask, OpcodeClass, Program, Register, RegisterFile};
use crate::num::{Format, ops};
use crate::output::{FragmentFate, TargetTile};
use crate::raster::{FragmentInput, TriangleSetup};

/// What an executor did with one fragment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shading {
    /// What the rasteriser gave the program, single precision; what the program cannot read is zero. NaN is canonical.
    pub input: FragmentInput,
    /// The input registers that hold interpolated values, as instructions read them: patterns of the register format.
    pub delivered: Vec<(Register, [u32; 4])>,
    /// The instructions that wrote, read texels, killed or decided depth, in the order they ran. Components outside a
    /// step's mask are zero; `oDepth` has one component, the lowest of its mask. Only the scalar executor knows flags.
    pub steps: Vec<Step>,
    /// What the program left behind.
    pub output: FragmentResult,
    /// What became of the fragment.
    pub fate: FragmentFate,
}

/// Shades single fragments and reports every step.
pub trait PixelTracer: Send + Sync {
    /// Draws the fragment of a triangle into the one pixel of `tile`, which the triangle covers.
    ///
    /// # Errors
    /// If the fragment does not end within the step budget; it is of triangle 0 then.
    fn follow(&self, triangle: &TriangleSetup, tile: &mut TargetTile) -> Result<Shading, Overrun>;
}

/// Whether an instruction is one of those that steps are made of.
pub(crate) fn makes_step(instruction: &Instruction) -> bool {
    let class = instruction.opcode.info().class;
    instruction.destination.is_some() && matches!(class, OpcodeClass::Arithmetic | OpcodeClass::Texture)
}

/// The mask of a step whose instruction wrote these components; of `oDepth`, the lowest of its destination's.
pub(crate) fn written_mask(instruction: &Instruction, components: impl Iterator<Item = u8>) -> Mask {
    match instruction.destination {
        Some(d) if d.register.file == RegisterFile::DepthOut => Mask(d.mask.0 & d.mask.0.wrapping_neg()),
        _ => Mask(components.fold(0, |mask, c| mask | 1 << c)),
    }
}

/// A step as a [`Shading`] holds it.
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

/// Inputs with NaN made canonical: executors that compute in host floats keep no payload.
pub(crate) fn canonical(mut input: FragmentInput) -> FragmentInput {
    let clean = |x: &mut u32| *x = ops::convert(&Format::FP32, Format::FP32, *x).bits;
    input.t.iter_mut().chain(&mut input.v).flatten().for_each(clean);
    input.position.iter_mut().for_each(clean);
    clean(&mut input.fog);
    clean(&mut input.depth);
    input
}
