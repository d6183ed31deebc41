//! The vertex stage and triangle set-up of a draw call.

use super::validate::Plan;
use super::{
    DEFAULT_ATTRIBUTE, DrawCall, ExecutorKind, MachineError, ProgramPlace, StepRate, VertexSource, VertexStreams,
};
use crate::device::{ColorClamp, Profile};
use crate::event::PrimitiveCounts;
use crate::exec::batch::{BatchExecutor, BatchVertices, VertexRows};
use crate::exec::scalar::VertexProgram;
use crate::exec::{CheckedProgram, NoObserver};
use crate::isa::Stage;
use crate::raster::{ComponentMask, RasterRules, TriangleSetup, Vertex, setup};
use rayon::prelude::*;

/// Number of triangles that a worker sets up at a time.
const SETUP_CHUNK: usize = 256;

/// Vertices of several instances, and the instructions executed.
pub(super) struct Batch {
    pub(super) vertices: Vec<Vertex>,
    pub(super) slots: u64,
}

pub(super) enum VertexStage<'a> {
    /// Transformed vertices, and the clamp of their colours.
    Transformed(&'a [Vertex], ColorClamp),
    Program(VertexShader<'a>, Box<VertexProgram<'a>>),
    Batch(VertexShader<'a>, Box<BatchVertices>),
}

/// A vertex program, with its input and its step budget.
#[derive(Clone, Copy)]
pub(super) struct VertexShader<'a> {
    program: &'a CheckedProgram,
    streams: &'a VertexStreams<'a>,
    budget: u32,
}

impl VertexShader<'_> {
    /// Returns an error for the first vertex, by instance and number, that exceeded the budget.
    fn overrun(&self, cut: impl Iterator<Item = (usize, usize, usize)>) -> Result<(), MachineError> {
        let Some((instance, vertex, instruction)) = cut.min() else { return Ok(()) };
        let place = ProgramPlace::Vertex { instance, vertex };
        Err(MachineError::out_of_steps(place, instruction, self.program, self.budget))
    }
}

impl<'a> VertexStage<'a> {
    pub(super) fn new(
        call: &'a DrawCall<'a>,
        profile: &'a Profile,
        (kind, batch): (ExecutorKind, &BatchExecutor),
        needed: ComponentMask,
    ) -> Self {
        match &call.vertices {
            VertexSource::Transformed(vertices) => Self::Transformed(vertices, profile.rules.color_clamp),
            VertexSource::Program { program, constants, streams } => {
                let (rules, budget) = (&profile.rules, profile.limits.step_budget(Stage::Vertex));
                let shader = VertexShader { program, streams, budget };
                if kind == ExecutorKind::Batch
                    && let Some(vertices) = batch.vertices((program, constants), rules, needed, budget)
                {
                    return Self::Batch(shader, Box::new(vertices));
                }
                Self::Program(shader, Box::new(VertexProgram::new(program, rules, constants).within(budget)))
            }
        }
    }

    /// Processes instances `first` to `first + count`, in order.
    ///
    /// # Errors
    /// If a vertex exceeds the step budget.
    pub(super) fn run(&self, first: usize, count: usize, plan: &Plan) -> Result<Batch, MachineError> {
        Ok(match self {
            Self::Transformed(vertices, clamp) => {
                let mut vertices = vertices.to_vec();
                if *clamp == ColorClamp::Vertex {
                    vertices.iter_mut().for_each(Vertex::clamp_colors);
                }
                Batch { vertices, slots: 0 }
            }
            Self::Program(shader, program) => {
                let place = |i: usize| (first + i / plan.vertex_count, i % plan.vertex_count);
                let results: Vec<_> = (0..count * plan.vertex_count)
                    .into_par_iter()
                    .map(|i| {
                        let (instance, vertex) = place(i);
                        program.run(&attributes(shader.streams, instance, vertex), &mut NoObserver)
                    })
                    .collect();
                let cut = results.iter().enumerate().filter_map(|(i, (_, cut))| Some((i, (*cut)?)));
                shader.overrun(cut.map(|(i, instruction)| (place(i).0, place(i).1, instruction)))?;
                Batch {
                    slots: results.iter().map(|(r, _)| r.slots).sum(),
                    vertices: results.into_iter().map(|(r, _)| r.vertex).collect(),
                }
            }
            Self::Batch(..) => {
                let rows = self.rows(first, count, plan, ComponentMask::ALL)?;
                // Transposes from the order of `rows` (all instances of a vertex together) to all vertices of an
                // instance together.
                let at = |i: usize| (i % plan.vertex_count) * count + i / plan.vertex_count;
                let vertices = (0..count * plan.vertex_count).map(|i| rows.vertex(at(i))).collect();
                Batch { vertices, slots: rows.executed }
            }
        })
    }

