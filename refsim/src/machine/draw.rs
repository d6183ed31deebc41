//! Draw calls as data.

use super::{DepthId, TextureId};
use crate::event::SAMPLERS;
use crate::exec::{BUMP_STAGES, BumpStage, CheckedProgram, Constants, Projection};
use crate::output::{AlphaTest, BlendState, DepthState, MAX_TARGETS, OutputState, WriteMask};
use crate::raster::{ClipSpace, Cull, PixelCenter, Primitive, Provoking, Vertex, Viewport};
use crate::texture::{Region, SamplerState};

/// Default value of attributes without a stream: (0, 0, 0, 1) in single precision.
pub const DEFAULT_ATTRIBUTE: [u32; 4] = [0, 0, 0, 0x3f80_0000];

/// Step rate of a stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StepRate {
    /// Advances per vertex; restarts with each instance.
    Vertex,
    /// Advances per instance.
    Instance,
}

/// The values of one attribute register.
#[derive(Clone, Copy, Debug)]
pub struct AttributeStream<'a> {
    /// Register number n of `v#n`, 0 to 15.
    pub register: usize,
    /// Its step rate.
    pub step: StepRate,
    /// The values as single-precision patterns: one per vertex or one per instance.
    pub data: &'a [[u32; 4]],
}

/// Input of a vertex program: `instance_count` instances of `vertex_count` vertices.
///
/// The Ray Engine draws in this way: the corners of a full-screen quad are in per-vertex streams, and N primitives in
/// per-instance streams. One call draws N quads in order, like N calls.
#[derive(Clone, Debug)]
pub struct VertexStreams<'a> {
    /// Vertices per instance.
    pub vertex_count: usize,
    /// Number of instances.
    pub instance_count: usize,
    /// The streams; registers without a stream hold [`DEFAULT_ATTRIBUTE`].
    pub streams: Vec<AttributeStream<'a>>,
}

/// The vertices of a draw.
#[derive(Clone, Debug)]
pub enum VertexSource<'a> {
    /// Vertices that are already transformed.
    Transformed(&'a [Vertex]),
    /// Vertices transformed by a vertex program.
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
    /// Sampler state.
    pub state: SamplerState,
}

/// A draw call. [`DrawCall::new`] returns a call with everything disabled, whose fields can then be set.
#[derive(Clone, Debug)]
pub struct DrawCall<'a> {
    /// The vertices.
    pub vertices: VertexSource<'a>,
    /// Vertex indices of the primitives of each instance; `None`: all vertices in order.
    pub indices: Option<&'a [u32]>,
    /// Primitive topology.
    pub primitive: Primitive,
    /// The pixel program.
    pub pixel_program: &'a CheckedProgram,
    /// Its constants.
    pub pixel_constants: &'a Constants,
    /// Bound textures. Unbound samplers read (0, 0, 0, 1).
    pub samplers: [Option<BoundTexture>; SAMPLERS],
    /// Bump state of the stages (ps_1_x).
    pub bump: [BumpStage; BUMP_STAGES],
    /// Texture projection of the stages (ps_1_1 to 1_3).
    pub projections: [Projection; BUMP_STAGES],
    /// Provoking vertex for flat shading. If `None`, the colours `v#` are interpolated.
    pub flat: Option<Provoking>,
    /// The viewport. If `None`, it is the whole target, with depth range 0 to 1.
    pub viewport: Option<Viewport>,
    /// Scissor rectangle. If `None`, it is the whole target.
    pub scissor: Option<Region>,
    /// Pixel centre convention.
    pub center: PixelCenter,
    /// Clip space convention.
    pub clip_space: ClipSpace,
    /// Culling.
    pub cull: Cull,
    /// Alpha test, if enabled.
    pub alpha_test: Option<AlphaTest>,
    /// Depth test.
    pub depth: DepthState,
    /// Blending, if enabled.
    pub blend: Option<BlendState>,
    /// Write masks of the targets.
    pub masks: [WriteMask; MAX_TARGETS],
    /// Colour targets, `oC0` first.
    pub targets: Vec<TextureId>,
    /// Depth buffer.
    pub depth_buffer: Option<DepthId>,
}

impl<'a> DrawCall<'a> {
    /// Creates a draw into one colour target, with every test disabled and nothing bound.
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

    pub(super) fn output_state(&self) -> OutputState {
        OutputState { alpha: self.alpha_test, depth: self.depth, blend: self.blend, masks: self.masks }
    }
}
