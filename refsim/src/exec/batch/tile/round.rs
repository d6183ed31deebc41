//! Preparation of a round of triangles: their plan, and values that are constant over each triangle.

use std::sync::Arc;

use rayon::prelude::*;
use refsim_lanes::{LANES, Slots};

use super::decoded::{DecodedPixel, PixelCode, plan};
use super::shader::InputSlots;
use crate::event::FragmentCounts;
use crate::exec::batch::cache::Pool;
use crate::exec::batch::run::{Surroundings, fill_constants, first_lanes, run_steps};
use crate::exec::batch::schedule::{FlowPlan, ResultSlots, StepBlock, StraightPlan, StraightProgram};
use crate::exec::batch::vertex::{Surfaces, Triangle};
use crate::raster::{ComponentMask, POSITION_COMPONENT};

/// Up to this number of triangles, computing their constants is faster than waking a worker.
const FEW: usize = 4 * LANES;

/// A round of triangles of a draw, with values computed for them before tiles are drawn.
#[derive(Debug)]
pub struct TileRound<'s> {
    pub(super) surfaces: &'s Surfaces,
    /// Components that are constant over every triangle.
    pub(super) constant: u64,
    pub(super) code: RoundCode<'s>,
    /// Values given to the plan's varying block: one list per value, indexed by triangle.
    pub(super) given: Vec<Vec<u32>>,
    /// Values given to the plan's invariant block.
    fixed: Vec<u32>,
    pub(super) inputs: InputSlots,
}

#[derive(Debug)]
pub(super) enum RoundCode<'s> {
    Straight(&'s StraightProgram, Arc<StraightPlan>),
    Flow(&'s FlowPlan),
}

impl<'s> TileRound<'s> {
    /// Prepares triangles: selects a plan, and computes per-triangle constants, one lane per triangle.
    pub(super) fn new(
        program: &'s DecodedPixel,
        surfaces: &'s Surfaces,
        inputs: ComponentMask,
        around: &Surroundings<'_>,
    ) -> Self {
        let constant = surfaces.all_constant() & inputs.0;
        let (code, fixed, given) = match &program.code {
            PixelCode::Straight(straight, plans) => {
                let plan = plan(straight, plans, constant);
                let given = uniforms(&program.uniforms, constant, &plan.uniform, surfaces, around);
                let fixed = fixed_values(&plan.fixed, around);
                (RoundCode::Straight(straight, plan), fixed, given)
            }
            PixelCode::Flow(plan) => (RoundCode::Flow(plan), Vec::new(), Vec::new()),
        };
        let wanted = match &code {
            RoundCode::Straight(_, plan) => &plan.invariant.inputs,
            RoundCode::Flow(plan) => plan.inputs(),
        };
        let row = |component: u16| surfaces.rows.iter().position(|row| row.component == usize::from(component));
        let axis = |component: u16| usize::from(component).checked_sub(POSITION_COMPONENT).filter(|&axis| axis < 4);
        let inputs = InputSlots {
            rows: wanted.iter().filter_map(|&(component, slot)| Some((row(component)?, slot))).collect(),
            position: wanted.iter().filter_map(|&(component, slot)| Some((axis(component)?, slot))).collect(),
        };
        Self { surfaces, constant, code, given, fixed, inputs }
    }

    /// Counts shaded fragments and their texture reads. Programs with flow control count reads as they run.
    pub(super) fn count(&self, fragments: u64, counts: &mut FragmentCounts) {
        counts.generated += fragments;
        counts.shaded += fragments;
        if let RoundCode::Straight(program, _) = &self.code {
            for &sampler in &program.fetches {
                if let Some(count) = counts.fetches.get_mut(sampler) {
                    *count += fragments;
                }
            }
        }
    }

    /// Passes values that are constant over the draw to the plan's invariant block.
    pub(super) fn give_fixed(&self, slots: &mut Slots) {
        if let RoundCode::Straight(_, plan) = &self.code {
            for (&(_, slot), &value) in plan.invariant.given.iter().zip(&self.fixed) {
                slots.give(slot, value);
            }
        }
    }

    /// Passes the values of a triangle to the plan's varying block.
    pub(super) fn give(&self, triangle: u32, slots: &mut Slots) {
        if let RoundCode::Straight(_, plan) = &self.code {
            for (&(_, slot), values) in plan.varying.given.iter().zip(&self.given) {
                slots.give(slot, values[triangle as usize]);
            }
        }
    }

    pub(super) fn results(&self) -> &ResultSlots {
        match &self.code {
            RoundCode::Straight(_, plan) => &plan.results,
            RoundCode::Flow(plan) => plan.results(),
        }
    }
}

/// Computes values that are constant over the draw, in one lane.
fn fixed_values(block: &StepBlock, around: &Surroundings<'_>) -> Vec<u32> {
    if block.roots.is_empty() {
        return Vec::new();
    }
    let mut slots = Slots::new(block.slots);
    fill_constants(block, &mut slots);
    run_steps(&block.steps, around, &first_lanes(1), &mut slots);
    block.roots.iter().map(|&root| slots.row(root)[0]).collect()
}

/// Computes per-triangle constants: one list per root of the block, indexed by triangle.
fn uniforms(
    idle: &Pool<(u64, Slots)>,
    constant: u64,
    block: &StepBlock,
    surfaces: &Surfaces,
    around: &Surroundings<'_>,
) -> Vec<Vec<u32>> {
    if block.roots.is_empty() {
        return Vec::new();
    }
    let compute = |group: &[Triangle]| {
        let mut slots = idle.take(|known| known.0 == constant).map_or_else(
            || {
                let mut slots = Slots::new(block.slots);
                fill_constants(block, &mut slots);
                slots
            },
            |known| known.1,
        );
        for &(component, slot) in &block.inputs {
            let Some(row) = surfaces.row(component) else { continue };
            for (value, triangle) in slots.row_mut(slot).iter_mut().zip(group) {
                // Inputs are single precision, so their bits are raw values.
                *value = row.base[triangle.planes as usize];
            }
        }
        run_steps(&block.steps, around, &first_lanes(group.len()), &mut slots);
        let values = block.roots.iter().map(|&root| slots.row(root)[..group.len()].to_vec()).collect::<Vec<_>>();
        idle.keep((constant, slots));
        values
    };
    let groups: Vec<_> = if surfaces.len() <= FEW {
        surfaces.triangles.chunks(LANES).map(compute).collect()
    } else {
        surfaces.triangles.par_chunks(LANES).map(compute).collect()
    };
    let whole = |root: usize| groups.iter().flat_map(|group| group[root].iter().copied()).collect();
    (0..block.roots.len()).map(whole).collect()
}
