//! Errors of the machine.

use crate::exec::Overrun;
use crate::isa::{Opcode, Program, Span, Stage, Version};
use crate::output::{DepthFormat, OutputError};
use crate::raster::RasterError;
use crate::texture::{TexelFormat, TextureError};

/// The pixel or vertex at which a program failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the variants explain the fields")]
pub enum ProgramPlace {
    /// A pixel, by column and row of the targets.
    Pixel { x: u32, y: u32 },
    /// A vertex of an instance, both numbered from 0.
    Vertex { instance: usize, vertex: usize },
}

impl std::fmt::Display for ProgramPlace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Pixel { x, y } => write!(f, "pixel ({x}, {y})"),
            Self::Vertex { instance, vertex } => write!(f, "vertex {vertex} of instance {instance}"),
        }
    }
}

/// Error of a machine. It leaves the machine unchanged, unless the variant states otherwise.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages explain the fields")]
pub enum MachineError {
    /// The host GPU of the machine failed. Targets are undefined if a draw had begun.
    #[cfg(feature = "wgpu")]
    #[error(transparent)]
    Gpu(#[from] crate::exec::gpu::GpuError),
    /// The pixel program cannot be encoded for GPUs.
    #[error(transparent)]
    GpuProgram(#[from] crate::exec::wgsl::program::ProgramError),
    /// A handle of a `texture` or `depth buffer` that was released or belongs to another machine.
    #[error("expected the handle of a live {what}, found {number}, which this machine does not hold")]
    NoSuchResource { what: &'static str, number: usize },
    /// The device does not support textures of the format.
    #[error("`{device}` has no {format} textures (formats.texture); use one of {allowed}")]
    TextureFormat { device: String, format: TexelFormat, allowed: String },
    /// The device does not support targets of the format.
    #[error("`{device}` has no {format} targets (formats.target); use one of {allowed}")]
    TargetFormat { device: String, format: TexelFormat, allowed: String },
    /// The device does not support depth buffers of the format.
    #[error("`{device}` has no {format} depth buffers (formats.depth); use one of {allowed}")]
    DepthFormat { device: String, format: DepthFormat, allowed: String },
    /// A `texture` or `target` is larger than the device allows.
    #[error("{what} is {width}x{height}, `{device}` allows {limit} per side (limits.{key})")]
    TooLarge { what: &'static str, device: String, width: u32, height: u32, limit: u32, key: &'static str },
    /// A volume texture is larger than the device allows.
    #[error("volume texture is {width}x{height}x{depth}, `{device}` allows {limit} per side (limits.max_volume_size)")]
    VolumeTooLarge { device: String, width: u32, height: u32, depth: u32, limit: u32 },
    /// The draw has neither a colour target nor a depth buffer.
    #[error("the draw has no target; bind a colour target or a depth buffer")]
    NoTarget,
    /// Too many colour targets.
    #[error("draw has {found} colour targets, `{device}` allows {limit} (limits.render_targets)")]
    TooManyTargets { device: String, found: usize, limit: usize },
    /// The same texture is bound as two targets.
    #[error("texture {number} is bound as two targets of one draw; bind it once")]
    TargetTwice { number: usize },
    /// Depth state without a depth buffer.
    #[error("the draw tests or writes depth but has no depth buffer; bind one or turn both off")]
    NoDepthBuffer,
    /// A texture is both read and written by one draw.
    #[error(
        "sampler {sampler} reads the texture that is target {target} of the same draw; draw into another texture and swap"
    )]
    FeedbackLoop { sampler: usize, target: usize },
    /// A program of the wrong stage.
    #[error("expected a {expected:?} program, found `{found}`")]
    WrongStage { expected: Stage, found: Version },
    /// A pixel or vertex exceeded the step budget. `instruction` is the index, from 0, of the first instruction beyond
    /// the budget.
    #[error(
        "{place}: the {version} program did not end within its budget of {budget} steps; the next was instruction {}, `{}`",
        instruction + 1, opcode.info().mnemonic
    )]
    StepBudget { place: ProgramPlace, version: Version, instruction: usize, opcode: Opcode, span: Span, budget: u32 },
    /// A linear filter on a float texture, which the device does not support.
    #[error(
        "sampler {sampler} filters a {format} texture, which `{device}` cannot (limits.float_filtering); use nearest filters"
    )]
    FloatFilter { sampler: usize, format: TexelFormat, device: String },
    /// Mip maps of a float texture, which the device does not support.
    #[error(
        "texture has {levels} levels of {format}, `{device}` allows 1 (limits.float_mipmaps); keep each level in a separate texture"
    )]
    FloatLevels { levels: usize, format: TexelFormat, device: String },
    /// Generation of mip levels of a float texture that the device cannot filter.
    #[error(
        "texture {number} is {format}, whose mip levels `{device}` cannot generate (limits.{key}); draw each level by a program that reads four texels of the previous level, into a separate texture"
    )]
    FloatMipmaps { number: usize, format: TexelFormat, device: String, key: &'static str },
    /// Generation of mip levels of a rectangle texture.
    #[error("texture {number} is a rectangle, which has no mip levels; make it a 2-D texture")]
    RectangleMipmaps { number: usize },
    /// Generation of mip levels of a texture that has level 0 only.
    #[error(
        "texture {number} was made with level 0 alone; make it with up to {possible} levels to have them generated"
    )]
    NoLevels { number: usize, possible: u32 },
    /// Blending into a float target, which the device does not support.
    #[error(
        "target {target} is {format} and blended, which `{device}` cannot (limits.float_blending); turn blending off"
    )]
    FloatBlend { target: usize, format: TexelFormat, device: String },
    /// More `vertices` or `instances` than the limit of a draw.
    #[error("draw has {found} {what}, a draw can have {limit}; split it")]
    TooMany { what: &'static str, found: usize, limit: usize },
    /// A vertex stream is too short; `what` is `one per vertex` or `one per instance`.
    #[error("stream of v{register} has {found} entries, the draw needs {needed} ({what})")]
    ShortStream { register: usize, found: usize, needed: usize, what: &'static str },
    /// An attribute register that does not exist.
    #[error("expected an attribute register v0 to v15, found v{register}")]
    NoSuchAttribute { register: usize },
    /// Two streams for the same register.
    #[error("two streams feed v{register}; remove one")]
    StreamTwice { register: usize },
    /// An index is not less than the number of vertices.
    #[error("index {position} is {found}, the draw has {limit} vertices")]
    Index { position: usize, found: u32, limit: usize },
    /// A pixel outside the targets.
    #[error("expected a pixel of the {width}x{height} target, found ({x}, {y}); columns and rows count from 0")]
    NoSuchPixel { x: u32, y: u32, width: u32, height: u32 },
    /// An image cannot be a target.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// An error of the rasteriser.
    #[error(transparent)]
    Raster(#[from] RasterError),
    /// An error of creating or reading an image.
    #[error(transparent)]
    Texture(#[from] TextureError),
    /// The worker threads could not be started.
    #[error("could not start {threads} worker threads: {reason}")]
    Threads { threads: usize, reason: String },
}

impl MachineError {
    /// A fragment exceeded the step budget.
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
