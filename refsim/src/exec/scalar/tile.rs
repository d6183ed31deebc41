//! The reference executor for tiles: triangle by triangle, quad by quad, fragment by fragment.

use super::pixel::PixelProgram;
use crate::event::{FragmentCounts, SAMPLERS};
use crate::exec::trace::{as_written, canonical};
use crate::exec::{
    CheckedProgram, DepthValue, FragmentResult, NoObserver, Observer, Overrun, Shading, TileDraw, Trace,
    colors_written, program,
};
use crate::num::Format;
use crate::output::{FragmentFate, FragmentOutput, OutputRules, OutputState, TargetTile, merge};
use crate::raster::{FragmentInput, PixelQuad, TriangleSetup};
use crate::texture::Region;

/// Scalar tile executor of a draw.
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
            program: PixelProgram::new(draw.program, draw.rules, &draw.bindings).within(draw.step_budget),
            source: draw.program,
            written: colors_written(draw.program),
            output: draw.output,
            rules: draw.rules.into(),
        }
    }

    fn inputs(&self, triangle: &TriangleSetup, quad: &PixelQuad) -> [FragmentInput; 4] {
        [0, 1, 2, 3].map(|lane| {
            let (x, y) = quad.lane(lane);
            triangle.interpolate(x, y, self.program.inputs_read())
        })
    }

    /// Draws the part of a triangle within a region of a tile, with an observer.
    ///
    /// # Errors
    /// As [`Self::run_tile`]; the triangle is reported as 0.
    pub fn run_region<O: Observer>(
        &self,
        triangle: &TriangleSetup,
        region: Region,
        tile: &mut TargetTile,
        observer: &mut O,
    ) -> Result<FragmentCounts, Overrun> {
        let mut counts = FragmentCounts::default();
        let mut first: Option<Overrun> = None;
        for quad in triangle.quads(region) {
            // Skips quads that can only contain later overruns.
            if first.is_some_and(|known| (known.y, known.x) < (quad.y, quad.x)) {
                continue;
            }
            let overrun = self.shade(triangle, &quad, tile, &mut counts, observer);
            first = first.into_iter().chain(overrun).min();
        }
        first.map_or(Ok(counts), Err)
    }

    fn shade<O: Observer>(
        &self,
        triangle: &TriangleSetup,
        quad: &PixelQuad,
        tile: &mut TargetTile,
        counts: &mut FragmentCounts,
        observer: &mut O,
    ) -> Option<Overrun> {
        let inputs = self.inputs(triangle, quad);
        let (results, cut_at) = self.program.run(&inputs, quad.mask, &mut counts.fetches, observer);
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
        overrun(quad, &cut_at)
    }

    fn merge(&self, result: &FragmentResult, depth: u32, place: (u32, u32), tile: &mut TargetTile) -> FragmentFate {
        // A single-precision depth (texm3x2depth) is treated like the interpolated depth.
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

impl ScalarTiles<'_> {
    /// Draws the triangles `order` (indices into `triangles`, in order of submission) into a tile. Triangles that do
    /// not touch the tile are allowed. The order of triangles is preserved per pixel.
    ///
    /// Returns the fragment counts, without helper lanes.
    ///
    /// # Errors
    /// The first fragment, in the order of [`Overrun`], that exceeds the step budget. The tile's contents are then
    /// invalid.
    pub fn run_tile(
        &self,
        triangles: &[TriangleSetup],
        order: &[u32],
        tile: &mut TargetTile,
    ) -> Result<FragmentCounts, Overrun> {
        let mut counts = FragmentCounts::default();
        let region = tile.region;
        for (&number, triangle) in order.iter().filter_map(|i| Some((i, triangles.get(*i as usize)?))) {
            let drawn = self.run_region(triangle, region, tile, &mut NoObserver);
            counts += drawn.map_err(|overrun| Overrun { triangle: number, ..overrun })?;
        }
        Ok(counts)
    }
}

/// The first stopped fragment of a quad; its triangle is reported as 0.
fn overrun(quad: &PixelQuad, cut_at: &[Option<usize>; 4]) -> Option<Overrun> {
    let of = |lane: usize| {
        let instruction = cut_at[lane].filter(|_| quad.mask >> lane & 1 == 1)?;
        let (x, y) = quad.lane(lane);
        Some(Overrun { triangle: 0, y, x, instruction })
    };
    (0..4).filter_map(of).min()
}

impl ScalarTiles<'_> {
    /// Draws the fragment of a triangle into the single pixel of `tile`, which the triangle must cover, and records
    /// every step.
    ///
    /// # Errors
    /// If the fragment exceeds the step budget; its triangle is reported as 0.
    pub fn follow(&self, triangle: &TriangleSetup, tile: &mut TargetTile) -> Result<Shading, Overrun> {
        let (x, y) = (tile.region.x, tile.region.y);
        let lane = ((x & 1) | (y & 1) << 1) as usize;
        let quad = PixelQuad { x: x & !1, y: y & !1, mask: 1 << lane };
        let inputs = self.inputs(triangle, &quad);
        let mut trace = Trace::of_lane(lane);
        let (results, cut_at) = self.program.run(&inputs, quad.mask, &mut [0; SAMPLERS], &mut trace);
        if let Some(overrun) = overrun(&quad, &cut_at) {
            return Err(overrun);
        }
        let (input, output) = (inputs[lane], results[lane]);
        let source = program(self.source);
        Ok(Shading {
            delivered: self.program.delivered(&input),
            steps: trace.steps.into_iter().map(|step| as_written(step, source)).collect(),
            output,
            fate: self.merge(&output, input.depth, (x, y), tile),
            input: canonical(input),
        })
    }
}
