//! Validation of draw calls, before anything is written.

use super::memory::{Memory, check_target_format, check_texture_format};
use super::{BoundTexture, DrawCall, MachineError, StepRate, VertexSource};
use crate::device::Profile;
use crate::event::SAMPLERS;
use crate::isa::{Program, Stage};
use crate::output::{MAX_TARGETS, TargetTile};
use crate::raster::{RasterState, Vertex, Viewport, assemble, provoking};
use crate::texture::{Filter, MipFilter, Region};
use std::ops::Range;

/// Maximum number of vertices per instance, and of instances, per draw.
const MAX_VERTICES: usize = 1 << 24;

pub(super) struct Plan {
    pub(super) raster: RasterState,
    pub(super) vertex_count: usize,
    pub(super) instance_count: usize,
    /// Triangles of an instance, as indices of its vertices.
    pub(super) triangles: Vec<[usize; 3]>,
    /// The provoking vertex of each triangle, for flat shading.
    pub(super) provoking: Option<Vec<usize>>,
}

/// Approximate number of triangles per round. Instances are drawn in rounds to bound the memory of a draw.
pub(super) const ROUND: usize = 8192;

impl Plan {
    /// Ranges of instances, in rounds of about [`ROUND`] triangles.
    pub(super) fn rounds(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let (step, count) = ((ROUND / self.triangles.len().max(1)).max(1), self.instance_count);
        (0..count).step_by(step).map(move |first| first..count.min(first + step))
    }

    /// Corners of triangle `i` of an instance whose vertices start at `base`, for set-up. With flat shading, all three
    /// have the colours of the provoking vertex.
    pub(super) fn corners(&self, vertices: &[Vertex], base: usize, i: usize) -> Option<[Vertex; 3]> {
        let [a, b, c] = self.triangles[i].map(|v| vertices.get(base + v).copied());
        let mut corners = [a?, b?, c?];
        if let Some(provoking) = &self.provoking {
            let colors = vertices.get(base + provoking[i])?.colors;
            corners.iter_mut().for_each(|corner| corner.colors = colors);
        }
        Some(corners)
    }
}

pub(super) fn plan(profile: &Profile, memory: &Memory, call: &DrawCall<'_>) -> Result<Plan, MachineError> {
    check_stage(crate::exec::program(call.pixel_program), Stage::Pixel)?;
    let target = check_targets(profile, memory, call)?;
    for (sampler, bound) in call.samplers.iter().enumerate() {
        if let Some(bound) = bound {
            check_sampler(profile, memory, call, sampler, bound)?;
        }
    }
    let raster = raster_state(call, target);
    raster.viewport.check()?;
    let (vertex_count, instance_count) = match &call.vertices {
        VertexSource::Transformed(vertices) => (vertices.len(), 1),
        VertexSource::Program { program, streams, .. } => {
            check_stage(crate::exec::program(program), Stage::Vertex)?;
            check_streams(call)?;
            (streams.vertex_count, streams.instance_count)
        }
    };
    for (what, found) in [("vertices", vertex_count), ("instances", instance_count)] {
        if found > MAX_VERTICES {
            return Err(MachineError::TooMany { what, found, limit: MAX_VERTICES });
        }
    }
    let triangles = triangles(call, vertex_count)?;
    let provoking = call.flat.map(|convention| {
        // The provoking corner is a position in the index list, so its vertex is looked up there.
        let through = |corner: usize| call.indices.map_or(corner, |indices| indices[corner] as usize);
        (0..triangles.len()).map(|i| through(provoking(call.primitive, i, convention))).collect()
    });
    Ok(Plan { raster, vertex_count, instance_count, triangles, provoking })
}

fn check_stage(program: &Program, expected: Stage) -> Result<(), MachineError> {
    if program.version.stage() == expected {
        return Ok(());
    }
    Err(MachineError::WrongStage { expected, found: program.version })
}

