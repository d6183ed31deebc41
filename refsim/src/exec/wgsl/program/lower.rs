//! Lowering of programs for GPUs: the graph shared with the batch executor, and the uses of its values.

use super::error::ProgramError;
use crate::device::Rules;
use crate::exec::lower::{Arith, Effect, Formats, Graph, NodeId, Translator, has_flow, translate_straight};
use crate::exec::trace::{makes_step, written_mask};
use crate::exec::usage::registers_delivered;
use crate::exec::{CheckedProgram, PixelBindings, ResolvedConstants};
use crate::isa::{Mask, Program};

/// What the values of a sink are used for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SinkKind {
    /// Output of a colour component: target, component.
    Color(u16, u16),
    /// Output of the mask of killed lanes.
    Killed,
    /// Output of depth.
    Depth(Arith),
    /// Trace record of an instruction: its index, and the components of its values.
    Trace(usize, Mask),
}

/// A use and its values.
#[derive(Clone, Debug)]
pub(super) struct Sink {
    pub(super) what: SinkKind,
    pub(super) nodes: Vec<NodeId>,
}

impl Sink {
    fn new(what: SinkKind, nodes: impl Into<Vec<NodeId>>) -> Self {
        Self { what, nodes: nodes.into() }
    }
}

/// A pixel program as values and their uses, ready to be encoded.
#[derive(Clone, Debug)]
pub struct PixelShader {
    pub(super) graph: Graph,
    pub(super) formats: Formats,
    pub(super) sinks: Vec<Sink>,
    /// The sampler of each texture read.
    pub(super) fetches: Vec<usize>,
}

/// Returns `true` if shaders can run a pixel program: it has no flow control, and no vertex unit of a card computes it.
pub fn supports(program: &CheckedProgram, rules: &Rules) -> bool {
    !has_flow(program) && !Formats::pixel(program, rules).has_vertex_unit()
}

impl PixelShader {
    /// Prepares a pixel program to run under `rules` with `bindings`. If `traced`, the results of every instruction are
    /// recorded ([`crate::exec::wgsl::follow`]).
    ///
    /// # Errors
    /// [`ProgramError::Unsupported`] unless [`supports`].
    pub fn new(
        program: &CheckedProgram,
        rules: &Rules,
        bindings: &PixelBindings<'_>,
        traced: bool,
    ) -> Result<Self, ProgramError> {
        if !supports(program, rules) {
            return Err(ProgramError::Unsupported);
        }
        let constants = ResolvedConstants::pixel(program, rules, bindings.constants);
        let mut t = Translator::new(program, rules, Formats::pixel(program, rules), &constants, Some(bindings));
        let mut taps = if traced { delivered_sinks(&mut t, program) } else { Vec::new() };
        let ends = translate_straight(&mut t, program, |at, effects| {
            let Some(instruction) = program.instructions.get(at).filter(|i| traced && makes_step(i)) else { return };
            let values = effects.iter().filter_map(|effect| match effect {
                Effect::Write((_, _, component), value, _) => Some((*component, *value)),
                _ => None,
            });
            let (components, nodes): (Vec<u8>, Vec<NodeId>) = values.unzip();
            taps.push(Sink::new(SinkKind::Trace(at, written_mask(instruction, components.into_iter())), nodes));
        });
        let mut sinks = Vec::new();
        for (target, color) in (0u16..).zip(&ends.colors) {
            for (component, &node) in (0u16..).zip(color.iter().flatten()) {
                sinks.push(Sink::new(SinkKind::Color(target, component), [node]));
            }
        }
        sinks.extend(ends.killed.map(|mask| Sink::new(SinkKind::Killed, [mask])));
        sinks.extend(ends.depth.map(|(arith, value)| Sink::new(SinkKind::Depth(arith), [value])));
        sinks.append(&mut taps);
        let fetches = std::mem::take(&mut t.fetches);
        Ok(Self { graph: t.make.graph, formats: t.make.formats, sinks, fetches })
    }
}

/// Trace records of the input registers, before the program; numbered after the instructions.
fn delivered_sinks(t: &mut Translator<'_>, program: &Program) -> Vec<Sink> {
    let numbers = program.instructions.len()..;
    let sink = |(at, register)| {
        let nodes = [0, 1, 2, 3].map(|c| t.held(&register, c));
        Sink::new(SinkKind::Trace(at, Mask::ALL), nodes)
    };
    numbers.zip(registers_delivered(program)).map(sink).collect()
}
