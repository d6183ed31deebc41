//! A draw and everything around it as data, and how an executor draws it.

use crate::executors::Executor;
use refsim::check;
use refsim::device::Profile;
use refsim::event::{DrawEvents, Event};
use refsim::exec::{BumpStage, CheckedProgram, Constants, Projection};
use refsim::machine::{
    AttributeStream, DepthId, DrawCall, FragmentTrace, Machine, MachineError, StepRate, TextureId, VertexSource,
    VertexStreams,
};
use refsim::output::{AlphaTest, BlendState, DepthFormat, DepthState, WriteMask};
use refsim::raster::{ClipSpace, Cull, PixelCenter, Primitive, Provoking, Vertex, Viewport};
use refsim::texture::{Image, Region, SamplerState, TexelFormat};

/// Everything about a draw that isn't its programs.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    pub(crate) profile: Profile,
    pub(crate) size: [u32; 2],
    pub(crate) pixel_constants: Constants,
    pub(crate) vertex_constants: Constants,
    pub(crate) textures: Vec<(usize, Image, SamplerState)>,
    pub(crate) bump: [BumpStage; 8],
    pub(crate) projections: [Projection; 8],
    pub(crate) flat: Option<Provoking>,
    /// What is drawn without a vertex program.
    pub(crate) vertices: Vec<Vertex>,
    /// What is drawn with one: register, step, values.
    pub(crate) streams: Vec<(usize, StepRate, Vec<[u32; 4]>)>,
    pub(crate) vertex_count: usize,
    pub(crate) instances: usize,
    pub(crate) indices: Option<Vec<u32>>,
    pub(crate) primitive: Primitive,
    pub(crate) targets: Vec<TexelFormat>,
    pub(crate) clear: [u32; 4],
    pub(crate) depth: Option<(DepthFormat, u32)>,
    pub(crate) depth_state: DepthState,
    pub(crate) alpha: Option<AlphaTest>,
    pub(crate) blend: Option<BlendState>,
    pub(crate) masks: [WriteMask; 4],
    pub(crate) center: PixelCenter,
    pub(crate) clip_space: ClipSpace,
    pub(crate) cull: Cull,
    pub(crate) viewport: Option<Viewport>,
    pub(crate) scissor: Option<Region>,
    /// How many times it is drawn over itself.
    pub(crate) draws: usize,
    /// Whether a last draw reads the first target as texture 0 and fills other targets.
    pub(crate) second_pass: bool,
}

/// A scene with its programs, as text: one line an instruction.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) scene: Scene,
    pub(crate) pixel: Vec<String>,
    pub(crate) vertex: Option<Vec<String>>,
}

/// The programs of a case, judged.
#[derive(Clone, Debug)]
pub(crate) struct Programs {
    pub(crate) pixel: CheckedProgram,
    pub(crate) vertex: Option<CheckedProgram>,
}

/// What the draws left behind.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Outcome {
    /// Format, width, bytes.
    pub(crate) targets: Vec<(TexelFormat, u32, Vec<u8>)>,
    pub(crate) depth: Vec<u32>,
    pub(crate) events: Vec<DrawEvents>,
    /// What the machine wrote down, without what only a watched draw knows.
    pub(crate) log: Vec<Event>,
}

/// The program of some lines, if the checker accepts it for the device.
pub(crate) fn build(lines: &[String], profile: &Profile) -> Result<CheckedProgram, String> {
    let program = refsim::asm::assemble(&lines.join("\n")).map_err(|e| e.to_string())?;
    check::check(program, profile).map_err(|e| e.violations.iter().map(|v| format!("{v}\n")).collect())
}

impl Case {
    /// Both programs, if they are legal.
    pub(crate) fn build(&self) -> Result<Programs, String> {
        let profile = &self.scene.profile;
        let vertex = self.vertex.as_ref().map(|lines| build(lines, profile)).transpose()?;
        Ok(Programs { pixel: build(&self.pixel, profile)?, vertex })
    }
}

/// A machine with the targets and textures of a scene.
struct Stage {
    machine: Machine,
    targets: Vec<TextureId>,
    textures: Vec<(usize, TextureId, SamplerState)>,
    depth: Option<DepthId>,
}

impl Scene {
    /// Draws.
    pub(crate) fn draw(&self, executor: &Executor, programs: &Programs) -> Result<Outcome, MachineError> {
        let mut stage = self.stage(executor)?;
        let mut events = Vec::new();
        for _ in 0..self.draws.max(1) {
            let call = self.call(&stage, programs);
            events.push(stage.machine.draw(&call)?);
        }
        let mut all = stage.targets.clone();
        if self.second_pass {
            let first = stage.targets[0];
            stage.targets = self.targets(&mut stage.machine)?;
            all.extend(&stage.targets);
            stage.textures.retain(|(slot, _, _)| *slot != 0);
            stage.textures.push((0, first, SamplerState::NEAREST_CLAMP));
            let call = self.call(&stage, programs);
            events.push(stage.machine.draw(&call)?);
        }
        let mut outcome = Outcome { targets: Vec::new(), depth: Vec::new(), events, log: Vec::new() };
        for id in all {
            let image = stage.machine.read_back(id)?;
            outcome.targets.push((image.format(), image.width(), image.bytes().to_vec()));
        }
        if let Some(id) = stage.depth {
            outcome.depth = stage.machine.read_depth(id)?.data().to_vec();
        }
        outcome.log = stage.machine.take_log();
        for event in &mut outcome.log {
            if let Event::Draw(draw) = event {
                draw.samplers.iter_mut().for_each(|sampler| sampler.traffic = None);
            }
        }
        Ok(outcome)
    }

