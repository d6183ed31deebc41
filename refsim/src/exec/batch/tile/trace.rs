//! Pixel traces of the batch executor: the program's graph, scheduled so that every instruction's result is kept, is
//! executed on the rows of the pixel's tile, and one lane is read.
//!
//! A draw omits unused values and evaluates per-triangle constants separately, so the outcome of the fragment is
//! determined by the draw's own executor.

use std::collections::BTreeMap;

use super::raster::{TileFrame, TileShape, TileWeights, cover, quads};
use super::shading::overrun;
use super::tiles::BatchTiles;
use crate::event::{FragmentCounts, SAMPLERS};
use crate::exec::batch::lanes::{LANES, LaneFormats, LaneRow};
use crate::exec::batch::run::{
    BatchTexture, FlowObserver, FlowRun, Slots, Surroundings, TextureTables, fill_constants, fill_plan, raw_constants,
    run_steps,
};
use crate::exec::batch::schedule::{FlowPlan, ResultSlots, StepBlock, schedule};
use crate::exec::lower::{
    ACTIVE, Arith, Effect, Ends, Formats, NodeId, Slot, Translator, has_flow, of_file, translate_straight,
};
use crate::exec::trace::{as_written, canonical, makes_step, written_mask};
use crate::exec::usage::registers_delivered;
use crate::exec::{
    DepthValue, FragmentResult, Overrun, PixelTracer, ResolvedConstants, Shading, Step, TileDraw, inputs_read,
    sample_rules,
};
use crate::isa::{Mask, Opcode, Program, Register, RegisterFile};
use crate::num::{Flags, ops};
use crate::output::{FragmentFate, TargetTile};
use crate::raster::{
    COLOR_COMPONENT, COMPONENTS, ComponentMask, FOG_COMPONENT, FragmentInput, POSITION_COMPONENT, TriangleSetup,
};

/// Maximum number of instructions whose results are kept in one run; a longer program is run several times.
const MAX_KEPT: usize = 4096;

/// Pixel tracer of one draw.
#[derive(Debug)]
pub struct BatchTracer<'a> {
    tiles: BatchTiles<'a>,
    formats: LaneFormats,
    textures: Vec<Option<BatchTexture<'a>>>,
    constants: Vec<[u32; 4]>,
    program: &'a Program,
    reads: ComponentMask,
    delivered: (Vec<Register>, StepBlock),
    code: TracedProgram,
}

#[derive(Debug)]
enum TracedProgram {
    /// Runs over the whole program, each keeping the results of some instructions; the last one has the outputs.
    Straight(Vec<StraightPart>, Ends),
    Flow(FlowPlan),
}

/// A run, with the instructions whose results its roots are.
#[derive(Debug)]
struct StraightPart {
    written: Vec<(usize, Mask, Arith)>,
    block: StepBlock,
}

impl<'a> BatchTracer<'a> {
    /// Prepares traces of a draw, for which `tiles` was prepared.
    pub(crate) fn new(draw: &TileDraw<'a>, tiles: BatchTiles<'a>, tables: &TextureTables) -> Self {
        let program = crate::exec::program(draw.program);
        let formats = LaneFormats::new(Formats::pixel(program, draw.rules), tiles.simd());
        let constants = ResolvedConstants::pixel(program, draw.rules, draw.bindings.constants);
        let rules = sample_rules(draw.rules);
        let reads = inputs_read(program);
        let translator =
            || Translator::new(program, draw.rules, formats.table().clone(), &constants, Some(&draw.bindings));
        let delivered = delivered(&mut translator(), program);
        let code = if has_flow(program) {
            TracedProgram::Flow(FlowPlan::pixel(
                program,
                draw.rules,
                formats.table().clone(),
                &constants,
                &draw.bindings,
                draw.step_budget,
            ))
        } else {
            straight(&mut translator(), program)
        };
        let main = formats.lane(Arith::Main);
        let textures =
            draw.bindings.samplers.iter().map(|s| s.map(|b| BatchTexture::new(b, rules, main, tables))).collect();
        let constants = raw_constants(&constants.float, &formats);
        Self { tiles, textures, constants, program, reads, delivered, code, formats }
    }

