//! The reference executor on a tile: triangle by triangle, quad by quad, fragment by fragment.

use super::pixel::{DepthValue, FragmentResult, PixelProgram};
use crate::event::FragmentCounts;
use crate::exec::{TileDraw, TileExecutor, colors_written};
use crate::num::Format;
use crate::output::{FragmentFate, FragmentOutput, OutputRules, OutputState, TargetTile, merge};
use crate::raster::{FragmentInput, PixelQuad, TriangleSetup};

/// The scalar tile executor of one draw.
pub struct ScalarTiles<'a> {
    program: PixelProgram<'a>,
    written: u8,
    output: OutputState,
    rules: OutputRules,
}

impl<'a> ScalarTiles<'a> {
    /// Prepares a draw.
    pub fn new(draw: &TileDraw<'a>) -> Self {
        Self {
            program: PixelProgram::new(draw.program, draw.rules, &draw.bindings),
            written: colors_written(draw.program),
            output: draw.output,
            rules: draw.output_rules(),
        }
    }

    fn shade(&self, triangle: &TriangleSetup, quad: &PixelQuad, tile: &mut TargetTile, counts: &mut FragmentCounts) {
        let mut inputs = [FragmentInput::default(); 4];
        for (lane, input) in inputs.iter_mut().enumerate() {
            let (x, y) = quad.lane(lane);
            *input = triangle.interpolate(x, y, self.program.inputs_read());
        }
        let results = self.program.run(&inputs, quad.mask, &mut counts.fetches);
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
            for quad in triangle.quads(region) {
                self.shade(triangle, &quad, tile, &mut counts);
            }
        }
        counts
    }
}
