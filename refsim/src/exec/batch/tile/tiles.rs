//! The batch executor for tiles: shades all 256 fragments of a part at once.

use std::sync::{Arc, Mutex, PoisonError};

use refsim_lanes::SimdLevel;

use super::decoded::{DecodedPixel, PixelCode, PixelPrograms, decoded};
use super::output::{Fragment, OutputStage};
use super::pieces::Pieces;
use super::round::{RoundCode, TileRound};
use super::shader::TileShader;
use super::shading::{IntoTargets, KeptFragments, TileShading};
use super::targets::Targets;
use crate::event::FragmentCounts;
use crate::exec::batch::formats::LaneFormats;
use crate::exec::batch::run::{BatchTexture, Surroundings, TextureTables, fill_constants, fill_plan, raw_constants};
use crate::exec::batch::vertex::Surfaces;
use crate::exec::budget::straight_exceeds;
use crate::exec::lower::{Arith, Formats, has_flow};
use crate::exec::{Overrun, ResolvedConstants, TileDraw, colors_written, inputs_read};
use crate::output::{DepthFormat, TargetTile};
use crate::raster::ComponentMask;
use crate::texture::{Region, SampleRules};

/// Batch tile executor of one draw.
#[derive(Debug)]
pub struct BatchTiles<'a> {
    formats: LaneFormats,
    textures: Vec<Option<BatchTexture<'a>>>,
    constants: Vec<[u32; 4]>,
    output: OutputStage,
    inputs: ComponentMask,
    program: Arc<DecodedPixel>,
}

impl<'a> BatchTiles<'a> {
    /// Prepares a draw: decodes the program and the textures, or takes them from the caches. Returns `None` if the
    /// program has more values than there are slots, or if every fragment exceeds the step budget: only the scalar
    /// executor counts the steps of programs without flow control.
    pub(crate) fn new(
        draw: &TileDraw<'a>,
        (programs, tables): (&PixelPrograms, &TextureTables),
        simd: SimdLevel,
    ) -> Option<Self> {
        let program = crate::exec::program(draw.program);
        if !has_flow(program) && straight_exceeds(program, draw.step_budget) {
            return None;
        }
        let formats = LaneFormats::new(Formats::pixel(program, draw.rules), simd);
        let constants = ResolvedConstants::pixel(program, draw.rules, draw.bindings.constants);
        let rules = SampleRules::from(draw.rules);
        let code = decoded(programs, program, draw, &constants);
        if matches!(&code.code, PixelCode::Straight(straight, _) if !straight.fits_slots()) {
            return None;
        }
        let main = formats.lane(Arith::Main);
        let textures = draw
            .bindings
            .samplers
            .iter()
            .map(|s| s.map(|binding| BatchTexture::new(binding, rules, main, tables)))
            .collect();
        Some(Self {
            textures,
            constants: raw_constants(&constants.float, &formats),
            output: OutputStage { state: draw.output, rules: draw.rules.into(), written: colors_written(program) },
            inputs: inputs_read(program),
            program: code,
            formats,
        })
    }

    /// The SIMD level in use.
    pub fn simd(&self) -> SimdLevel {
        self.formats.simd()
    }

    /// Components that the program can read.
    pub fn inputs(&self) -> ComponentMask {
        self.inputs
    }

    /// Returns `true` if the program never reads neighbouring fragments, so that a tile may have a single row.
    pub fn fragments_apart(&self) -> bool {
        match &self.program.code {
            PixelCode::Straight(program, _) => program.lanes_apart,
            PixelCode::Flow(_) => false,
        }
    }