    fn main(&self, slots: &Slots, slot: Slot, lane: usize) -> u32 {
        self.formats.lane(Arith::Main).encode(slots.row(slot)[lane])
    }

    /// Contents of a slot as a number; a packed word is shown as the number that it encodes.
    fn number(&self, arith: Arith, slots: &Slots, slot: Slot, lane: usize) -> u32 {
        let format = self.formats.format(arith);
        let bits = self.formats.lane(arith).encode(slots.row(slot)[lane]);
        if self.program.version.is_fragment_program() { ops::convert(&format, format, bits).bits } else { bits }
    }

    fn output(&self, results: &ResultSlots, slots: &Slots, lane: usize) -> FragmentResult {
        let holds = |slot: Slot| slots.row(slot)[lane] != 0;
        let own = results.depth.filter(|(_, _, decided)| decided.is_none_or(holds));
        FragmentResult {
            killed: results.killed.is_some_and(holds),
            colors: results.colors.map(|c| c.map_or([0; 4], |c| c.map(|slot| self.main(slots, slot, lane)))),
            depth: own.map(|(arith, slot, _)| DepthValue {
                format: self.formats.format(arith),
                bits: self.formats.lane(arith).encode(slots.row(slot)[lane]),
            }),
        }
    }
}

/// Input registers with interpolated values, and a block that computes them.
fn delivered(t: &mut Translator<'_>, program: &Program) -> (Vec<Register>, StepBlock) {
    let registers = registers_delivered(program);
    let roots: Vec<NodeId> = registers.iter().flat_map(|r| [0, 1, 2, 3].map(|c| t.held(r, c))).collect();
    let block = schedule(&t.make.graph, &roots, |_| false, &BTreeMap::new(), 0);
    (registers, block)
}

/// Format of an instruction's result.
fn format_of(program: &Program, at: usize) -> Arith {
    let destination = program.instructions.get(at).and_then(|i| i.destination);
    destination.map_or(Arith::Main, |d| of_file(d.register.file))
}

fn straight(t: &mut Translator<'_>, program: &Program) -> TracedProgram {
    let mut written: Vec<(usize, Mask, Vec<NodeId>)> = Vec::new();
    let ends = translate_straight(t, program, |at, effects| {
        if !program.instructions.get(at).is_some_and(makes_step) {
            return;
        }
        let values = effects.iter().filter_map(|effect| match effect {
            Effect::Write((_, _, component), value, _) => Some((*component, *value)),
            _ => None,
        });
        let (components, nodes): (Vec<u8>, Vec<NodeId>) = values.unzip();
        written.push((at, written_mask(&program.instructions[at], components.into_iter()), nodes));
    });
    let mut chunks: Vec<&[_]> = written.chunks(MAX_KEPT).collect();
    if chunks.is_empty() {
        chunks.push(&[]);
    }
    let parts = chunks.into_iter().map(|chunk| {
        let mut roots = ends.roots();
        roots.extend(chunk.iter().flat_map(|(_, _, nodes)| nodes.iter().copied()));
        StraightPart {
            written: chunk.iter().map(|&(at, mask, _)| (at, mask, format_of(program, at))).collect(),
            block: schedule(&t.make.graph, &roots, |_| false, &BTreeMap::new(), 0),
        }
    });
    TracedProgram::Straight(parts.collect(), ends)
}

/// Rows of the tile in which a triangle is traced.
struct Rows<'t> {
    triangle: &'t TriangleSetup,
    frame: TileFrame,
    weights: TileWeights,
    covered: LaneRow,
    run: LaneRow,
    lane: usize,
}

