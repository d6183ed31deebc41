//! The batch executor on a tile: triangle by triangle, all 256 fragments at once.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use super::arith::Formats;
use super::fetch::BatchTexture;
use super::flow::FlowPlan;
use super::flow_run::FlowRun;
use super::graph::Arith;
use super::lane::LANES;
use super::output::Output;
use super::program::{StraightPlan, StraightProgram, has_flow, pixel_formats};
use super::raster::{TileWeights, cover, quads};
use super::schedule::Block;
use super::simd::SimdLevel;
use super::slots::{Row, Slots};
use super::steps::{Surroundings, fill_constants, raw_constants, run_steps};
use crate::event::FragmentCounts;
use crate::exec::{ResolvedConstants, TileDraw, TileExecutor, colors_written, inputs_read, sample_rules};
use crate::output::TargetTile;
use crate::raster::{ComponentMask, TriangleSetup};

/// The batch tile executor of one draw.
#[derive(Debug)]
pub struct BatchTiles<'a> {
    formats: Formats,
    textures: Vec<Option<BatchTexture<'a>>>,
    constants: Vec<[u32; 4]>,
    output: Output,
    inputs: ComponentMask,
    program: PixelCode,
}

#[derive(Debug)]
enum PixelCode {
    /// Scheduled once for each set of constant components that turns up.
    Straight(StraightProgram, Mutex<BTreeMap<u64, Arc<StraightPlan>>>),
    Flow(FlowPlan),
}

impl<'a> BatchTiles<'a> {
    /// Prepares a draw: decodes the program and the textures. `None` if the register format is none that
    /// [`crate::num::Format`] can be built with.
    pub fn new(draw: &TileDraw<'a>) -> Option<Self> {
        let program = crate::exec::program(draw.program);
        let formats = pixel_formats(draw.rules)?;
        let constants = ResolvedConstants::pixel(program, draw.rules, draw.bindings.constants);
        let rules = sample_rules(draw.rules);
        let code = if has_flow(program) {
            PixelCode::Flow(FlowPlan::pixel(program, draw.rules, &formats, &constants, &draw.bindings))
        } else {
            PixelCode::Straight(
                StraightProgram::new(program, draw.rules, &formats, &constants, &draw.bindings),
                Mutex::default(),
            )
        };
        let main = formats.lane(Arith::Main);
        let textures =
            draw.bindings.samplers.iter().map(|s| s.map(|binding| BatchTexture::new(binding, rules, main))).collect();
        Some(Self {
            textures,
            constants: raw_constants(&constants.float, &formats),
            output: Output { state: draw.output, rules: draw.output_rules(), written: colors_written(program) },
            inputs: inputs_read(program),
            program: code,
            formats,
        })
    }

    /// The same with chosen vector instructions; `None` for the widest that there are.
    #[must_use]
    pub fn with_simd_level(mut self, level: Option<SimdLevel>) -> Self {
        self.formats.set_simd(level);
        self
    }

