//! The batch executor on a tile: part after part, all 256 fragments at once.

use std::sync::Arc;

use rayon::prelude::*;

use super::decoded::{DecodedPixel, PixelCode, PixelPrograms, decoded, plan};
use super::output::{OutputStage, Shaded};
use super::raster::TileFrame;
use super::shader::{InputSlots, PartMode, TileShader};
use super::store::Survivors;
use super::targets::Targets;
use crate::event::FragmentCounts;
use crate::exec::batch::lanes::{LANES, LaneFormats, SimdLevel};
use crate::exec::batch::run::{
    BatchTexture, FlowRun, Slots, Surroundings, TextureTables, fill_constants, fill_plan, raw_constants, run_steps,
};
use crate::exec::batch::schedule::{FlowPlan, ResultSlots, StepBlock, StraightPlan, StraightProgram};
use crate::exec::batch::vertex::{Surfaces, Triangle};
use crate::exec::budget::straight_exceeds;
use crate::exec::lower::{Arith, Formats, has_flow};
use crate::exec::{Overrun, ResolvedConstants, TileDraw, colors_written, inputs_read, output_rules, sample_rules};
use crate::output::{DepthFormat, TargetTile};
use crate::raster::{ComponentMask, POSITION_COMPONENT, TriangleSetup};
use crate::texture::Region;

/// Triangles whose constants are computed sooner than a worker is woken up.
const FEW: usize = 4 * LANES;
/// Triangles a worker gets at least where several share a tile.
const FEWEST_SHARED: usize = 16;

/// The batch tile executor of one draw.
#[derive(Debug)]
pub struct BatchTiles<'a> {
    formats: LaneFormats,
    textures: Vec<Option<BatchTexture<'a>>>,
    constants: Vec<[u32; 4]>,
    output: OutputStage,
    inputs: ComponentMask,
    program: Arc<DecodedPixel>,
}

/// Some triangles of a draw, with what is computed for them before tiles are walked.
#[derive(Debug)]
pub struct TileRound<'s> {
    surfaces: &'s Surfaces,
    /// The components that are constant over every triangle.
    constant: u64,
    code: RoundCode<'s>,
    /// For each value that the plan's varying block is given, a row of values by triangle.
    given: Vec<Vec<u32>>,
    inputs: InputSlots,
}

#[derive(Debug)]
enum RoundCode<'s> {
    Straight(&'s StraightProgram, Arc<StraightPlan>),
    Flow(&'s FlowPlan),
}

impl TileRound<'_> {
    fn results(&self) -> &ResultSlots {
        match &self.code {
            RoundCode::Straight(_, plan) => &plan.results,
            RoundCode::Flow(plan) => plan.results(),
        }
    }
}

impl<'a> BatchTiles<'a> {
    /// Prepares a draw: decodes the program and the textures, or finds them decoded. `None` if the program has more
    /// values than there are slots, or if no fragment can end within the step budget: only the scalar executor counts
    /// the steps of programs without flow control.
    pub(crate) fn new(
        draw: &TileDraw<'a>,
        (programs, tables): (&PixelPrograms, &TextureTables),
        simd: SimdLevel,
    ) -> Option<Self> {
        let program = crate::exec::program(draw.program);
        if !has_flow(program) && straight_exceeds(program, draw.step_budget) {
            return None;
        }
        let formats = LaneFormats::new(Formats::pixel(draw.rules), simd);
        let constants = ResolvedConstants::pixel(program, draw.rules, draw.bindings.constants);
        let rules = sample_rules(draw.rules);
        let code = decoded(programs, program, draw, &constants);
        if matches!(&code.code, PixelCode::Straight(straight, _) if !straight.fits_slots()) {
            return None;
        }
        let main = formats.lane(Arith::Main);
        let textures = draw
            .bindings
            .samplers
            .iter()
            .map(|s| s.map(|binding| BatchTexture::new(binding, rules, main, tables)))
            .collect();
        Some(Self {
            textures,
            constants: raw_constants(&constants.float, &formats),
            output: OutputStage {
                state: draw.output,
                rules: output_rules(draw.rules),
                written: colors_written(program),
            },
            inputs: inputs_read(program),
            program: code,
            formats,
        })
    }

    /// The vector instructions in use.
    pub fn simd(&self) -> SimdLevel {
        self.formats.simd()
    }

    /// The components that the program can read.
    pub fn inputs(&self) -> ComponentMask {
        self.inputs
    }

