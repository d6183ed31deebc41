//! Pixel programs without flow control: one graph, scheduled as three blocks.
//!
//! What is the same all over a triangle (attributes that are, and whatever is computed from them and constants) is
//! computed for 256 triangles at a time, a triangle a lane. What depends on nothing of that kind, only on the place in the
//! tile (coordinates that vary, texels read at them), is computed for 256 fragments, and kept for as long as triangles
//! have the same planes there: the crossbar reads its rays once a tile, not once a quad. The rest is computed for 256
//! fragments of each triangle.

use std::collections::BTreeMap;

use super::arith::Formats;
use super::graph::{Arith, Detail, Graph, Kind, Node};
use super::ops::Code;
use super::output::Results;
use super::schedule::{Block, schedule};
use super::slots::Slot;
use super::translate::{Effect, Translator};
use crate::device::Rules;
use crate::exec::{PixelBindings, ResolvedConstants};
use crate::isa::{Instruction, Opcode, OpcodeClass, Program, RegisterFile};
use crate::num::Format;
use crate::raster::ComponentMask;

/// A straight pixel program as a graph with named results.
#[derive(Debug)]
pub(crate) struct StraightProgram {
    graph: Graph,
    ends: Ends,
    /// Texture reads by sampler, one for each read of a fragment.
    pub(crate) fetches: Vec<usize>,
    /// Whether no lane's result depends on another lane, so that lanes of different triangles can be run together.
    pub(crate) lanes_apart: bool,
}

/// What a straight pixel program leaves behind.
#[derive(Debug)]
pub(crate) struct Ends {
    pub(crate) colors: [Option<[Node; 4]>; 4],
    pub(crate) killed: Option<Node>,
    pub(crate) depth: Option<(Arith, Node)>,
}

/// A straight program scheduled for triangles that have certain components constant.
#[derive(Debug)]
pub(crate) struct StraightPlan {
    /// For 256 triangles: inputs are constant components, roots the values that the other block is given.
    pub(crate) uniform: Block,
    /// For the fragments of a tile: what depends on components that vary, and on no other. Its roots stay where they are
    /// while `varying` runs.
    pub(crate) invariant: Block,
    /// For the fragments of a triangle, in slots above those of `invariant`; `given` slots in the order of `uniform.roots`.
    pub(crate) varying: Block,
    pub(crate) results: Results,
}

/// Whether a program needs lane masks and registers that are kept.
pub(crate) fn has_flow(program: &Program) -> bool {
    program
        .instructions
        .iter()
        .any(|i| i.opcode.info().class == OpcodeClass::Flow || i.predicate.is_some() || i.opcode == Opcode::Setp)
}

impl StraightProgram {
    /// Decodes a program.
    pub(crate) fn new(
        program: &Program,
        rules: &Rules,
        formats: &Formats,
        constants: &ResolvedConstants,
        bindings: &PixelBindings<'_>,
    ) -> Self {
        let mut t = Translator::new(program, rules, formats.clone(), constants, Some(bindings));
        let ends = decode(&mut t, program, |_, _| {});
        let lanes_apart = !looks_at_neighbours(&t.make.graph, bindings);
        Self { ends, fetches: t.fetches, lanes_apart, graph: t.make.graph }
    }

    /// Whether slots have numbers for all values at once: a plan may keep every one.
    pub(crate) fn fits_slots(&self) -> bool {
        self.graph.len() <= usize::from(Slot::MAX)
    }

    /// Schedules the program for triangles whose components in `constant` are constant.
    pub(crate) fn plan(&self, constant: ComponentMask) -> StraightPlan {
        let uniform = self.graph.uniform(|component| constant.has(component.into()));
        let invariant = self.invariant(constant);
        let roots = self.ends.roots();
        let live = self.graph.live(roots.iter().copied());
        // Values that the varying block, or the output, reads and does not make itself.
        let is_constant = |n: Node| matches!(self.graph.kind(n), Kind::Constant(_));
        let made_before = |n: Node| uniform[n.0 as usize] || invariant[n.0 as usize];
        let mut wanted = vec![false; self.graph.len()];
        let mut want = |n: Node| wanted[n.0 as usize] |= made_before(n) && !is_constant(n);
        for node in self.nodes().filter(|&n| live[n.0 as usize] && !made_before(n)) {
            self.graph.kind(node).needs(&mut want);
        }
        roots.iter().copied().for_each(want);
        let kept: Vec<Node> = self.nodes().filter(|n| wanted[n.0 as usize] && !uniform[n.0 as usize]).collect();
        let given: Vec<Node> = self.nodes().filter(|n| wanted[n.0 as usize] && uniform[n.0 as usize]).collect();
        let invariant = schedule(&self.graph, &kept, |_| false, &BTreeMap::new(), 0);
        let placed = kept.into_iter().zip(invariant.roots.iter().copied()).collect();
        let varying = schedule(&self.graph, &roots, |n| wanted[n.0 as usize], &placed, invariant.slots);
        debug_assert_eq!(varying.given.iter().map(|g| g.0).collect::<Vec<_>>(), given, "one slot for each given value");
        let uniform = schedule(&self.graph, &given, |_| false, &BTreeMap::new(), 0);
        let results = self.ends.results(&varying.roots);
        StraightPlan { uniform, invariant, varying, results }
    }

    fn nodes(&self) -> impl Iterator<Item = Node> {
        (0..self.graph.len() as u32).map(Node)
    }