/// Checks that targets are live, 2-D, of supported formats and equal size, all different, and not too many.
fn check_targets(profile: &Profile, memory: &Memory, call: &DrawCall<'_>) -> Result<Region, MachineError> {
    let found = call.targets.len();
    let limit = profile.limits.render_targets.map_or(MAX_TARGETS, |n| n as usize).min(MAX_TARGETS);
    if found > limit {
        return Err(MachineError::TooManyTargets { device: profile.name.clone(), found, limit });
    }
    if found == 0 && call.depth_buffer.is_none() {
        return Err(MachineError::NoTarget);
    }
    let mut images = Vec::new();
    for (index, &id) in call.targets.iter().enumerate() {
        let image = memory.texture(id)?;
        check_target_format(profile, image.format())?;
        if call.targets[..index].contains(&id) {
            return Err(MachineError::TargetTwice { number: id.0 });
        }
        if call.blend.is_some() && image.format().record().is_float() && !profile.limits.float_blending {
            let device = profile.name.clone();
            return Err(MachineError::FloatBlend { target: index, format: image.format(), device });
        }
        images.push(Some(image));
    }
    let depth = call.depth_buffer.map(|id| memory.depth(id)).transpose()?;
    if depth.is_none() && call.depth.test.is_some() {
        return Err(MachineError::NoDepthBuffer);
    }
    Ok(TargetTile::check(&images, depth)?)
}

/// Checks that a sampler's texture is live, has a format and filter that the device supports, and is not a target of
/// the draw.
fn check_sampler(
    profile: &Profile,
    memory: &Memory,
    call: &DrawCall<'_>,
    sampler: usize,
    bound: &BoundTexture,
) -> Result<(), MachineError> {
    let image = memory.texture(bound.texture)?;
    check_texture_format(profile, image.format())?;
    if let Some(target) = call.targets.iter().position(|&t| t == bound.texture) {
        return Err(MachineError::FeedbackLoop { sampler, target });
    }
    let state = &bound.state;
    let filtered = state.min == Filter::Linear || state.mag == Filter::Linear || state.mip == MipFilter::Linear;
    if filtered && image.format().record().is_float() && !profile.limits.float_filtering {
        let device = profile.name.clone();
        return Err(MachineError::FloatFilter { sampler, format: image.format(), device });
    }
    Ok(())
}

fn raster_state(call: &DrawCall<'_>, target: Region) -> RasterState {
    RasterState {
        viewport: call.viewport.unwrap_or(Viewport::new(target.width, target.height)),
        center: call.center,
        clip_space: call.clip_space,
        cull: call.cull,
        scissor: call.scissor.map_or(target, |s| s.intersect(target)),
    }
}

/// Checks that streams are for existing registers, at most one per register, and long enough.
fn check_streams(call: &DrawCall<'_>) -> Result<(), MachineError> {
    let VertexSource::Program { streams, .. } = &call.vertices else {
        return Ok(());
    };
    let mut fed = [false; SAMPLERS];
    for stream in &streams.streams {
        let register = stream.register;
        match fed.get_mut(register) {
            None => return Err(MachineError::NoSuchAttribute { register }),
            Some(true) => return Err(MachineError::StreamTwice { register }),
            Some(slot) => *slot = true,
        }
        let (needed, what) = match stream.step {
            StepRate::Vertex => (streams.vertex_count, "one per vertex"),
            StepRate::Instance => (streams.instance_count, "one per instance"),
        };
        let found = stream.data.len();
        if found < needed {
            return Err(MachineError::ShortStream { register, found, needed, what });
        }
    }
    Ok(())
}

/// Triangles of an instance, through the index list if there is one.
fn triangles(call: &DrawCall<'_>, vertex_count: usize) -> Result<Vec<[usize; 3]>, MachineError> {
    let Some(indices) = call.indices else {
        return Ok(assemble(call.primitive, vertex_count)?.collect());
    };
    if let Some(position) = indices.iter().position(|&i| i as usize >= vertex_count) {
        return Err(MachineError::Index { position, found: indices[position], limit: vertex_count });
    }
    let through = |corner: usize| indices[corner] as usize;
    Ok(assemble(call.primitive, indices.len())?.map(|t| t.map(through)).collect())
}