    /// Whether the program never looks at neighbouring fragments, so that a tile may have a single row.
    pub fn fragments_apart(&self) -> bool {
        match &self.program.code {
            PixelCode::Straight(program, _) => program.lanes_apart,
            PixelCode::Flow(_) => false,
        }
    }

    fn around(&self) -> Surroundings<'_> {
        Surroundings { formats: &self.formats, textures: &self.textures, constants: &self.constants }
    }

    /// Prepares some triangles: chooses a plan, and computes what is constant over each of them, one lane per triangle.
    pub fn round<'s>(&'s self, surfaces: &'s Surfaces) -> TileRound<'s> {
        let constant = surfaces.all_constant() & self.inputs.0;
        let (code, given) = match &self.program.code {
            PixelCode::Straight(program, plans) => {
                let plan = plan(program, plans, constant);
                let given = self.uniforms(constant, &plan.uniform, surfaces);
                (RoundCode::Straight(program, plan), given)
            }
            PixelCode::Flow(plan) => (RoundCode::Flow(plan), Vec::new()),
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
        TileRound { surfaces, constant, code, given, inputs }
    }

    /// Computes what is constant over each triangle: for each root of the block a value by triangle.
    fn uniforms(&self, constant: u64, block: &StepBlock, surfaces: &Surfaces) -> Vec<Vec<u32>> {
        if block.roots.is_empty() {
            return Vec::new();
        }
        let idle = &self.program.uniforms;
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
                    // A pattern is the number's host bits: single precision is the host's own.
                    *value = row.base[triangle.planes as usize];
                }
            }
            run_steps(&block.steps, &self.around(), &[0; LANES], &mut slots);
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

    /// Draws the triangles `order` of a round, in the order of submission, into a tile. Per pixel their order is kept.
    /// Up to `workers` threads shade at a time; that changes nothing but the time it takes.
    ///
    /// Returns what became of the fragments; helper lanes are not counted.
    ///
    /// # Errors
    /// The first fragment, as [`Overrun`]s order, that does not end within the step budget. The tile is of no use then.
    pub fn draw(
        &self,
        round: &TileRound<'_>,
        order: &[u32],
        tile: &mut TargetTile,
        workers: usize,
    ) -> Result<FragmentCounts, Overrun> {
        let region = tile.region;
        let depth = tile.depth.as_ref().map(|buffer| buffer.format);
        let mut targets = Targets::load(tile, self.output.written, &self.output.state, &self.output.rules);
        let mut counts;
        // What shading leaves is kept as fragments until it is their turn: worth it where most are killed.
        let few_left = round.results().killed.is_some() || self.output.state.alpha.is_some();
        if workers > 1 && few_left && order.len() >= FEWEST_SHARED * workers {
            let share = order.len().div_ceil(workers).next_multiple_of(2);
            let (own, others) = order.split_at(share.min(order.len()));
            let mut rest: Vec<_> =
                others.chunks(share).map(|part| (part, Vec::new(), Ok(FragmentCounts::default()))).collect();
            // The first share is this thread's own, and merged while the others are on their way.
            counts = rayon::in_place_scope(|scope| {
                for (part, fragments, counts) in &mut rest {
                    scope.spawn(move |_| {
                        *counts = self.shade_all(round, part, (region, depth), |shaded, survivors, _| {
                            shaded.gather(survivors, fragments);
                        });
                    });
                }
                self.shade_all(round, own, (region, depth), |shaded, survivors, counts| {
                    self.output.merge(shaded, survivors, &mut targets, counts);
                })
            })?;
            for (_, fragments, more) in &rest {
                counts += (*more)?;
                for fragment in fragments {
                    self.output.merge_one(fragment, &self.formats, &mut targets, &mut counts);
                }
            }
        } else {
            counts = self.shade_all(round, order, (region, depth), |shaded, survivors, counts| {
                self.output.merge(shaded, survivors, &mut targets, counts);
            })?;
        }
        targets.store();
        Ok(counts)
    }

    /// Draws one triangle into a tile.
    pub(crate) fn draw_one(&self, triangle: &TriangleSetup, tile: &mut TargetTile) -> Result<FragmentCounts, Overrun> {
        let surfaces = Surfaces::from_setups(std::slice::from_ref(triangle), self.inputs);
        self.draw(&self.round(&surfaces), &[0], tile, 1)
    }

    /// Runs the program for some triangles, part after part; `merge` gets what the tests before the depth test leave.
    fn shade_all(
        &self,
        round: &TileRound<'_>,
        order: &[u32],
        (region, depth): (Region, Option<DepthFormat>),
        mut merge: impl FnMut(Shaded<'_>, &mut Survivors, &mut FragmentCounts),
    ) -> Result<FragmentCounts, Overrun> {
        let mut counts = FragmentCounts::default();
        let mut shader = self.shader(round);
        shader.start(region);
        let mut survivors = Survivors::new();
        let manner = self.manner(round, depth.is_some());
        let mut at = 0;
        while at < order.len() {
            let part = &order[at..];
            at += shader.take(round.surfaces, part, manner).max(1);
            if shader.covered_count == 0 {
                continue;
            }
            self.shade(round, part[0], &mut shader, &mut counts)?;
            let shaded = Shaded {
                results: round.results(),
                formats: &self.formats,
                slots: &shader.slots,
                covered: &shader.covered,
                depth: &shader.depth,
            };
            self.output.test(shaded, depth, &mut survivors, &mut counts);
            merge(shaded, &mut survivors, &mut counts);
        }
        self.program.shaders.keep((round.constant, shader));
        Ok(counts)
    }

    /// Rows for a plan, used before or new.
    fn shader(&self, round: &TileRound<'_>) -> TileShader {
        let fit = |(constant, shader): &(u64, TileShader)| {
            *constant == round.constant && shader.simd() == self.formats.simd()
        };
        if let Some((_, shader)) = self.program.shaders.take(fit) {
            return shader;
        }
        match &round.code {
            RoundCode::Flow(plan) => {
                let mut shader = TileShader::new(plan.slots(), self.formats.simd());
                fill_plan(plan, &mut shader.slots);
                shader
            }
            RoundCode::Straight(_, plan) => {
                let mut shader = TileShader::new(plan.varying.slots.max(plan.invariant.slots), self.formats.simd());
                fill_constants(&plan.invariant, &mut shader.slots);
                fill_constants(&plan.varying, &mut shader.slots);
                shader
            }
        }
    }

    fn manner(&self, round: &TileRound<'_>, has_depth: bool) -> PartMode {
        let together = match &round.code {
            RoundCode::Straight(program, _) => program.lanes_apart,
            RoundCode::Flow(_) => false,
        };
        let tested = has_depth && self.output.state.depth.test.is_some();
        PartMode { together, depth: tested && !round.results().decide_depth(), given: round.constant }
    }

    /// Runs the program for the part that the shader has taken, whose first triangle is `first`.
    fn shade(
        &self,
        round: &TileRound<'_>,
        first: u32,
        shader: &mut TileShader,
        counts: &mut FragmentCounts,
    ) -> Result<(), Overrun> {
        counts.generated += shader.covered_count;
        counts.shaded += shader.covered_count;
        let around = self.around();
        match &round.code {
            RoundCode::Straight(program, plan) => {
                if shader.fill_inputs(round.surfaces, &round.inputs, &self.formats) {
                    run_steps(&plan.invariant.steps, &around, &shader.run, &mut shader.slots);
                }
                for (&(_, slot), values) in plan.varying.given.iter().zip(&round.given) {
                    shader.slots.give(slot, values[first as usize]);
                }
                run_steps(&plan.varying.steps, &around, &shader.run, &mut shader.slots);
                for &sampler in &program.fetches {
                    if let Some(count) = counts.fetches.get_mut(sampler) {
                        *count += shader.covered_count;
                    }
                }
            }
            RoundCode::Flow(plan) => {
                shader.forget_inputs();
                shader.fill_inputs(round.surfaces, &round.inputs, &self.formats);
                let frame = shader.frame();
                let TileShader { slots, run, covered, .. } = shader;
                let mut run = FlowRun::new(plan, &around, run, covered);
                run.run(slots, &mut counts.fetches);
                if let Some(overrun) = overrun(&run.cut, frame, first) {
                    return Err(overrun);
                }
            }
        }
        Ok(())
    }
}

/// The first of the fragments of a triangle that were cut off, given by lane.
pub(crate) fn overrun(cut: &[(usize, usize)], frame: TileFrame, triangle: u32) -> Option<Overrun> {
    let of = |&(lane, instruction): &(usize, usize)| {
        let (x, y) = frame.pixel(lane);
        Overrun { triangle, y, x, instruction }
    };
    cut.iter().map(of).min()
}
