//! Vertex programs on batches of 256 vertices, with attributes and results in rows.

use std::collections::BTreeMap;
use std::sync::Arc;

use rayon::prelude::*;
use refsim_lanes::{LANES, SimdLevel, Slots};

use super::rows::VertexRows;
use crate::device::{ColorClamp, Rules};
use crate::event::SAMPLERS;
use crate::exec::batch::cache::{Cache, Pool};
use crate::exec::batch::formats::LaneFormats;
use crate::exec::batch::run::{
    FlowRun, Surroundings, fill_constants, fill_plan, first_lanes, raw_constants, run_steps,
};
use crate::exec::batch::schedule::{FlowPlan, StepBlock, schedule};
use crate::exec::budget::straight_exceeds;
use crate::exec::lower::{
    Arith, CONSTANT_INPUTS, Formats, NodeId, RegisterComponent, Slot, Translator, has_flow, translate_straight_vertex,
};
use crate::exec::{Constants, ResolvedConstants};
use crate::isa::{Instruction, Program, RegisterFile};
use crate::num::{Format, NumberOperation};
use crate::raster::{COLOR_COMPONENT, COMPONENTS, ComponentMask, FOG_COMPONENT};

/// Vertices per task; a single task runs on the calling thread.
const SPAN: usize = 16 * LANES;

/// Source of attributes: `fill(register, component, first, row)` writes the single-precision patterns of `v#register`
/// for the vertices from `first` on.
pub type AttributeRows<'f> = dyn Fn(usize, usize, usize, &mut [u32]) + Sync + 'f;

/// A vertex program prepared for batches; equivalent to [`crate::exec::scalar::VertexProgram`].
#[derive(Debug)]
pub struct BatchVertices {
    formats: LaneFormats,
    color_clamp: ColorClamp,
    constants: Vec<[u32; 4]>,
    /// Components that are computed after the four of the position.
    components: Vec<usize>,
    code: Arc<DecodedVertex>,
}

/// A decoded program, and idle buffers.
#[derive(Debug)]
pub(crate) struct DecodedVertex {
    code: VertexCode,
    slots: Pool<Slots>,
}

/// A program without or with flow control.
#[derive(Debug)]
enum VertexCode {
    /// A block with the single-precision results as roots, and its instruction slots per execution.
    Straight(StepBlock, u64),
    Flow(Box<FlowPlan>),
}

/// Key of the cache: all inputs of decoding.
#[derive(Debug)]
pub(crate) struct VertexKey {
    program: Program,
    rules: Rules,
    /// `None` if constants are inputs of the program.
    constants: Option<ResolvedConstants>,
    needed: ComponentMask,
    budget: u32,
}

pub(crate) type VertexPrograms = Cache<VertexKey, DecodedVertex>;

/// Returns a decoded program, from the cache if possible. The first constants of a program are folded into it. For
/// other constants it is decoded once more, with constants as inputs.
fn decoded(
    programs: &VertexPrograms,
    program: &Program,
    rules: &Rules,
    constants: &ResolvedConstants,
    (needed, components): (ComponentMask, &[usize]),
    budget: u32,
) -> Arc<DecodedVertex> {
    let same = |key: &VertexKey| {
        key.needed == needed && key.budget == budget && key.program == *program && key.rules == *rules
    };
    let folded = |key: &VertexKey| key.constants.as_ref() == Some(constants) && same(key);
    if let Some(code) = programs.find(folded) {
        return code;
    }
    let open = !has_flow(program) && programs.find(same).is_some();
    let matches = |key: &VertexKey| if open { key.constants.is_none() && same(key) } else { folded(key) };
    programs.get(matches, || {
        let code = if has_flow(program) {
            VertexCode::Flow(Box::new(FlowPlan::new(
                program,
                rules,
                Formats::vertex(program, rules),
                constants,
                None,
                budget,
            )))
        } else {
            straight(program, rules, constants, (open, components))
        };
        let constants = (!open).then(|| constants.clone());
        let key = VertexKey { program: program.clone(), rules: rules.clone(), constants, needed, budget };
        (key, DecodedVertex { code, slots: Pool::default() })
    })
}

