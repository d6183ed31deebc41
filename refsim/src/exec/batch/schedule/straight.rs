//! Pixel programs without flow control: one graph, scheduled as four blocks by frequency of evaluation.
//!
//! - Values that depend on constants only, including texels at constant coordinates: once per draw.
//! - Values that are constant over a triangle (computed from constant attributes): for 256 triangles at a time, one
//!   lane per triangle.
//! - Values that depend only on the position in the tile (varying coordinates, and texels at them): for 256 fragments,
//!   reused while triangles have the same planes there. So the Ray Engine reads its rays once per tile, not once per
//!   quad.
//! - The rest: for 256 fragments of each triangle.

use std::collections::BTreeMap;

use super::block::{ResultSlots, StepBlock, schedule};
use crate::device::Rules;
use crate::event::SAMPLERS;
use crate::exec::lower::{Detail, Ends, Formats, Graph, NodeId, NodeKind, Slot, Translator, translate_straight};
use crate::exec::{PixelBindings, ResolvedConstants};
use crate::isa::Program;
use crate::raster::ComponentMask;

#[derive(Debug)]
pub(crate) struct StraightProgram {
    graph: Graph,
    ends: Ends,
    /// Sampler of each texture read of a fragment.
    pub(crate) fetches: Vec<usize>,
    /// `true` if lanes are independent, so that lanes of different triangles can be executed together.
    pub(crate) lanes_apart: bool,
    /// Samplers that derive the level of detail from neighbouring lanes, unless the program gives it.
    detailed: [bool; SAMPLERS],
}

/// A straight-line program scheduled for triangles with certain constant components.
#[derive(Debug)]
pub(crate) struct StraightPlan {
    /// Evaluated per draw, without inputs; its roots are the uniform values given to `invariant`.
    pub(crate) fixed: StepBlock,
    /// Evaluated per 256 triangles, on constant components; its roots are the values given to `varying`.
    pub(crate) uniform: StepBlock,
    /// Evaluated per tile: depends on varying components only. Its roots keep their slots while `varying` runs; its
    /// `given` slots are in the order of `fixed.roots`.
    pub(crate) invariant: StepBlock,
    /// Evaluated per triangle and tile, in slots above the slots of `invariant`; its `given` slots are in the order of
    /// `uniform.roots`.
    pub(crate) varying: StepBlock,
    pub(crate) results: ResultSlots,
}

impl StraightProgram {
    pub(crate) fn new(
        program: &Program,
        rules: &Rules,
        formats: Formats,
        constants: &ResolvedConstants,
        bindings: &PixelBindings<'_>,
    ) -> Self {
        let mut t = Translator::new(program, rules, formats, constants, Some(bindings));
        let ends = translate_straight(&mut t, program, |_, _| {});
        let detailed = bindings.samplers.map(|s| s.is_some_and(|binding| binding.needs_detail()));
        let graph = t.make.graph;
        let lanes_apart = !graph.kinds().iter().any(|kind| looks_at_neighbours(kind, &detailed));
        Self { ends, fetches: t.fetches, lanes_apart, detailed, graph }
    }

    /// Returns `true` if there are enough slots for all values at once, the most that a plan needs.
    pub(crate) fn fits_slots(&self) -> bool {
        self.graph.len() <= usize::from(Slot::MAX)
    }