    /// For each node whether it depends on constants and on components that vary, alone.
    fn invariant(&self, constant: ComponentMask) -> Vec<bool> {
        let mut invariant = Vec::with_capacity(self.graph.len());
        for node in self.nodes() {
            let kind = self.graph.kind(node);
            let mut all = match kind {
                Kind::Input(component) => !constant.has(component.into()),
                Kind::Held(_) | Kind::Relative(..) => false,
                _ => true,
            };
            kind.needs(|n| all &= invariant[n.0 as usize]);
            invariant.push(all);
        }
        invariant
    }
}

/// Whether a program takes differences across quads, for itself or to choose a texture's level of detail.
fn looks_at_neighbours(graph: &Graph, bindings: &PixelBindings<'_>) -> bool {
    (0..graph.len() as u32).any(|i| match graph.kind(Node(i)) {
        Kind::Compute(_, Code::DifferenceX | Code::DifferenceY, _) => true,
        Kind::Fetch(sampler, _, Detail::Implicit | Detail::Biased(_)) => {
            let binding = bindings.samplers.get(usize::from(sampler)).and_then(Option::as_ref);
            binding.is_some_and(|b| b.needs_detail())
        }
        _ => false,
    })
}

impl Ends {
    /// The values to compute.
    pub(crate) fn roots(&self) -> Vec<Node> {
        self.colors.iter().flatten().flatten().copied().chain(self.killed).chain(self.depth.map(|d| d.1)).collect()
    }

    /// Where they lie, given the slots of [`Self::roots`] in their order.
    pub(crate) fn results(&self, roots: &[Slot]) -> Results {
        let mut slots = roots.iter().copied();
        let mut next = || slots.next().unwrap_or_default();
        let colors = self.colors.map(|c| c.map(|c| c.map(|_| next())));
        let killed = self.killed.map(|_| next());
        let depth = self.depth.map(|(arith, _)| (arith, next(), None));
        Results { colors, killed, depth }
    }
}

/// Translates a straight pixel program; `visit` sees what each instruction does.
pub(crate) fn decode(t: &mut Translator<'_>, program: &Program, mut visit: impl FnMut(usize, &[Effect])) -> Ends {
    let mut killed: Option<Node> = None;
    let mut depth: Option<(Arith, Node)> = None;
    let mut at = 0;
    while let Some(instruction) = program.instructions.get(at) {
        let pair = program.instructions.get(at + 1).filter(|i| i.coissue && is_arithmetic(instruction));
        let mut effects = Vec::new();
        one(t, instruction, &mut effects);
        visit(at, &effects);
        if let Some(partner) = pair {
            // Both read what stood before the pair.
            let first = effects.len();
            one(t, partner, &mut effects);
            visit(at + 1, effects.get(first..).unwrap_or_default());
        }
        at += if pair.is_some() { 2 } else { 1 };
        for effect in effects {
            match effect {
                Effect::Write(place, value, _) => {
                    t.registers.insert(place, value);
                }
                Effect::Kill(mask) => {
                    killed = Some(killed.map_or(mask, |k| t.make.binary(Arith::Single, Code::Or, k, mask)));
                }
                Effect::Depth(arith, value) => depth = Some((arith, value)),
            }
        }
    }
    let colors = final_colors(t, program);
    let own = t.registers.get(&(RegisterFile::DepthOut, 0, 0)).map(|&n| (Arith::Main, n));
    Ends { colors, killed, depth: depth.or(own) }
}

fn is_arithmetic(instruction: &Instruction) -> bool {
    instruction.opcode.info().class == OpcodeClass::Arithmetic
}

/// The effects of one instruction.
pub(crate) fn one(t: &mut Translator<'_>, instruction: &Instruction, effects: &mut Vec<Effect>) {
    if t.program.version.is_fragment_program() {
        return t.fragment(instruction, effects);
    }
    match instruction.opcode.info().class {
        OpcodeClass::Arithmetic => t.arithmetic(instruction, effects),
        OpcodeClass::Texture => t.texture(instruction, effects),
        OpcodeClass::Marker if instruction.opcode == Opcode::Phase => {
            // Alpha is lost: zero.
            t.registers.retain(|&(file, _, component), _| file != RegisterFile::Temp || component != 3);
        }
        OpcodeClass::Marker | OpcodeClass::Flow => {}
    }
}

/// What the colours hold at the end.
fn final_colors(t: &mut Translator<'_>, program: &Program) -> [Option<[Node; 4]>; 4] {
    let zero = t.make.zero();
    let mut colors = [None; 4];
    if program.version.is_ps_1_x() {
        colors[0] = Some(std::array::from_fn(|c| {
            let value = t.registers.get(&(RegisterFile::Temp, 0, c as u8)).copied().unwrap_or(zero);
            t.make.unary(Arith::Main, Code::Saturate, value)
        }));
        return colors;
    }
    if program.version.is_fragment_program() {
        let half = |i: &Instruction| i.destination.is_some_and(|d| d.register.file == RegisterFile::HalfColorOut);
        colors[0] = Some(t.fragment_color(program.instructions.iter().any(half)));
        return colors;
    }
    let written = crate::exec::colors_written(program);
    for (i, slot) in colors.iter_mut().enumerate() {
        // Colour 0 is needed for the alpha test even if the program doesn't write it.
        if i == 0 || written >> i & 1 == 1 {
            *slot = Some(std::array::from_fn(|c| {
                t.registers.get(&(RegisterFile::ColorOut, i as u16, c as u8)).copied().unwrap_or(zero)
            }));
        }
    }
    colors
}

/// The formats of a pixel program under some rules.
pub(crate) fn pixel_formats(rules: &Rules) -> Option<Formats> {
    Formats::new(rules.format, rules.partial)
}

/// The formats of a vertex program under some rules.
pub(crate) fn vertex_formats(format: Format) -> Option<Formats> {
    Formats::new(format, None)
}