impl Rows<'_> {
    fn fill(&mut self, inputs: &[(u16, Slot)], formats: &LaneFormats, slots: &mut Slots) {
        self.weights.make(self.triangle, self.frame);
        for &(component, slot) in inputs {
            let single = formats.lane(Arith::Single);
            let row = slots.row_mut(slot);
            match usize::from(component).checked_sub(POSITION_COMPONENT) {
                Some(axis) => self.weights.position(self.triangle, axis, self.frame, row),
                None => self.weights.component(self.triangle, component.into(), single, row),
            }
        }
    }

    fn input(&mut self, reads: ComponentMask, formats: &LaneFormats) -> FragmentInput {
        let single = formats.lane(Arith::Single);
        let mut row = [0; LANES];
        self.weights.make(self.triangle, self.frame);
        self.weights.depth(self.triangle, &mut row);
        let mut input = FragmentInput { depth: row[self.lane], ..FragmentInput::default() };
        if reads.has(POSITION_COMPONENT) {
            for (axis, value) in input.position.iter_mut().enumerate() {
                self.weights.position(self.triangle, axis, self.frame, &mut row);
                *value = single.encode(row[self.lane]);
            }
        }
        for component in (0..COMPONENTS).filter(|&c| reads.has(c)) {
            self.weights.component(self.triangle, component, single, &mut row);
            let value = single.encode(row[self.lane]);
            match component {
                FOG_COMPONENT => input.fog = value,
                COLOR_COMPONENT.. => input.v[(component - COLOR_COMPONENT) / 4][component % 4] = value,
                _ => input.t[component / 4][component % 4] = value,
            }
        }
        canonical(input)
    }
}

impl BatchTracer<'_> {
    fn run_block(&self, block: &StepBlock, rows: &mut Rows<'_>) -> Slots {
        let mut slots = Slots::new(block.slots);
        fill_constants(block, &mut slots);
        rows.fill(&block.inputs, &self.formats, &mut slots);
        run_steps(&block.steps, &self.around(), &rows.run, &mut slots);
        slots
    }

    fn around(&self) -> Surroundings<'_> {
        Surroundings { formats: &self.formats, textures: &self.textures, constants: &self.constants }
    }

    fn run_straight(&self, parts: &[StraightPart], ends: &Ends, rows: &mut Rows<'_>) -> (Vec<Step>, FragmentResult) {
        let (mut steps, mut output) = (Vec::new(), FragmentResult::default());
        for part in parts {
            let slots = self.run_block(&part.block, rows);
            output = self.output(&ends.results(&part.block.roots), &slots, rows.lane);
            let mut roots = part.block.roots.iter().skip(ends.roots().len());
            for &(instruction, mask, arith) in &part.written {
                let mut value = [0; 4];
                for (c, &slot) in mask.components().zip(&mut roots) {
                    value[c] = self.number(arith, &slots, slot, rows.lane);
                }
                steps.push(step(instruction, rows.lane, mask, value));
            }
        }
        (steps, output)
    }

    fn run_flow(&self, plan: &FlowPlan, rows: &mut Rows<'_>) -> Result<(Vec<Step>, FragmentResult), Overrun> {
        let mut slots = Slots::new(plan.slots());
        fill_plan(plan, &mut slots);
        rows.fill(plan.inputs(), &self.formats, &mut slots);
        let mut watch = LaneWatch { tracer: self, plan, lane: rows.lane, mask: None, steps: Vec::new() };
        let around = self.around();
        let mut run = FlowRun::new(plan, &around, &rows.run, &rows.covered);
        run.run_watched(&mut slots, &mut [0; SAMPLERS], &mut watch);
        match overrun(&run.cut, rows.frame, 0) {
            Some(overrun) => Err(overrun),
            None => Ok((watch.steps, self.output(plan.results(), &slots, rows.lane))),
        }
    }
}

fn step(instruction: usize, lane: usize, mask: Mask, value: [u32; 4]) -> Step {
    // Lanes of a tile are 16 per row; a step has those of a quad.
    let lane = lane & 1 | (lane >> 4 & 1) << 1;
    Step { instruction, lane, mask, value, flags: Flags::empty() }
}

/// Records the writes of one lane in a program with flow control.
struct LaneWatch<'w> {
    tracer: &'w BatchTracer<'w>,
    plan: &'w FlowPlan,
    lane: usize,
    /// Components that the current instruction may write; `None` if the lane is inactive.
    mask: Option<Mask>,
    steps: Vec<Step>,
}

