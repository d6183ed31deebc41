//! A case loaded into a card, ready to be drawn or traced.

use refsim::{
    device::DEFAULT_STEP_BUDGET,
    event::{DrawEvents, Event, TexelObserver},
    exec::ResolvedConstants,
    machine::{
        AttributeStream, DepthId, DrawCall, Executor, ExecutorKind, FragmentTrace, Machine, MachineError, ProgramPlace,
        StepRate, TextureId, TraceBuffers, VertexSource, VertexStreams,
    },
    output::{DepthSurface, MAX_TARGETS, WriteMask},
    raster::{ClipSpace, PixelCenter, Vertex},
    texture::{Image, SamplerState},
};

use super::{CaseError, Setup, schema::Convention, vertices::Vertices};

/// Card with all resources of a case.
#[derive(Debug)]
pub struct Loaded<'s> {
    setup: &'s Setup,
    machine: Machine,
    targets: Vec<TextureId>,
    depth: Option<DepthId>,
    samplers: Vec<(usize, TextureId, SamplerState)>,
    streams: Vec<Vec<[u32; 4]>>,
}

impl<'s> Loaded<'s> {
    /// Uploads textures, creates and clears targets. Fails if the device cannot execute the case.
    pub fn new(setup: &'s Setup, executor: impl Into<Executor>) -> Result<Self, CaseError> {
        Self::on(executor.into().machine(setup.profile.clone())?, setup)
    }

    fn on(mut machine: Machine, setup: &'s Setup) -> Result<Self, CaseError> {
        let [width, height] = setup.size;
        let mut targets = Vec::new();
        for &format in &setup.targets {
            let target = machine.create_target(format, width, height)?;
            machine.clear_target(target, setup.clear)?;
            targets.push(target);
        }
        let mut depth = None;
        if let Some((format, clear, _)) = setup.depth {
            let buffer = machine.create_depth(format, width, height)?;
            machine.clear_depth(buffer, clear)?;
            depth = Some(buffer);
        }
        let mut samplers = Vec::new();
        for (&slot, bound) in &setup.textures {
            let texture = machine.create_texture(bound.image.clone())?;
            if bound.generate_mipmaps {
                machine.generate_mipmaps(texture)?;
            }
            samplers.push((slot, texture, bound.sampler));
        }
        Ok(Self { setup, machine, targets, depth, samplers, streams: streams(setup) })
    }

    /// Like [`Loaded::new`], on a machine that records its log for [`Loaded::take_log`].
    pub fn recording(setup: &'s Setup, executor: impl Into<Executor>) -> Result<Self, CaseError> {
        Self::observed(setup, executor.into(), None)
    }

    fn observed(
        setup: &'s Setup,
        executor: Executor,
        observer: Option<Box<dyn TexelObserver>>,
    ) -> Result<Self, CaseError> {
        let mut machine = executor.machine(setup.profile.clone())?;
        machine.record(true);
        machine.observe_textures(observer);
        Self::on(machine, setup)
    }

    /// Takes the machine's log: texture uploads, clears, the draw, and each read-back of a target or the depth buffer.
    /// The log is the same for every executor.
    pub fn take_log(&mut self) -> Vec<Event> {
        self.machine.take_log()
    }

    /// Draws. Fails if the device cannot execute the case.
    pub fn draw(&mut self) -> Result<DrawEvents, CaseError> {
        // Separate borrows: only the machine is borrowed mutably.
        let call = draw_call(self.setup, &self.streams, &self.targets, self.depth, &self.samplers);
        self.machine.draw(&call).map_err(|error| placed(self.setup, error))
    }

    fn call(&self) -> DrawCall<'_> {
        draw_call(self.setup, &self.streams, &self.targets, self.depth, &self.samplers)
    }

    /// Traces some pixels without drawing ([`Machine::trace_pixels`]); fails for pixels outside the targets.
    pub fn trace(&self, pixels: &[(u32, u32)]) -> Result<Vec<Vec<FragmentTrace>>, CaseError> {
        self.machine.trace_pixels(&self.call(), pixels).map_err(|error| placed(self.setup, error))
    }

    /// Encodes a trace of some pixels for a GPU in a browser: see [`Machine::trace_buffers`].
    pub fn trace_buffers(&self, pixels: &[(u32, u32)]) -> Result<TraceBuffers, CaseError> {
        self.machine.trace_buffers(&self.call(), pixels).map_err(|error| placed(self.setup, error))
    }

    /// Returns the corners of a triangle after the vertex stage: see [`Machine::corners`].
    pub fn corners(&self, instance: usize, triangle: usize) -> Result<Option<[Vertex; 3]>, CaseError> {
        self.machine.corners(&self.call(), instance, triangle).map_err(|error| placed(self.setup, error))
    }

    /// Returns the color targets. Errors: never for a loaded case.
    pub fn targets(&self) -> Result<Vec<&Image>, CaseError> {
        let surfaces: Result<_, MachineError> = self.targets.iter().map(|&id| self.machine.read_back(id)).collect();
        Ok(surfaces?)
    }

    /// Returns the depth buffer, if there is one. Errors: never for a loaded case.
    pub fn depth(&self) -> Result<Option<&DepthSurface>, CaseError> {
        Ok(self.depth.map(|id| self.machine.read_depth(id)).transpose()?)
    }
}