    /// Follows every pixel, row by row, through one draw.
    pub(crate) fn traces(
        &self,
        executor: &Executor,
        programs: &Programs,
    ) -> Result<Vec<Vec<FragmentTrace>>, MachineError> {
        let stage = self.stage(executor)?;
        let [width, height] = self.size;
        let pixels: Vec<_> = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).collect();
        stage.machine.trace_pixels(&self.call(&stage, programs), &pixels)
    }

    fn targets(&self, machine: &mut Machine) -> Result<Vec<TextureId>, MachineError> {
        let mut targets = Vec::new();
        for &format in &self.targets {
            let target = machine.create_target(format, self.size[0], self.size[1])?;
            machine.clear_target(target, self.clear)?;
            targets.push(target);
        }
        Ok(targets)
    }

    fn stage(&self, executor: &Executor) -> Result<Stage, MachineError> {
        let mut machine = executor.machine(&self.profile)?;
        machine.record(true);
        let targets = self.targets(&mut machine)?;
        let mut textures = Vec::new();
        for (slot, image, state) in &self.textures {
            textures.push((*slot, machine.create_texture(image.clone())?, *state));
        }
        let depth = match self.depth {
            Some((format, clear)) => {
                let id = machine.create_depth(format, self.size[0], self.size[1])?;
                machine.clear_depth(id, clear)?;
                Some(id)
            }
            None => None,
        };
        Ok(Stage { machine, targets, textures, depth })
    }

    fn call<'a>(&'a self, stage: &Stage, programs: &'a Programs) -> DrawCall<'a> {
        let vertices = match &programs.vertex {
            None => VertexSource::Transformed(&self.vertices),
            Some(program) => VertexSource::Program {
                program,
                constants: &self.vertex_constants,
                streams: VertexStreams {
                    vertex_count: self.vertex_count,
                    instance_count: self.instances,
                    streams: self
                        .streams
                        .iter()
                        .map(|(register, step, data)| AttributeStream { register: *register, step: *step, data })
                        .collect(),
                },
            },
        };
        let mut call =
            DrawCall::new(vertices, self.primitive, &programs.pixel, &self.pixel_constants, stage.targets[0]);
        for (slot, texture, state) in &stage.textures {
            call = call.with_texture(*slot, *texture, *state);
        }
        DrawCall {
            indices: self.indices.as_deref(),
            bump: self.bump,
            projections: self.projections,
            flat: self.flat,
            viewport: self.viewport,
            scissor: self.scissor,
            center: self.center,
            clip_space: self.clip_space,
            cull: self.cull,
            alpha_test: self.alpha,
            depth: if stage.depth.is_some() { self.depth_state } else { DepthState::default() },
            blend: self.blend,
            masks: self.masks,
            targets: stage.targets.clone(),
            depth_buffer: stage.depth,
            ..call
        }
    }
}

impl Outcome {
    /// Fragments that the draws produced.
    pub(crate) fn fragments(&self) -> u64 {
        self.events.iter().map(|e| e.fragments.generated).sum()
    }

    /// Where two outcomes differ first, in words; `None` if they are equal.
    pub(crate) fn difference(&self, other: &Self, name: &str) -> Option<String> {
        for (i, ((format, width, a), (_, _, b))) in self.targets.iter().zip(&other.targets).enumerate() {
            let size = format.bytes();
            if let Some(at) = a.chunks(size).zip(b.chunks(size)).position(|(a, b)| a != b) {
                let (x, y) = (at as u32 % width, at as u32 / width);
                let texel = at * size..(at + 1) * size;
                return Some(format!(
                    "target {i} ({}) at ({x}, {y}): scalar {:02x?}, {name} {:02x?}",
                    format.name(),
                    &a[texel.clone()],
                    &b[texel]
                ));
            }
        }
        if let Some(at) = self.depth.iter().zip(&other.depth).position(|(a, b)| a != b) {
            let width = self.targets.first().map_or(1, |(_, width, _)| *width);
            let (x, y) = (at as u32 % width, at as u32 / width);
            return Some(format!("depth at ({x}, {y}): scalar {:#x}, {name} {:#x}", self.depth[at], other.depth[at]));
        }
        if self.events != other.events {
            return Some(format!("events: scalar {:?}, {name} {:?}", self.events, other.events));
        }
        (self != other).then(|| format!("log: scalar {:?}, {name} {:?}", self.log, other.log))
    }
}