impl LaneWatch<'_> {
    fn held(&self, slots: &Slots, file: RegisterFile, index: u16, component: usize) -> u32 {
        self.plan.register(file, index, component as u8).map_or(0, |slot| slots.row(slot)[self.lane])
    }
}

impl FlowObserver for LaneWatch<'_> {
    fn before(&mut self, at: usize, slots: &Slots) {
        self.mask = None;
        let Some(instruction) = self.tracer.program.instructions.get(at).filter(|i| makes_step(i)) else { return };
        if slots.row(ACTIVE)[self.lane] == 0 {
            return;
        }
        let mut mask = match (&instruction.destination, instruction.opcode) {
            (_, Opcode::TexKill) | (None, _) => Mask(0),
            (Some(destination), _) => destination.mask,
        };
        if let Some(predicate) = &instruction.predicate {
            for c in mask.components() {
                let bit = usize::from(predicate.swizzle.0[c] & 3);
                if (self.held(slots, RegisterFile::Predicate, 0, bit) != 0) == predicate.not {
                    mask.0 &= !(1 << c);
                }
            }
        }
        self.mask = Some(mask);
    }

    fn after(&mut self, at: usize, slots: &Slots) {
        let program = self.tracer.program;
        let Some((mask, instruction)) = self.mask.take().zip(program.instructions.get(at)) else { return };
        let mut value = [0; 4];
        if let Some(destination) = &instruction.destination {
            let (file, index) = (destination.register.file, destination.register.index);
            for c in mask.components() {
                let raw = match file {
                    RegisterFile::DepthOut => self.held(slots, file, 0, 0),
                    _ => self.held(slots, file, index, c),
                };
                value[c] = match file {
                    RegisterFile::Predicate => u32::from(raw != 0),
                    _ => self.tracer.formats.lane(Arith::Main).encode(raw),
                };
            }
        }
        self.steps.push(as_written(step(at, self.lane, mask, value), program));
    }
}

impl PixelTracer for BatchTracer<'_> {
    fn follow(&self, triangle: &TriangleSetup, tile: &mut TargetTile) -> Result<Shading, Overrun> {
        let (x, y) = (tile.region.x, tile.region.y);
        let mut rows = Rows {
            triangle,
            frame: TileFrame { origin: (x & !15, y & !15), shape: TileShape::Square },
            weights: TileWeights::new(self.formats.simd()),
            covered: [0; LANES],
            run: [0; LANES],
            lane: ((y & 15) * 16 + (x & 15)) as usize,
        };
        cover(triangle, rows.frame, tile.region, self.formats.simd(), &mut rows.covered);
        quads(&rows.covered, &mut rows.run);
        let (registers, block) = &self.delivered;
        let slots = self.run_block(block, &mut rows);
        let values = block.roots.chunks_exact(4).map(|r| [0, 1, 2, 3].map(|c| self.main(&slots, r[c], rows.lane)));
        let delivered = registers.iter().copied().zip(values).collect();
        let (steps, output) = match &self.code {
            TracedProgram::Straight(parts, ends) => self.run_straight(parts, ends, &mut rows),
            TracedProgram::Flow(plan) => self.run_flow(plan, &mut rows)?,
        };
        let counts = self.tiles.draw_one(triangle, tile)?;
        Ok(Shading { input: rows.input(self.reads, &self.formats), delivered, steps, output, fate: fate(&counts) })
    }
}

/// Outcome of the single fragment that was counted.
fn fate(counts: &FragmentCounts) -> FragmentFate {
    match counts {
        FragmentCounts { killed: 1.., .. } => FragmentFate::KilledByShader,
        FragmentCounts { alpha_failed: 1.., .. } => FragmentFate::AlphaFailed,
        FragmentCounts { depth_failed: 1.., .. } => FragmentFate::DepthFailed,
        FragmentCounts { passed: 1.., .. } => FragmentFate::Passed,
        _ => FragmentFate::OutsideTile,
    }
}