impl BatchVertices {
    /// Prepares a vertex program that computes the position and the `needed` components. Returns `None` if every vertex
    /// exceeds the step budget: only the scalar executor counts the steps of programs without flow control.
    pub(crate) fn new(
        (program, constants): (&Program, &Constants),
        rules: &Rules,
        needed: ComponentMask,
        step_budget: u32,
        programs: &VertexPrograms,
        simd: SimdLevel,
    ) -> Option<Self> {
        if !has_flow(program) && straight_exceeds(program, step_budget) {
            return None;
        }
        let formats = LaneFormats::new(Formats::vertex(program, rules), simd);
        let constants = ResolvedConstants::vertex(program, rules, constants);
        let components: Vec<usize> = (0..COMPONENTS).filter(|&c| needed.has(c)).collect();
        let code = decoded(programs, program, rules, &constants, (needed, &components), step_budget);
        let color_clamp = rules.color_clamp;
        Some(Self { constants: raw_constants(&constants.float, &formats), color_clamp, code, components, formats })
    }

    /// Executes the program on `total` vertices.
    pub fn run(&self, total: usize, attributes: &AttributeRows<'_>) -> VertexRows {
        let span = |i: usize| self.span(i * SPAN, total.saturating_sub(i * SPAN).min(SPAN), attributes);
        if total <= SPAN {
            return span(0);
        }
        let parts: Vec<VertexRows> = (0..total.div_ceil(SPAN)).into_par_iter().map(span).collect();
        let mut out = VertexRows::new();
        self.each_row(&mut out, |place, to| {
            to.reserve_exact(total);
            for part in &parts {
                to.extend_from_slice(self.row(part, place));
            }
        });
        out.executed = parts.iter().map(|part| part.executed).sum();
        out.cut = parts.into_iter().flat_map(|part| part.cut).collect();
        out
    }

    /// Calls `fill` with the index of each computed row, and the row.
    fn each_row(&self, out: &mut VertexRows, mut fill: impl FnMut(usize, &mut Vec<u32>)) {
        for (i, row) in out.position.iter_mut().enumerate() {
            fill(i, row);
        }
        for (i, &component) in self.components.iter().enumerate() {
            fill(4 + i, &mut out.components[component]);
        }
    }

    /// The row with this index, numbered as in [`Self::each_row`].
    fn row<'r>(&self, rows: &'r VertexRows, number: usize) -> &'r [u32] {
        match number {
            0..4 => &rows.position[number],
            _ => &rows.components[self.components[number - 4]],
        }
    }

    /// Processes up to [`SPAN`] vertices in groups of 256.
    fn span(&self, first: usize, count: usize, attributes: &AttributeRows<'_>) -> VertexRows {
        let mut slots = self.code.slots.take(|_| true).unwrap_or_else(|| self.slots());
        let mut out = VertexRows::new();
        self.each_row(&mut out, |_, row| row.reserve_exact(count));
        for start in (0..count).step_by(LANES) {
            self.group(first + start, (count - start).min(LANES), attributes, &mut slots, &mut out);
        }
        self.code.slots.keep(slots);
        if self.color_clamp == ColorClamp::Vertex {
            out.clamp_colors();
        }
        out
    }

    fn slots(&self) -> Slots {
        match &self.code.code {
            VertexCode::Straight(block, _) => {
                let mut slots = Slots::new(block.slots);
                fill_constants(block, &mut slots);
                slots
            }
            VertexCode::Flow(plan) => {
                let mut slots = Slots::new(plan.slots());
                fill_plan(plan, &mut slots);
                slots
            }
        }
    }

    /// Processes up to 256 vertices: appends position, components and instruction slots.
    fn group(
        &self,
        first: usize,
        count: usize,
        attributes: &AttributeRows<'_>,
        slots: &mut Slots,
        out: &mut VertexRows,
    ) {
        let inputs = match &self.code.code {
            VertexCode::Straight(block, _) => &block.inputs,
            VertexCode::Flow(plan) => plan.inputs(),
        };
        for &(component, slot) in inputs {
            if let Some(constant) = component.checked_sub(CONSTANT_INPUTS) {
                let register = self.constants.get(usize::from(constant / 4));
                slots.row_mut(slot)[..count].fill(register.map_or(0, |c| c[usize::from(constant % 4)]));
                continue;
            }
            // Inputs are in single precision, so their bits are raw values.
            let row = &mut slots.row_mut(slot)[..count];
            attributes(usize::from(component / 4), usize::from(component % 4), first, row);
        }
        let around = Surroundings { formats: &self.formats, textures: &[], constants: &self.constants };
        let lanes = first_lanes(count);
        match &self.code.code {
            VertexCode::Straight(block, cost) => {
                run_steps(&block.steps, &around, &lanes, slots);
                out.executed += cost * count as u64;
                let outcome = if self.hands_on_words() { |bits: &u32| *bits } else { canonical };
                self.each_row(out, |i, row| row.extend(slots.row(block.roots[i])[..count].iter().map(outcome)));
            }
            VertexCode::Flow(plan) => {
                let mut run = FlowRun::new(plan, &around, &lanes, &lanes);
                run.run(slots, &mut [0; SAMPLERS]);
                out.executed += run.executed;
                out.cut.extend(run.cut.iter().map(|&(lane, instruction)| (first + lane, instruction)));
                let places: Vec<RegisterComponent> = outputs(&self.components).collect();
                self.each_row(out, |i, row| {
                    let place = places[i];
                    row.extend(self.held(plan.register(place.0, place.1, place.2), place, slots, count));
                });
            }
        }
    }

    /// Final contents of a register component, for a program with flow control.
    fn held(&self, slot: Option<Slot>, place: RegisterComponent, slots: &Slots, count: usize) -> Vec<u32> {
        let Some(slot) = slot else { return vec![0; count] };
        let main = self.formats.lane(Arith::Main);
        let color = place.0 == RegisterFile::DiffuseOut && self.color_clamp == ColorClamp::Program;
        let value = |&raw: &u32| self.single(if color { main.saturate(raw) } else { raw });
        slots.row(slot)[..count].iter().map(value).collect()
    }

    /// Returns `true` if a card's unit computes the program: its output words are passed on unchanged.
    fn hands_on_words(&self) -> bool {
        self.formats.format(Arith::Main).unit.is_card()
    }

    /// Contents of a slot as a single-precision pattern.
    fn single(&self, raw: u32) -> u32 {
        let (main, single) = (self.formats.lane(Arith::Main), self.formats.lane(Arith::Single));
        if self.formats.format(Arith::Main) == Format::FP32 || self.hands_on_words() {
            return main.encode(raw);
        }
        single.encode(single.round(main.reading().to_f64(raw)))
    }
}