    fn around(&self) -> Surroundings<'_> {
        Surroundings { formats: &self.formats, textures: &self.textures, constants: &self.constants }
    }

    fn run_straight(
        &self,
        program: &StraightProgram,
        plan: &StraightPlan,
        triangles: &[&TriangleSetup],
        tile: &mut TargetTile,
        counts: &mut FragmentCounts,
    ) {
        let mut walk = Walk::new(tile, plan.varying.slots, self.formats.simd());
        let mut uniform = Slots::new(plan.uniform.slots);
        fill_constants(&plan.uniform, &mut uniform);
        fill_constants(&plan.varying, &mut walk.slots);
        let around = self.around();
        for group in triangles.chunks(LANES) {
            self.uniforms(&plan.uniform, group, &mut uniform);
            for (lane, triangle) in group.iter().enumerate() {
                if !walk.enter(triangle, tile, counts) {
                    continue;
                }
                for (&(_, slot), &root) in plan.varying.given.iter().zip(&plan.uniform.roots) {
                    let raw = uniform.row(root)[lane];
                    walk.slots.give(slot, raw);
                }
                walk.interpolate(triangle, &plan.varying, &self.formats);
                run_steps(&plan.varying.steps, &around, &walk.run, &mut walk.slots);
                for &sampler in &program.fetches {
                    if let Some(count) = counts.fetches.get_mut(sampler) {
                        *count += walk.covered_count;
                    }
                }
                let results = (&plan.results, &self.formats, &walk.slots);
                self.output.run(results, (&walk.covered, &walk.depth), walk.origin, tile, counts);
            }
        }
    }

    /// Computes what is constant over each of up to 256 triangles, a triangle a lane.
    fn uniforms(&self, block: &Block, group: &[&TriangleSetup], slots: &mut Slots) {
        let single = self.formats.lane(Arith::Single);
        for &(component, slot) in &block.inputs {
            for (value, triangle) in slots.row_mut(slot).iter_mut().zip(group) {
                *value = triangle.planes.get(usize::from(component)).map_or(0, |p| single.decode(p.base));
            }
        }
        run_steps(&block.steps, &self.around(), &[0; LANES], slots);
    }

    fn run_flow(
        &self,
        plan: &FlowPlan,
        triangles: &[&TriangleSetup],
        tile: &mut TargetTile,
        counts: &mut FragmentCounts,
    ) {
        let mut walk = Walk::new(tile, plan.slots(), self.formats.simd());
        plan.fill(&mut walk.slots);
        let around = self.around();
        for triangle in triangles {
            if !walk.enter(triangle, tile, counts) {
                continue;
            }
            for &(component, slot) in plan.inputs() {
                let single = self.formats.lane(Arith::Single);
                walk.weights.make(triangle, walk.origin);
                walk.weights.component(triangle, component.into(), single, walk.slots.row_mut(slot));
            }
            let (run, covered) = (walk.run, walk.covered);
            FlowRun::new(plan, &around, &run, &covered).run(&mut walk.slots, &mut counts.fetches);
            let results = (plan.results(), &self.formats, &walk.slots);
            self.output.run(results, (&walk.covered, &walk.depth), walk.origin, tile, counts);
        }
    }
}

impl TileExecutor for BatchTiles<'_> {
    fn run_tile(&self, triangles: &[TriangleSetup], order: &[u32], tile: &mut TargetTile) -> FragmentCounts {
        let mut counts = FragmentCounts::default();
        let ordered: Vec<&TriangleSetup> = order.iter().filter_map(|&i| triangles.get(i as usize)).collect();
        match &self.program {
            PixelCode::Straight(program, plans) => {
                let constant = ordered.iter().fold(self.inputs.0, |mask, t| mask & t.constant.0);
                let known = plans.lock().unwrap_or_else(PoisonError::into_inner).get(&constant).cloned();
                let plan = known.unwrap_or_else(|| {
                    let plan = Arc::new(program.plan(ComponentMask(constant)));
                    plans.lock().unwrap_or_else(PoisonError::into_inner).insert(constant, Arc::clone(&plan));
                    plan
                });
                self.run_straight(program, &plan, &ordered, tile, &mut counts);
            }
            PixelCode::Flow(plan) => self.run_flow(plan, &ordered, tile, &mut counts),
        }
        counts
    }
}

/// A walk over the triangles of one tile.
struct Walk {
    simd: SimdLevel,
    origin: (u32, u32),
    slots: Slots,
    weights: TileWeights,
    covered: Row,
    covered_count: u64,
    /// Lanes of quads that have a covered lane.
    run: Row,
    depth: Row,
}

impl Walk {
    fn new(tile: &TargetTile, slots: usize, simd: SimdLevel) -> Self {
        Self {
            simd,
            origin: (tile.region.x & !15, tile.region.y & !15),
            slots: Slots::new(slots),
            weights: TileWeights::new(simd),
            covered: [0; LANES],
            covered_count: 0,
            run: [0; LANES],
            depth: [0; LANES],
        }
    }

    /// Finds what a triangle covers, and its depth; false if it covers nothing.
    fn enter(&mut self, triangle: &TriangleSetup, tile: &TargetTile, counts: &mut FragmentCounts) -> bool {
        self.covered_count = cover(triangle, self.origin, tile.region, self.simd, &mut self.covered);
        if self.covered_count == 0 {
            return false;
        }
        counts.generated += self.covered_count;
        counts.shaded += self.covered_count;
        quads(&self.covered, &mut self.run);
        if !triangle.depth_constant {
            self.weights.make(triangle, self.origin);
        }
        self.weights.depth(triangle, &mut self.depth);
        true
    }

    fn interpolate(&mut self, triangle: &TriangleSetup, block: &Block, formats: &Formats) {
        if !block.inputs.is_empty() {
            self.weights.make(triangle, self.origin);
        }
        for &(component, slot) in &block.inputs {
            let single = formats.lane(Arith::Single);
            self.weights.component(triangle, component.into(), single, self.slots.row_mut(slot));
        }
    }
}
