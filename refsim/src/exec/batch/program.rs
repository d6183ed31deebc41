//! Pixel programs without flow control: one graph, scheduled as two blocks.
//!
//! What is the same all over a triangle (attributes that are, and whatever is computed from them and constants) is
//! computed for 256 triangles at a time, a triangle a lane; the rest for 256 fragments of one triangle.

use std::collections::BTreeMap;

use super::arith::Formats;
use super::graph::{Arith, Graph, Kind, Node};
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
}

/// What a straight pixel program leaves behind.
#[derive(Debug)]
pub(crate) struct Ends {
    colors: [Option<[Node; 4]>; 4],
    killed: Option<Node>,
    depth: Option<(Arith, Node)>,
}

/// A straight program scheduled for triangles that have certain components constant.
#[derive(Debug)]
pub(crate) struct StraightPlan {
    /// For 256 triangles: inputs are constant components, roots the values that the other block is given.
    pub(crate) uniform: Block,
    /// For the fragments of a triangle; `given` slots in the order of `uniform.roots`.
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
        Self { ends, fetches: t.fetches, graph: t.make.graph }
    }

    /// Schedules the program for triangles whose components in `constant` are constant.
    pub(crate) fn plan(&self, constant: ComponentMask) -> StraightPlan {
        let uniform = self.graph.uniform(|component| constant.has(component.into()));
        let roots = self.ends.roots();
        let live = self.graph.live(roots.iter().copied());
        // Given to the varying block: uniform values that something varying, or the output, reads.
        let is_constant = |n: Node| matches!(self.graph.kind(n), Kind::Constant(_));
        let mut wanted = vec![false; self.graph.len()];
        for i in 0..self.graph.len() as u32 {
            let node = Node(i);
            if live[i as usize] && !uniform[i as usize] {
                self.graph.kind(node).needs(|n| wanted[n.0 as usize] |= uniform[n.0 as usize] && !is_constant(n));
            }
        }
        for &root in &roots {
            wanted[root.0 as usize] |= uniform[root.0 as usize] && !is_constant(root);
        }
        let given: Vec<Node> = (0..self.graph.len() as u32).map(Node).filter(|n| wanted[n.0 as usize]).collect();
        let varying = schedule(&self.graph, &roots, |n| wanted[n.0 as usize], &BTreeMap::new(), 0);
        debug_assert_eq!(varying.given.iter().map(|g| g.0).collect::<Vec<_>>(), given, "one slot for each given value");
        let uniform = schedule(&self.graph, &given, |_| false, &BTreeMap::new(), 0);
        let results = self.ends.results(&varying.roots);
        StraightPlan { uniform, varying, results }
    }
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
