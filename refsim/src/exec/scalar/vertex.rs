//! Execution of vertex programs, one vertex at a time.

use super::interpreter::Interpreter;
use super::prepared::Prepared;
use crate::device::{ColorClamp, Rules};
use crate::exec::{CheckedProgram, Constants, Observer};
use crate::num::{Format, ops};
use crate::raster::Vertex;

/// A vertex program prepared for a draw.
pub struct VertexProgram<'a> {
    prepared: Prepared<'a>,
}

/// Result of a vertex program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VertexResult {
    /// The vertex, in single precision. Unwritten outputs are zero. Colours are clamped to [0, 1] here, as Direct3D
    /// specifies, unless the rules clamp them at the pixel.
    pub vertex: Vertex,
    /// Instruction slots executed (a matrix product counts its rows).
    pub slots: u64,
}

impl<'a> VertexProgram<'a> {
    /// Prepares a vertex program to run under `rules`, without a step budget.
    pub fn new(program: &'a CheckedProgram, rules: &'a Rules, constants: &Constants) -> Self {
        Self { prepared: Prepared::vertex(program, rules, constants) }
    }

    pub(crate) fn within(mut self, budget: u32) -> Self {
        self.prepared.set_budget(budget);
        self
    }

    /// Executes the program on the attributes `v0` to `v15`, single-precision patterns; the observer sees the vertex as
    /// lane 0. Also returns the instruction before which the step budget stopped the vertex, if it did.
    pub fn run<O: Observer>(&self, attributes: &[[u32; 4]; 16], observer: &mut O) -> (VertexResult, Option<usize>) {
        let format = self.prepared.format;
        let mut run = Interpreter::new(&self.prepared, 0b0001, observer);
        run.lanes[0].input = attributes.map(|v| v.map(|x| ops::convert(&Format::FP32, format, x).bits));
        run.run();
        // Units of cards copy words unchanged: a moved NaN keeps its sign (docs/measured.md).
        let out = |x: u32| if format.unit.is_card() { x } else { ops::convert(&format, Format::FP32, x).bits };
        let registers = &run.lanes[0];
        let clamp = self.prepared.rules.color_clamp;
        let color = |x: u32| match clamp {
            ColorClamp::Program => out(ops::saturate01(format, x).bits),
            ColorClamp::Vertex | ColorClamp::Pixel => out(x),
        };
        let mut vertex = Vertex {
            position: registers.position.map(out),
            colors: registers.diffuse.map(|c| c.map(color)),
            texcoords: registers.texcoord.map(|t| t.map(out)),
            fog: out(registers.fog[0]),
            point_size: out(registers.point_size[0]),
        };
        if clamp == ColorClamp::Vertex {
            vertex.clamp_colors();
        }
        (VertexResult { vertex, slots: run.slots }, run.cut_at[0])
    }
}
