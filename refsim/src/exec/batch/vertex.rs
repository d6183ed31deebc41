//! Vertex programs on batches of 256 vertices.

use super::arith::Formats;
use super::flow::FlowPlan;
use super::flow_run::{FlowRun, first_lanes};
use super::graph::Arith;
use super::lane::{LANES, Lane};
use super::lanes::{AnyLane, with_any_lane};
use super::program::vertex_formats;
use super::simd::SimdLevel;
use super::slots::{Slot, Slots};
use super::steps::{Surroundings, raw_constants};
use crate::device::Rules;
use crate::event::SAMPLERS;
use crate::exec::{Constants, ResolvedConstants};
use crate::isa::{Program, RegisterFile};
use crate::num::Format;
use crate::raster::Vertex;

/// A vertex program ready to run on batches; equal to [`crate::exec::scalar::VertexProgram`].
#[derive(Debug)]
pub struct BatchVertices {
    formats: Formats,
    constants: Vec<[u32; 4]>,
    plan: FlowPlan,
    same_format: bool,
}

impl BatchVertices {
    /// Prepares a program, which must be a vertex program. `None` if the vertex format is none that
    /// [`Format`] can be built with.
    pub fn new(program: &Program, rules: &Rules, constants: &Constants) -> Option<Self> {
        let formats = vertex_formats(rules.vertex_format)?;
        let constants = ResolvedConstants::vertex(program, rules, constants);
        let plan = FlowPlan::vertex(program, rules, &formats, &constants);
        let raw = raw_constants(&constants.float, &formats);
        Some(Self { constants: raw, plan, same_format: rules.vertex_format == Format::FP32, formats })
    }

    /// The same with chosen vector instructions; `None` for the widest that there are.
    #[must_use]
    pub fn with_simd_level(mut self, level: Option<SimdLevel>) -> Self {
        self.formats.set_simd(level);
        self
    }

    /// Runs the program on the attributes `v0` to `v15` of each vertex, single precision patterns. Returns the vertices and
    /// the instruction slots executed, summed over them.
    pub fn run(&self, attributes: &[[[u32; 4]; 16]]) -> (Vec<Vertex>, u64) {
        let mut vertices = Vec::with_capacity(attributes.len());
        let mut slots = Slots::new(self.plan.slots());
        self.plan.fill(&mut slots);
        let around = Surroundings { formats: &self.formats, textures: &[], constants: &self.constants };
        let single = self.formats.lane(Arith::Single);
        let mut executed = 0;
        for group in attributes.chunks(LANES) {
            for &(component, slot) in self.plan.inputs() {
                let (register, c) = (usize::from(component / 4), usize::from(component % 4));
                for (value, vertex) in slots.row_mut(slot).iter_mut().zip(group) {
                    *value = vertex.get(register).map_or(0, |v| single.decode(v[c]));
                }
            }
            let lanes = first_lanes(group.len());
            let mut run = FlowRun::new(&self.plan, &around, &lanes, &lanes);
            run.run(&mut slots, &mut [0; SAMPLERS]);
            executed += run.executed;
            vertices.extend((0..group.len()).map(|lane| self.vertex(&slots, lane)));
        }
        (vertices, executed)
    }

    fn vertex(&self, slots: &Slots, lane: usize) -> Vertex {
        let held = |slot: Option<Slot>| slot.map_or(0, |s| slots.row(s)[lane]);
        let vector =
            |file, index: usize| std::array::from_fn(|c| held(self.plan.register(file, index as u16, c as u8)));
        let main = self.formats.lane(Arith::Main);
        let out = |raw: u32| self.single(raw);
        Vertex {
            position: vector(RegisterFile::PositionOut, 0).map(out),
            colors: [0, 1].map(|i| vector(RegisterFile::DiffuseOut, i).map(|raw| out(saturated(main, raw)))),
            texcoords: std::array::from_fn(|i| vector(RegisterFile::TexCoordOut, i).map(out)),
            fog: out(vector(RegisterFile::FogOut, 0)[0]),
            point_size: out(vector(RegisterFile::PointSizeOut, 0)[0]),
        }
    }

    /// What a slot holds as a single precision pattern.
    fn single(&self, raw: u32) -> u32 {
        fn wide<L: Lane>(lane: &L, raw: u32) -> f64 {
            lane.to_f64(L::load(raw))
        }
        fn narrow<L: Lane>(lane: &L, x: f64) -> u32 {
            lane.encode(lane.round_f64(x))
        }
        let (main, single) = (self.formats.lane(Arith::Main), self.formats.lane(Arith::Single));
        if self.same_format {
            return main.encode(raw);
        }
        let x = with_any_lane!(main, |lane| { wide(lane, raw) });
        with_any_lane!(single, |lane| { narrow(lane, x) })
    }
}

fn saturated(lane: &AnyLane, raw: u32) -> u32 {
    fn saturate<L: Lane>(lane: &L, raw: u32) -> u32 {
        L::store(lane.saturate(L::load(raw)))
    }
    with_any_lane!(lane, |lane| { saturate(lane, raw) })
}