    fn around(&self) -> Surroundings<'_> {
        Surroundings { formats: &self.formats, textures: &self.textures, constants: &self.constants }
    }

    /// Prepares a round of triangles.
    pub fn round<'s>(&'s self, surfaces: &'s Surfaces) -> TileRound<'s> {
        TileRound::new(&self.program, surfaces, self.inputs, &self.around())
    }

    /// Draws the triangles `order` of a round, in order of submission, into a tile. The order is preserved per pixel.
    /// Up to `workers` threads shade in parallel, which only affects the speed.
    ///
    /// Returns the fragment counts, without helper lanes.
    ///
    /// # Errors
    /// The first fragment, in the order of [`Overrun`], that exceeds the step budget. The tile's contents are then
    /// invalid.
    pub fn draw(
        &self,
        round: &TileRound<'_>,
        order: &[u32],
        tile: &mut TargetTile,
        workers: usize,
    ) -> Result<FragmentCounts, Overrun> {
        let region = tile.region;
        let depth = tile.depth.as_ref().map(|buffer| buffer.format);
        let mut targets = Targets::load(tile, self.output.written, &self.output.state, &self.output.rules);
        let mut counts = FragmentCounts::default();
        let others = Mutex::new(Vec::new());
        // Fragments shaded by other threads are collected until it is their turn; this pays off if most are rejected.
        let few_left = round.results().killed.is_some() || self.output.state.alpha.is_some();
        let workers = if few_left { Pieces::workers(order, workers) } else { 1 };
        let pieces = Pieces::new(order, workers);
        rayon::in_place_scope(|scope| {
            for _ in 1..workers {
                scope.spawn(|_| self.shade_behind(round, (region, depth), &pieces, &others));
            }
            let mut shading = self.shading(round, (region, depth));
            while let Some((_, piece)) = pieces.first() {
                shading.shade(piece, &mut counts, &mut IntoTargets { output: &self.output, targets: &mut targets })?;
            }
            shading.end();
            Ok(())
        })?;
        let mut others = others.into_inner().unwrap_or_else(PoisonError::into_inner);
        // Merges the fragments shaded by other threads, in order of submission.
        others.sort_unstable_by_key(|behind: &Behind| behind.piece);
        for behind in others {
            counts += behind.counts?;
            for fragment in &behind.fragments {
                self.output.merge_one(fragment, false, &self.formats, &mut targets, &mut counts);
            }
        }
        targets.store();
        Ok(counts)
    }

    /// Shades pieces from the back until all are taken.
    fn shade_behind(
        &self,
        round: &TileRound<'_>,
        tile: (Region, Option<DepthFormat>),
        pieces: &Pieces<'_>,
        out: &Mutex<Vec<Behind>>,
    ) {
        let mut shading = None;
        while let Some((piece, order)) = pieces.last() {
            let shading = shading.get_or_insert_with(|| self.shading(round, tile));
            let (mut counts, mut gathered) = (FragmentCounts::default(), KeptFragments::default());
            let done = shading.shade(order, &mut counts, &mut gathered);
            let behind = Behind { piece, fragments: gathered.0, counts: done.map(|()| counts) };
            out.lock().unwrap_or_else(PoisonError::into_inner).push(behind);
        }
        shading.into_iter().for_each(TileShading::end);
    }

    fn shading<'r>(
        &'r self,
        round: &'r TileRound<'r>,
        (region, depth): (Region, Option<DepthFormat>),
    ) -> TileShading<'r> {
        let mut shader = self.shader(round);
        shader.start(region);
        TileShading::new(self.around(), (&self.output, &self.program), round, (region, depth), shader)
    }

    /// Buffers for a plan, from the pool or new.
    fn shader(&self, round: &TileRound<'_>) -> TileShader {
        let fit = |(constant, shader): &(u64, TileShader)| {
            *constant == round.constant && shader.simd() == self.formats.simd()
        };
        if let Some((_, shader)) = self.program.shaders.take(fit) {
            return shader;
        }
        match &round.code {
            RoundCode::Flow(plan) => {
                let mut shader = TileShader::new(plan.slots(), self.formats.simd());
                fill_plan(plan, &mut shader.slots);
                shader
            }
            RoundCode::Straight(_, plan) => {
                let mut shader = TileShader::new(plan.varying.slots.max(plan.invariant.slots), self.formats.simd());
                fill_constants(&plan.invariant, &mut shader.slots);
                fill_constants(&plan.varying, &mut shader.slots);
                shader
            }
        }
    }
}

/// Fragments of a piece that was shaded before its turn.
struct Behind {
    piece: usize,
    fragments: Vec<Fragment>,
    counts: Result<FragmentCounts, Overrun>,
}
