//! A draw call as data.

use super::{DepthId, TextureId};
use crate::event::SAMPLERS;
use crate::exec::{BUMP_STAGES, BumpStage, CheckedProgram, Constants, Projection};
use crate::output::{AlphaTest, BlendState, DepthState, MAX_TARGETS, OutputState, WriteMask};
use crate::raster::{ClipSpace, Cull, PixelCenter, Primitive, Provoking, Vertex, Viewport};
use crate::texture::{Region, SamplerState};

/// Attributes that a stream does not feed: (0, 0, 0, 1) in single precision.
pub const DEFAULT_ATTRIBUTE: [u32; 4] = [0, 0, 0, 0x3f80_0000];

/// The step rate of a stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StepRate {
    /// From one vertex to the next; it starts over with each instance.
    Vertex,
    /// From one instance to the next; all vertices of an instance see the same entry.
    Instance,
}

/// The values of one attribute register.
#[derive(Clone, Copy, Debug)]
pub struct AttributeStream<'a> {
    /// The register: n for `v#n`, 0 to 15.
    pub register: usize,
    /// Its step rate.
    pub step: StepRate,
    /// The values, single precision patterns: one per vertex or one per instance.
    pub data: &'a [[u32; 4]],
}

/// Vertices for a vertex program: `instance_count` copies of `vertex_count` vertices.
///
/// The crossbar draws so: four corners of a screen-filling quad in streams that step by vertex, N primitives in
/// streams that step by instance, and the one call draws N quads in order, as N calls would.
#[derive(Clone, Debug)]
pub struct VertexStreams<'a> {
    /// Vertices of one instance.
    pub vertex_count: usize,
    /// Instances.
    pub instance_count: usize,
    /// The streams; registers without one hold [`DEFAULT_ATTRIBUTE`].
    pub streams: Vec<AttributeStream<'a>>,
}

/// The vertices of a draw.
#[derive(Clone, Debug)]
pub enum VertexSource<'a> {
    /// Given as the vertex stage would give them.
    Transformed(&'a [Vertex]),
    /// Made by a vertex program.
    Program {
        /// The program.
        program: &'a CheckedProgram,
        /// Its constants.
        constants: &'a Constants,
        /// Its attributes.
        streams: VertexStreams<'a>,
    },
}

/// A texture bound to a sampler of a draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoundTexture {
    /// The texture.
    pub texture: TextureId,
    /// How it is sampled.
    pub state: SamplerState,
}

/// A draw call. [`DrawCall::new`] gives one with everything off; set the fields that matter.
#[derive(Clone, Debug)]
pub struct DrawCall<'a> {
    /// The vertices.
    pub vertices: VertexSource<'a>,
    /// Which vertices make the primitives of each instance; `None`: all in order.
    pub indices: Option<&'a [u32]>,
    /// How they make them.
    pub primitive: Primitive,
    /// The pixel program.
    pub pixel_program: &'a CheckedProgram,
    /// Its constants.
    pub pixel_constants: &'a Constants,
    /// Its textures. What is unbound reads as (0, 0, 0, 1).
    pub samplers: [Option<BoundTexture>; SAMPLERS],
    /// Bump state of the stages (ps_1_x).
    pub bump: [BumpStage; BUMP_STAGES],
    /// Projected textures of the stages (ps_1_1 to 1_3).
    pub projections: [Projection; BUMP_STAGES],
    /// Flat shading: whose colours a primitive has; `None`: the colours `v#` are interpolated.
    pub flat: Option<Provoking>,
    /// The viewport; `None`: the whole target, depths 0 to 1.
    pub viewport: Option<Viewport>,
    /// Pixels outside are not drawn; `None`: the whole target.
    pub scissor: Option<Region>,
    /// Pixel centres.
    pub center: PixelCenter,
    /// Clip space.
    pub clip_space: ClipSpace,
    /// Culling.
    pub cull: Cull,
    /// Alpha test, if on.
    pub alpha_test: Option<AlphaTest>,
    /// Depth test.
    pub depth: DepthState,
    /// Blending, if on.
    pub blend: Option<BlendState>,
    /// Write masks of the targets.
    pub masks: [WriteMask; MAX_TARGETS],
    /// Colour targets, `oC0` first.
    pub targets: Vec<TextureId>,
    /// Depth buffer.
    pub depth_buffer: Option<DepthId>,
}

impl<'a> DrawCall<'a> {
    /// A draw into one colour target, with every test off and nothing bound.
    pub fn new(
        vertices: VertexSource<'a>,
        primitive: Primitive,
        pixel_program: &'a CheckedProgram,
        pixel_constants: &'a Constants,
        target: TextureId,
    ) -> Self {
        Self {
            vertices,
            indices: None,
            primitive,
            pixel_program,
            pixel_constants,
            samplers: [None; SAMPLERS],
            bump: [BumpStage::default(); BUMP_STAGES],
            projections: [Projection::default(); BUMP_STAGES],
            flat: None,
            viewport: None,
            scissor: None,
            center: PixelCenter::default(),
            clip_space: ClipSpace::default(),
            cull: Cull::default(),
            alpha_test: None,
            depth: DepthState::default(),
            blend: None,
            masks: [WriteMask::ALL; MAX_TARGETS],
            targets: vec![target],
            depth_buffer: None,
        }
    }

    /// Binds a texture to sampler (in ps_1_x: stage) `sampler`; numbers from 16 on are ignored.
    #[must_use]
    pub fn with_texture(mut self, sampler: usize, texture: TextureId, state: SamplerState) -> Self {
        if let Some(slot) = self.samplers.get_mut(sampler) {
            *slot = Some(BoundTexture { texture, state });
        }
        self
    }

    /// The state of the output stage.
    pub(super) fn output_state(&self) -> OutputState {
        OutputState { alpha: self.alpha_test, depth: self.depth, blend: self.blend, masks: self.masks }
    }
}