    /// [`Self::run`] with results in structure-of-arrays layout: vertex `v` of instance `first + i` has index `v *
    /// count + i`.
    ///
    /// # Errors
    /// If a vertex exceeds the step budget.
    pub(super) fn rows(
        &self,
        first: usize,
        count: usize,
        plan: &Plan,
        needed: ComponentMask,
    ) -> Result<VertexRows, MachineError> {
        Ok(match self {
            Self::Batch(shader, program) => {
                let fill = |register: usize, component: usize, at: usize, row: &mut [u32]| {
                    fill_attribute(shader.streams, (register, component), (first, count), at, row);
                };
                let rows = program.run(count * plan.vertex_count, &fill);
                shader.overrun(rows.cut.iter().map(|&(i, instruction)| (first + i % count, i / count, instruction)))?;
                rows
            }
            Self::Transformed(vertices, clamp) => {
                let mut rows = VertexRows::from_vertices(vertices, needed);
                if *clamp == ColorClamp::Vertex {
                    rows.clamp_colors();
                }
                rows
            }
            Self::Program(..) => {
                let batch = self.run(first, count, plan)?;
                // Transposes from all vertices of an instance together to all instances of a vertex together.
                let at = |i: usize| (i % count) * plan.vertex_count + i / count;
                let vertices: Vec<Vertex> = (0..batch.vertices.len()).map(|i| batch.vertices[at(i)]).collect();
                VertexRows { executed: batch.slots, ..VertexRows::from_vertices(&vertices, needed) }
            }
        })
    }

    /// Bytes read per vertex, and bytes read once per instance.
    pub(super) fn bytes(&self) -> (u64, u64) {
        match self {
            Self::Transformed(..) => (size_of::<Vertex>() as u64, 0),
            Self::Program(shader, _) | Self::Batch(shader, _) => {
                let of = |step| 16 * shader.streams.streams.iter().filter(|s| s.step == step).count() as u64;
                (of(StepRate::Vertex), of(StepRate::Instance))
            }
        }
    }
}

fn attributes(streams: &VertexStreams<'_>, instance: usize, vertex: usize) -> [[u32; 4]; 16] {
    let mut out = [DEFAULT_ATTRIBUTE; 16];
    for stream in &streams.streams {
        let entry = match stream.step {
            StepRate::Vertex => vertex,
            StepRate::Instance => instance,
        };
        if let (Some(slot), Some(value)) = (out.get_mut(stream.register), stream.data.get(entry)) {
            *slot = *value;
        }
    }
    out
}

/// Fills a row with one attribute component of consecutive vertices, starting at index `at`. All instances of a vertex
/// are adjacent. Instances are `first` to `first + count`.
fn fill_attribute(
    streams: &VertexStreams<'_>,
    (register, component): (usize, usize),
    (first, count): (usize, usize),
    at: usize,
    row: &mut [u32],
) {
    let Some(stream) = streams.streams.iter().find(|stream| stream.register == register) else {
        return row.fill(DEFAULT_ATTRIBUTE[component]);
    };
    let value = |entry: usize| stream.data.get(entry).map_or(DEFAULT_ATTRIBUTE[component], |v| v[component]);
    let mut rest = row;
    let mut at = at;
    while !rest.is_empty() {
        let (vertex, instance) = (at / count, at % count);
        let (run, more) = rest.split_at_mut((count - instance).min(rest.len()));
        match stream.step {
            StepRate::Vertex => run.fill(value(vertex)),
            StepRate::Instance => {
                for (slot, entry) in run.iter_mut().zip(first + instance..) {
                    *slot = value(entry);
                }
            }
        }
        at += run.len();
        rest = more;
    }
}

/// Sets up the triangles of `instances` instances with consecutive vertices.
pub(super) fn set_up(
    vertices: &[Vertex],
    instances: usize,
    plan: &Plan,
    profile: &Profile,
) -> (Vec<TriangleSetup>, PrimitiveCounts) {
    let rules = RasterRules::from(&profile.rules);
    let each = plan.triangles.len();
    let total = each * instances;
    let parts: Vec<_> = (0..total.div_ceil(SETUP_CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let mut out = Vec::new();
            let mut counts = PrimitiveCounts::default();
            for i in chunk * SETUP_CHUNK..((chunk + 1) * SETUP_CHUNK).min(total) {
                let base = i / each * plan.vertex_count;
                let Some(corners) = plan.corners(vertices, base, i % each) else {
                    continue;
                };
                let report = setup(corners.each_ref(), &plan.raster, &rules, &mut out);
                counts.assembled += 1;
                counts.culled += u64::from(report.emitted == 0);
                counts.clipped += u64::from(report.emitted > 1);
                counts.rasterised += u64::from(report.emitted);
            }
            (out, counts)
        })
        .collect();
    // Concatenated in order, so that the result does not depend on the threads.
    let mut setups = Vec::with_capacity(total);
    let mut counts = PrimitiveCounts::default();
    for (part, more) in parts {
        setups.extend(part);
        counts += more;
    }
    (setups, counts)
}
