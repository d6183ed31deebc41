//! Errors of the machine.

use crate::exec::Overrun;
use crate::isa::{Opcode, Program, Span, Stage, Version};
use crate::output::{DepthFormat, OutputError};
use crate::raster::RasterError;
use crate::texture::{TexelFormat, TextureError};

/// What a program ran for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProgramPlace {
    /// A pixel of the targets.
    Pixel {
        /// Column.
        x: u32,
        /// Row.
        y: u32,
    },
    /// A vertex of an instance, both from 0.
    Vertex {
        /// The instance.
        instance: usize,
        /// The vertex.
        vertex: usize,
    },
}

impl std::fmt::Display for ProgramPlace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Pixel { x, y } => write!(f, "pixel ({x}, {y})"),
            Self::Vertex { instance, vertex } => write!(f, "vertex {vertex} of instance {instance}"),
        }
    }
}

/// Why the machine refused a request. Nothing has been changed then.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MachineError {
    /// The GPU that the machine runs on refused or failed. What was drawn into is undefined if a draw had begun.
    #[cfg(feature = "wgpu")]
    #[error(transparent)]
    Gpu(#[from] crate::exec::gpu::GpuError),
    /// The pixel program has no form for GPUs.
    #[cfg(feature = "wgpu")]
    #[error(transparent)]
    GpuProgram(#[from] crate::exec::wgsl::program::ProgramError),
    /// A handle of another machine, or of something released.
    #[error("expected the handle of a live {what}, found {number}, which this machine does not hold")]
    NoSuchResource {
        /// `texture` or `depth buffer`.
        what: &'static str,
        /// The number in the handle.
        number: usize,
    },
    /// The device has no textures of the format.
    #[error("`{device}` has no {format} textures (formats.texture); use one of {allowed}")]
    TextureFormat {
        /// The device.
        device: String,
        /// The format asked for.
        format: TexelFormat,
        /// The formats it has.
        allowed: String,
    },
    /// The device has no targets of the format.
    #[error("`{device}` has no {format} targets (formats.target); use one of {allowed}")]
    TargetFormat {
        /// The device.
        device: String,
        /// The format asked for.
        format: TexelFormat,
        /// The formats it has.
        allowed: String,
    },
    /// The device has no depth buffers of the format.
    #[error("`{device}` has no {format} depth buffers (formats.depth); use one of {allowed}")]
    DepthFormat {
        /// The device.
        device: String,
        /// The format asked for.
        format: DepthFormat,
        /// The formats it has.
        allowed: String,
    },
    /// A texture or target is larger than the device allows.
    #[error("{what} is {width}x{height}, `{device}` allows {limit} a side (limits.{key})")]
    TooLarge {
        /// `texture` or `target`.
        what: &'static str,
        /// The device.
        device: String,
        /// Width asked for.
        width: u32,
        /// Height asked for.
        height: u32,
        /// Largest side.
        limit: u32,
        /// The profile key.
        key: &'static str,
    },
    /// The draw has neither colour target nor depth buffer.
    #[error("the draw has no target; bind a colour target or a depth buffer")]
    NoTarget,
    /// Too many colour targets.
    #[error("draw has {found} colour targets, `{device}` allows {limit} (limits.render_targets)")]
    TooManyTargets {
        /// The device.
        device: String,
        /// How many are bound.
        found: usize,
        /// How many are allowed.
        limit: usize,
    },
    /// The same texture is bound as two targets.
    #[error("texture {number} is bound as two targets of one draw; bind it once")]
    TargetTwice {
        /// The number in the handle.
        number: usize,
    },
    /// Depth state without a depth buffer.
    #[error("the draw tests or writes depth but has no depth buffer; bind one or turn both off")]
    NoDepthBuffer,
    /// A texture is read and written by one draw.
    #[error(
        "sampler {sampler} reads the texture that is target {target} of the same draw; draw into another texture and swap"
    )]
    FeedbackLoop {
        /// The sampler.
        sampler: usize,
        /// The target.
        target: usize,
    },
    /// A program for the wrong stage.
    #[error("expected a {expected:?} program, found `{found}`")]
    WrongStage {
        /// The stage it was given for.
        expected: Stage,
        /// Its version.
        found: Version,
    },
    /// A pixel or vertex did not end within the step budget.
    #[error(
        "{place}: the {version} program made the {budget} steps of its budget and did not end; the next was instruction {}, `{}`",
        instruction + 1, opcode.info().mnemonic
    )]
    StepBudget {
        /// The pixel or vertex.
        place: ProgramPlace,
        /// The program's version.
        version: Version,
        /// The instruction that was one too many, from 0.
        instruction: usize,
        /// Its operation.
        opcode: Opcode,
        /// Where it stands in the program text.
        span: Span,
        /// The budget.
        budget: u32,
    },
    /// A linear filter on a float texture.
    #[error(
        "sampler {sampler} filters a {format} texture, which `{device}` cannot (limits.float_filtering); use nearest filters"
    )]
    FloatFilter {
        /// The sampler.
        sampler: usize,
        /// Format of the texture.
        format: TexelFormat,
        /// The device.
        device: String,
    },
    /// Mip maps of a float texture.
    #[error("texture has {levels} levels of {format}, `{device}` allows 1 (limits.float_mipmaps)")]
    FloatLevels {
        /// Levels of the texture.
        levels: usize,
        /// Its format.
        format: TexelFormat,
        /// The device.
        device: String,
    },
    /// Blending into a float target.
    #[error(
        "target {target} is {format} and blended, which `{device}` cannot (limits.float_blending); turn blending off"
    )]
    FloatBlend {
        /// The target.
        target: usize,
        /// Its format.
        format: TexelFormat,
        /// The device.
        device: String,
    },
    /// More vertices or instances than a draw can have.
    #[error("draw has {found} {what}, a draw can have {limit}; split it")]
    TooMany {
        /// `vertices` or `instances`.
        what: &'static str,
        /// How many it has.
        found: usize,
        /// How many it can have.
        limit: usize,
    },
    /// A vertex stream ends early.
    #[error("stream of v{register} has {found} entries, the draw needs {needed} ({what})")]
    ShortStream {
        /// The attribute register.
        register: usize,
        /// Entries there.
        found: usize,
        /// Entries needed.
        needed: usize,
        /// `one a vertex` or `one an instance`.
        what: &'static str,
    },
    /// An attribute register that does not exist.
    #[error("expected an attribute register v0 to v15, found v{register}")]
    NoSuchAttribute {
        /// The number.
        register: usize,
    },
    /// Two streams feed one register.
    #[error("two streams feed v{register}; leave one out")]
    StreamTwice {
        /// The attribute register.
        register: usize,
    },
    /// An index past the vertices.
    #[error("index {position} is {found}, the draw has {limit} vertices")]
    Index {
        /// Place in the index list.
        position: usize,
        /// The index.
        found: u32,
        /// How many vertices there are.
        limit: usize,
    },
    /// A pixel outside the targets.
    #[error("expected a pixel of the {width}x{height} target, found ({x}, {y}); columns and rows count from 0")]
    NoSuchPixel {
        /// Column.
        x: u32,
        /// Row.
        y: u32,
        /// Width of the targets.
        width: u32,
        /// Height of the targets.
        height: u32,
    },
    /// Something cannot be a target.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The rasteriser refused.
    #[error(transparent)]
    Raster(#[from] RasterError),
    /// An image could not be made or read.
    #[error(transparent)]
    Texture(#[from] TextureError),
    /// The worker threads could not be started.
    #[error("could not start {threads} worker threads: {reason}")]
    Threads {
        /// How many.
        threads: usize,
        /// What the system said.
        reason: String,
    },
}

impl MachineError {
    /// A fragment that did not end within the step budget.
    pub(super) fn overrun(overrun: Overrun, program: &Program, budget: u32) -> Self {
        let Overrun { x, y, instruction, .. } = overrun;
        Self::out_of_steps(ProgramPlace::Pixel { x, y }, instruction, program, budget)
    }

    pub(super) fn out_of_steps(place: ProgramPlace, instruction: usize, program: &Program, budget: u32) -> Self {
        let at = program.instructions.get(instruction);
        let (opcode, span) = at.map_or((Opcode::Nop, program.version_span), |i| (i.opcode, i.span));
        Self::StepBudget { place, version: program.version, instruction, opcode, span, budget }
    }
}
