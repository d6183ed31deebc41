//! The reference executor on a tile: triangle by triangle, quad by quad, fragment by fragment.

use super::pixel::{DepthValue, FragmentResult, PixelProgram};
use crate::event::{FragmentCounts, SAMPLERS};
use crate::exec::trace::{as_written, canonical};
use crate::exec::{
    CheckedProgram, NoObserver, Observer, PixelTracer, Shading, TileDraw, TileExecutor, Trace, colors_written, program,
};
use crate::num::Format;
use crate::output::{FragmentFate, FragmentOutput, OutputRules, OutputState, TargetTile, merge};
use crate::raster::{FragmentInput, PixelQuad, TriangleSetup};
use crate::texture::Region;

/// The scalar tile executor of one draw.
pub struct ScalarTiles<'a> {
    program: PixelProgram<'a>,
    source: &'a CheckedProgram,
    written: u8,
    output: OutputState,
    rules: OutputRules,
}

impl<'a> ScalarTiles<'a> {
    /// Prepares a draw.
    pub fn new(draw: &TileDraw<'a>) -> Self {
        Self {
            program: PixelProgram::new(draw.program, draw.rules, &draw.bindings),
            source: draw.program,
            written: colors_written(draw.program),
            output: draw.output,
            rules: draw.output_rules(),
        }
    }

    fn inputs(&self, triangle: &TriangleSetup, quad: &PixelQuad) -> [FragmentInput; 4] {
        [0, 1, 2, 3].map(|lane| {
            let (x, y) = quad.lane(lane);
            triangle.interpolate(x, y, self.program.inputs_read())
        })
    }

    /// Draws the part of one triangle that lies in a region of a tile, with an observer.
    pub fn run_region<O: Observer>(
        &self,
        triangle: &TriangleSetup,
        region: Region,
        tile: &mut TargetTile,
        observer: &mut O,
    ) -> FragmentCounts {
        let mut counts = FragmentCounts::default();
        for quad in triangle.quads(region) {
            self.shade(triangle, &quad, tile, &mut counts, observer);
        }
        counts
    }

    fn shade<O: Observer>(
        &self,
        triangle: &TriangleSetup,
        quad: &PixelQuad,
        tile: &mut TargetTile,
        counts: &mut FragmentCounts,
        observer: &mut O,
    ) {
        let inputs = self.inputs(triangle, quad);
        let results = self.program.run_observed(&inputs, quad.mask, &mut counts.fetches, observer);
        for (lane, (result, input)) in results.iter().zip(&inputs).enumerate() {
            if quad.mask >> lane & 1 == 1 {
                counts.generated += 1;
                counts.shaded += 1;
                let fate = self.merge(result, input.depth, quad.lane(lane), tile);
                match fate {
                    FragmentFate::KilledByShader => counts.killed += 1,
                    FragmentFate::AlphaFailed => counts.alpha_failed += 1,
                    FragmentFate::DepthFailed => counts.depth_failed += 1,
                    FragmentFate::Passed => counts.passed += 1,
                    FragmentFate::OutsideTile => {}
                }
            }
        }
    }

    fn merge(&self, result: &FragmentResult, depth: u32, place: (u32, u32), tile: &mut TargetTile) -> FragmentFate {
        // A depth that is single precision already (texm3x2depth) goes the way of the interpolated one.
        let (own, depth) = match result.depth {
            Some(DepthValue { format, bits }) if format == self.rules.format => (Some(bits), depth),
            Some(DepthValue { format: Format::FP32, bits }) => (None, bits),
            _ => (None, depth),
        };
        let fragment =
            FragmentOutput { colors: result.colors, written: self.written, depth: own, killed: result.killed };
        merge(tile, place, &fragment, depth, &self.output, &self.rules)
    }
}

impl TileExecutor for ScalarTiles<'_> {
    fn run_tile(&self, triangles: &[TriangleSetup], order: &[u32], tile: &mut TargetTile) -> FragmentCounts {
        let mut counts = FragmentCounts::default();
        let region = tile.region;
        for triangle in order.iter().filter_map(|&i| triangles.get(i as usize)) {
            counts += self.run_region(triangle, region, tile, &mut NoObserver);
        }
        counts
    }
}

impl PixelTracer for ScalarTiles<'_> {
    fn follow(&self, triangle: &TriangleSetup, tile: &mut TargetTile) -> Shading {
        let (x, y) = (tile.region.x, tile.region.y);
        let lane = ((x & 1) | (y & 1) << 1) as usize;
        let quad = PixelQuad { x: x & !1, y: y & !1, mask: 1 << lane };
        let inputs = self.inputs(triangle, &quad);
        let mut trace = Trace::of_lane(lane);
        let results = self.program.run_observed(&inputs, quad.mask, &mut [0; SAMPLERS], &mut trace);
        let (input, output) = (inputs[lane], results[lane]);
        let source = program(self.source);
        Shading {
            delivered: self.program.delivered(&input),
            steps: trace.steps.into_iter().map(|step| as_written(step, source)).collect(),
            output,
            fate: self.merge(&output, input.depth, (x, y), tile),
            input: canonical(input),
        }
    }
}
