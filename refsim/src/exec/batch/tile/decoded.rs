//! Cache of decoded pixel programs.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use refsim_lanes::Slots;

use super::shader::TileShader;
use crate::device::Rules;
use crate::event::SAMPLERS;
use crate::exec::batch::cache::{Cache, Pool};
use crate::exec::batch::schedule::{FlowPlan, StraightPlan, StraightProgram};
use crate::exec::fragment::zero_components;
use crate::exec::lower::{Formats, has_flow};
use crate::exec::{BUMP_STAGES, BumpStage, Projection, ResolvedConstants, TileDraw};
use crate::isa::Program;
use crate::raster::ComponentMask;
use crate::texture::TextureKind;

/// A decoded program, and idle worker buffers by the constant components of their plan.
#[derive(Debug)]
pub(crate) struct DecodedPixel {
    pub(crate) code: PixelCode,
    pub(crate) shaders: Pool<(u64, TileShader)>,
    pub(crate) uniforms: Pool<(u64, Slots)>,
}

#[derive(Debug)]
pub(crate) enum PixelCode {
    /// A program without flow control, scheduled on demand for each set of constant components.
    Straight(StraightProgram, Mutex<BTreeMap<u64, Arc<StraightPlan>>>),
    Flow(FlowPlan),
}

/// Key of the cache: all inputs of decoding.
#[derive(Debug)]
pub(crate) struct PixelKey {
    program: Program,
    rules: Rules,
    constants: ResolvedConstants,
    budget: u32,
    /// For bound textures: `true` if reads need a level of detail, the kind of texture, and the components read as 0.
    samplers: [Option<(bool, TextureKind, Range<usize>)>; SAMPLERS],
    bump: [BumpStage; BUMP_STAGES],
    projections: [Projection; BUMP_STAGES],
}

pub(crate) type PixelPrograms = Cache<PixelKey, DecodedPixel>;

/// Returns a decoded pixel program, from the cache if possible.
pub(crate) fn decoded(
    programs: &PixelPrograms,
    program: &Program,
    draw: &TileDraw<'_>,
    constants: &ResolvedConstants,
) -> Arc<DecodedPixel> {
    let (rules, bindings) = (draw.rules, &draw.bindings);
    let samplers = bindings.samplers.map(|s| {
        let image = s?.image;
        Some((s?.needs_detail(), image.kind(), zero_components(program.version, Some(image.format()))))
    });
    let matches = |key: &PixelKey| {
        key.samplers == samplers
            && key.bump == bindings.bump
            && key.projections == bindings.projections
            && key.budget == draw.step_budget
            && key.program == *program
            && key.constants == *constants
            && key.rules == *rules
    };
    programs.get(matches, || {
        let (program, constants, formats) = (program.clone(), constants.clone(), Formats::pixel(program, rules));
        let code = if has_flow(&program) {
            PixelCode::Flow(FlowPlan::new(&program, rules, formats, &constants, Some(bindings), draw.step_budget))
        } else {
            PixelCode::Straight(StraightProgram::new(&program, rules, formats, &constants, bindings), Mutex::default())
        };
        let (bump, projections, budget) = (bindings.bump, bindings.projections, draw.step_budget);
        let key = PixelKey {
            program,
            rules: rules.clone(),
            constants,
            budget,
            samplers: samplers.clone(),
            bump,
            projections,
        };
        (key, DecodedPixel { code, shaders: Pool::default(), uniforms: Pool::default() })
    })
}

/// Returns the plan for triangles with these constant components, created on first use.
pub(crate) fn plan(
    program: &StraightProgram,
    plans: &Mutex<BTreeMap<u64, Arc<StraightPlan>>>,
    constant: u64,
) -> Arc<StraightPlan> {
    let mut plans = plans.lock().unwrap_or_else(PoisonError::into_inner);
    Arc::clone(plans.entry(constant).or_insert_with(|| Arc::new(program.plan(ComponentMask(constant)))))
}