/// Output register components of the position and of `components`, in order.
fn outputs(components: &[usize]) -> impl Iterator<Item = RegisterComponent> {
    let position = (0..4).map(|c| (RegisterFile::PositionOut, 0, c));
    position.chain(components.iter().map(|&component| match component {
        FOG_COMPONENT => (RegisterFile::FogOut, 0, 0),
        COLOR_COMPONENT.. => {
            let i = component - COLOR_COMPONENT;
            (RegisterFile::DiffuseOut, (i / 4) as u16, (i % 4) as u8)
        }
        _ => (RegisterFile::TexCoordOut, (component / 4) as u16, (component % 4) as u8),
    }))
}

/// Schedules a program without flow control as one block of its outputs; if `open`, constants are inputs.
fn straight(
    program: &Program,
    rules: &Rules,
    constants: &ResolvedConstants,
    (open, components): (bool, &[usize]),
) -> VertexCode {
    let mut t = Translator::new(program, rules, Formats::vertex(program, rules), constants, None);
    t.open_constants = open;
    translate_straight_vertex(&mut t, program);
    let slots = |i: &Instruction| u64::from(i.opcode.info().slot_cost(program.version).total());
    let cost = program.instructions.iter().map(slots).sum();
    let zero = t.make.zero();
    let roots: Vec<NodeId> = outputs(components)
        .map(|place| {
            let value = t.registers.get(&place).copied().unwrap_or(zero);
            let value = match place.0 {
                RegisterFile::DiffuseOut if rules.color_clamp == ColorClamp::Program => {
                    t.make.unary(Arith::Main, NumberOperation::Saturate, value)
                }
                _ => value,
            };
            if t.make.graph.is_card(Arith::Main) { value } else { t.make.convert(Arith::Main, Arith::Single, value) }
        })
        .collect();
    VertexCode::Straight(schedule(&t.make.graph, &roots, |_| false, &BTreeMap::new(), 0), cost)
}

/// Makes NaN canonical in a single-precision pattern.
fn canonical(bits: &u32) -> u32 {
    if bits & 0x7fff_ffff > 0x7f80_0000 { 0x7fc0_0000 } else { *bits }
}