    /// Schedules the program for triangles whose components in `constant` are constant.
    pub(crate) fn plan(&self, constant: ComponentMask) -> StraightPlan {
        let across = |kind: &NodeKind| looks_at_neighbours(kind, &self.detailed);
        let uniform = self.graph.uniform(|component| constant.has(component.into()), across);
        let fixed = self.graph.uniform(|_| false, across);
        let invariant = self.invariant(constant);
        let roots = self.ends.roots();
        let live = self.graph.live(roots.iter().copied());
        // Values that the varying block, or the output, reads but does not compute.
        let is_constant = |n: NodeId| matches!(self.graph.kind(n), NodeKind::Constant(_));
        let made_before = |n: NodeId| uniform[n.0 as usize] || invariant[n.0 as usize];
        let mut wanted = vec![false; self.graph.len()];
        let mut want = |n: NodeId| wanted[n.0 as usize] |= made_before(n) && !is_constant(n);
        for node in self.nodes().filter(|&n| live[n.0 as usize] && !made_before(n)) {
            self.graph.kind(node).needs(&mut want);
        }
        roots.iter().copied().for_each(want);
        let kept: Vec<NodeId> = self.nodes().filter(|n| wanted[n.0 as usize] && !uniform[n.0 as usize]).collect();
        let given: Vec<NodeId> = self.nodes().filter(|n| wanted[n.0 as usize] && uniform[n.0 as usize]).collect();
        let mut shared = vec![false; self.graph.len()];
        let live = self.graph.live(kept.iter().copied());
        for node in self.nodes().filter(|&n| live[n.0 as usize] && !fixed[n.0 as usize]) {
            self.graph.kind(node).needs(|n| shared[n.0 as usize] |= fixed[n.0 as usize] && !is_constant(n));
        }
        let fixed: Vec<NodeId> = self.nodes().filter(|n| shared[n.0 as usize]).collect();
        let invariant = schedule(&self.graph, &kept, |n| shared[n.0 as usize], &BTreeMap::new(), 0);
        debug_assert_eq!(
            invariant.given.iter().map(|g| g.0).collect::<Vec<_>>(),
            fixed,
            "one slot for each fixed value"
        );
        let fixed = schedule(&self.graph, &fixed, |_| false, &BTreeMap::new(), 0);
        let placed = kept.into_iter().zip(invariant.roots.iter().copied()).collect();
        let varying = schedule(&self.graph, &roots, |n| wanted[n.0 as usize], &placed, invariant.slots);
        debug_assert_eq!(varying.given.iter().map(|g| g.0).collect::<Vec<_>>(), given, "one slot for each given value");
        let uniform = schedule(&self.graph, &given, |_| false, &BTreeMap::new(), 0);
        let results = self.ends.results(&varying.roots);
        StraightPlan { fixed, uniform, invariant, varying, results }
    }

    fn nodes(&self) -> impl Iterator<Item = NodeId> {
        (0..self.graph.len() as u32).map(NodeId)
    }

    /// For each node, `true` if it depends on constants and varying components only.
    fn invariant(&self, constant: ComponentMask) -> Vec<bool> {
        let mut invariant = Vec::with_capacity(self.graph.len());
        for node in self.nodes() {
            let kind = self.graph.kind(node);
            let mut all = match kind {
                NodeKind::Input(component) => !constant.has(component.into()),
                NodeKind::Held(_) | NodeKind::Relative(..) => false,
                _ => true,
            };
            kind.needs(|n| all &= invariant[n.0 as usize]);
            invariant.push(all);
        }
        invariant
    }
}

/// Returns `true` if a node computes differences across quads, directly or for a texture's level of detail.
fn looks_at_neighbours(kind: &NodeKind, detailed: &[bool; SAMPLERS]) -> bool {
    match *kind {
        NodeKind::Difference(..) => true,
        NodeKind::Fetch(sampler, _, Detail::Implicit | Detail::Biased(_)) => {
            detailed.get(usize::from(sampler)).is_some_and(|&detailed| detailed)
        }
        _ => false,
    }
}

impl Ends {
    /// Result slots, from the slots of [`Self::roots`] in order.
    pub(crate) fn results(&self, roots: &[Slot]) -> ResultSlots {
        let mut slots = roots.iter().copied();
        let mut next = || slots.next().unwrap_or_default();
        let colors = self.colors.map(|c| c.map(|c| c.map(|_| next())));
        let killed = self.killed.map(|_| next());
        let depth = self.depth.map(|(arith, _)| (arith, next(), None));
        ResultSlots { colors, killed, depth }
    }
}
