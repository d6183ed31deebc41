//! State changes between draws: the number of state groups that differ from the previous draw.

use super::{BoundTexture, DepthId, DrawCall, StepRate, TextureId, VertexSource};
use crate::event::SAMPLERS;
use crate::exec::{BUMP_STAGES, BumpStage, Constants, Projection, program};
use crate::isa::{ParameterSource, Program};
use crate::output::{AlphaTest, BlendState, DepthState, MAX_TARGETS, WriteMask};
use crate::raster::{ClipSpace, Cull, PixelCenter, Provoking, Viewport};
use crate::texture::Region;

/// Number of state groups: the samplers, three for the vertex stage, and ten others.
const PIECES: u32 = SAMPLERS as u32 + 3 + 10;

#[derive(Clone, Debug)]
pub(super) struct DrawState {
    samplers: [Option<BoundTexture>; SAMPLERS],
    pixel_program: Program,
    pixel_constants: Constants,
    vertex_program: Option<Program>,
    vertex_constants: Option<Constants>,
    layout: Option<Layout>,
    fixed: FixedState,
    targets: Vec<TextureId>,
}

/// Attribute registers of a draw and their step rates.
type Layout = Vec<(usize, StepRate)>;

/// The state groups that consist of a few numbers each.
#[derive(Clone, Copy, Debug)]
struct FixedState {
    depth_buffer: Option<DepthId>,
    depth: DepthState,
    alpha_test: Option<AlphaTest>,
    blend: Option<BlendState>,
    masks: [WriteMask; MAX_TARGETS],
    stages: ([BumpStage; BUMP_STAGES], [Projection; BUMP_STAGES]),
    raster: (Option<Viewport>, Option<Region>, PixelCenter, ClipSpace, Cull, Option<Provoking>),
}

impl DrawState {
    /// Replaces the state by the state of a call; returns the number of state groups and of float constants that
    /// differ. Before the first draw all groups are unset and constants are 0.
    pub(super) fn update(state: &mut Option<Self>, call: &DrawCall<'_>) -> (u32, u32) {
        let none = Constants::default();
        let (pixel, vertex) = match state {
            Some(state) => (&state.pixel_constants, state.vertex_constants.as_ref().unwrap_or(&none)),
            None => (&none, &none),
        };
        let constants = differing(pixel, call.pixel_constants)
            + differing_state(pixel, call)
            + vertex_stage(call).1.map_or(0, |new| differing(vertex, new));
        let pieces = match state {
            Some(state) => state.take(call),
            None => {
                *state = Some(Self::of(call));
                PIECES
            }
        };
        (pieces, constants)
    }

    fn of(call: &DrawCall<'_>) -> Self {
        let (vertex_program, vertex_constants, layout) = vertex_stage(call);
        Self {
            samplers: call.samplers,
            pixel_program: program(call.pixel_program).clone(),
            pixel_constants: call.pixel_constants.clone(),
            vertex_program: vertex_program.cloned(),
            vertex_constants: vertex_constants.cloned(),
            layout,
            fixed: FixedState::of(call),
            targets: call.targets.clone(),
        }
    }

    fn take(&mut self, call: &DrawCall<'_>) -> u32 {
        let (vertex_program, vertex_constants, layout) = vertex_stage(call);
        let samplers: u32 = self.samplers.iter_mut().zip(&call.samplers).map(|(kept, new)| replace(kept, new)).sum();
        samplers
            + replace(&mut self.pixel_program, program(call.pixel_program))
            + replace(&mut self.pixel_constants, call.pixel_constants)
            + replace_optional(&mut self.vertex_program, vertex_program)
            + replace_optional(&mut self.vertex_constants, vertex_constants)
            + replace(&mut self.layout, &layout)
            + replace(&mut self.targets, &call.targets)
            + self.fixed.take(&FixedState::of(call))
    }
}

impl FixedState {
    fn of(call: &DrawCall<'_>) -> Self {
        Self {
            depth_buffer: call.depth_buffer,
            depth: call.depth,
            alpha_test: call.alpha_test,
            blend: call.blend,
            masks: call.masks,
            stages: (call.bump, call.projections),
            raster: (call.viewport, call.scissor, call.center, call.clip_space, call.cull, call.flat),
        }
    }

    fn take(&mut self, new: &Self) -> u32 {
        replace(&mut self.depth_buffer, &new.depth_buffer)
            + replace(&mut self.depth, &new.depth)
            + replace(&mut self.alpha_test, &new.alpha_test)
            + replace(&mut self.blend, &new.blend)
            + replace(&mut self.masks, &new.masks)
            + replace(&mut self.stages, &new.stages)
            + replace(&mut self.raster, &new.raster)
    }
}

/// Program, constants and attribute layout; `None` for transformed vertices.
fn vertex_stage<'a>(call: &DrawCall<'a>) -> (Option<&'a Program>, Option<&'a Constants>, Option<Layout>) {
    match &call.vertices {
        VertexSource::Transformed(_) => (None, None, None),
        VertexSource::Program { program: vertex, constants, streams } => {
            let layout = streams.streams.iter().map(|stream| (stream.register, stream.step)).collect();
            (Some(program(vertex)), Some(*constants), Some(layout))
        }
    }
}

/// Number of float constants, numbered or named, whose value changes; unset constants are 0.
fn differing(kept: &Constants, new: &Constants) -> u32 {
    let before = kept.float.iter().copied().chain(std::iter::repeat([0; 4]));
    let numbered = new.float.iter().zip(before).filter(|&(new, before)| *new != before).count();
    let named = new.named.iter().filter(|&(name, value)| kept.named.get(name) != Some(value)).count();
    (numbered + named) as u32
}

/// Number of OpenGL state parameters of the pixel program whose value changes.
fn differing_state(kept: &Constants, call: &DrawCall<'_>) -> u32 {
    let parameters = &program(call.pixel_program).parameters;
    let state = parameters.iter().filter(|p| matches!(p.source, ParameterSource::State(_)));
    state.filter(|p| kept.parameter(p) != call.pixel_constants.parameter(p)).count() as u32
}

/// Replaces a group if it differs; returns 1 if it differed, else 0. Equal groups are not copied.
fn replace<T: Clone + PartialEq>(kept: &mut T, new: &T) -> u32 {
    let differs = kept != new;
    if differs {
        kept.clone_from(new);
    }
    differs.into()
}

/// [`replace`] for an optional group.
fn replace_optional<T: Clone + PartialEq>(kept: &mut Option<T>, new: Option<&T>) -> u32 {
    let differs = kept.as_ref() != new;
    if differs {
        *kept = new.cloned();
    }
    differs.into()
}