/// The log of a draw and of one read-back of each target and the depth buffer, the input of the timing model. Fails if
/// the device cannot execute the case.
pub fn log(setup: &Setup, executor: impl Into<Executor>) -> Result<Vec<Event>, CaseError> {
    log_of(Loaded::recording(setup, executor)?)
}

/// Like [`log`], with an observer of every texel read, on the scalar executor, which is slow.
pub fn log_observed(setup: &Setup, observer: Box<dyn TexelObserver>) -> Result<Vec<Event>, CaseError> {
    log_of(Loaded::observed(setup, ExecutorKind::Scalar.into(), Some(observer))?)
}

fn log_of(mut loaded: Loaded<'_>) -> Result<Vec<Event>, CaseError> {
    loaded.draw()?;
    loaded.targets()?;
    loaded.depth()?;
    Ok(loaded.take_log())
}

/// Constants of the pixel program, as instructions read them.
pub(super) fn constants(setup: &Setup) -> ResolvedConstants {
    ResolvedConstants::pixel(&setup.pixel, &setup.profile.rules, &setup.pixel_constants)
}

/// Converts an error of the machine; an error about a program gets its position in the text.
fn placed(setup: &Setup, error: MachineError) -> CaseError {
    let MachineError::StepBudget { place, span, .. } = error else { return error.into() };
    let (text, key) = match place {
        ProgramPlace::Pixel { .. } => (Some(&setup.pixel_text), "pixel"),
        ProgramPlace::Vertex { .. } => (setup.vertex_text.as_ref(), "vertex"),
    };
    let Some(text) = text else { return error.into() };
    let help = format!(
        "shorten the program, or raise the limit: `step_budget` in the case, or `limits.{key}_step_budget` of the \
         device (default {DEFAULT_STEP_BUDGET})"
    );
    let span = (span.start as usize, span.end.saturating_sub(span.start) as usize).into();
    CaseError::StepBudget { error: Box::new(error), help, source_code: text.named_source(), span }
}

fn streams(setup: &Setup) -> Vec<Vec<[u32; 4]>> {
    match &setup.geometry.vertices {
        Vertices::Transformed(_) => Vec::new(),
        Vertices::Attributes(vertices) => {
            (0..16).map(|register| vertices.iter().map(|attributes| attributes[register]).collect()).collect()
        }
    }
}

fn draw_call<'a>(
    setup: &'a Setup,
    streams: &'a [Vec<[u32; 4]>],
    targets: &[TextureId],
    depth: Option<DepthId>,
    samplers: &[(usize, TextureId, SamplerState)],
) -> DrawCall<'a> {
    let vertices = match (&setup.geometry.vertices, &setup.vertex) {
        (Vertices::Attributes(vertices), Some(program)) => VertexSource::Program {
            program,
            constants: &setup.vertex_constants,
            streams: VertexStreams {
                vertex_count: vertices.len(),
                instance_count: 1,
                streams: (0..)
                    .zip(streams)
                    .map(|(register, data)| AttributeStream { register, step: StepRate::Vertex, data })
                    .collect(),
            },
        },
        (Vertices::Transformed(vertices), _) => VertexSource::Transformed(vertices),
        // Attributes are bound only for a vertex program.
        (Vertices::Attributes(_), None) => VertexSource::Transformed(&[]),
    };
    let opengl = setup.geometry.convention == Convention::Opengl;
    // The set-up rejects cases without a target.
    let first = targets[0];
    let call = DrawCall {
        center: if opengl { PixelCenter::OpenGl } else { PixelCenter::Direct3d },
        clip_space: if opengl { ClipSpace::OpenGl } else { ClipSpace::Direct3d },
        cull: setup.geometry.cull,
        alpha_test: setup.alpha,
        depth: setup.depth.map(|(_, _, state)| state).unwrap_or_default(),
        blend: setup.blend,
        masks: [WriteMask(setup.write_mask); MAX_TARGETS],
        targets: targets.to_vec(),
        depth_buffer: depth,
        bump: setup.bump,
        projections: setup.projections,
        flat: setup.geometry.flat,
        ..DrawCall::new(vertices, setup.geometry.primitive, &setup.pixel, &setup.pixel_constants, first)
    };
    samplers.iter().fold(call, |call, &(slot, texture, state)| call.with_texture(slot, texture, state))
}
