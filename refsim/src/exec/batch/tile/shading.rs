//! A thread's work on a tile: shades triangles. Large triangles are shaded part by part, with lanes at their pixels;
//! small ones are packed.

use refsim_lanes::LaneRow;

use super::decoded::DecodedPixel;
use super::output::{Fragment, OutputStage, Shaded};
use super::packed::packable;
use super::raster::TileFrame;
use super::round::{RoundCode, TileRound};
use super::shader::{PartMode, TileShader};
use super::store::Survivors;
use super::targets::Targets;
use crate::event::FragmentCounts;
use crate::exec::Overrun;
use crate::exec::batch::run::{FlowRun, Surroundings, run_steps};
use crate::output::DepthFormat;
use crate::texture::Region;

/// Receiver of shaded fragments.
pub(super) trait FragmentSink {
    /// The tile's depths, if this sink writes fragments immediately.
    fn stored_depths(&mut self) -> Option<&mut LaneRow>;

    /// Receives fragments that passed the tests before the depth test, or all tests if the depth test was made early.
    fn take(&mut self, shaded: Shaded<'_>, survivors: &mut Survivors, counts: &mut FragmentCounts);
}

/// Writes fragments to the targets.
pub(super) struct IntoTargets<'s, 't> {
    pub(super) output: &'s OutputStage,
    pub(super) targets: &'s mut Targets<'t>,
}

impl FragmentSink for IntoTargets<'_, '_> {
    fn stored_depths(&mut self) -> Option<&mut LaneRow> {
        self.targets.depth.as_deref_mut()
    }

    fn take(&mut self, shaded: Shaded<'_>, survivors: &mut Survivors, counts: &mut FragmentCounts) {
        self.output.merge(shaded, survivors, self.targets, counts);
    }
}

/// Collects fragments to be written later.
#[derive(Default)]
pub(super) struct KeptFragments(pub(super) Vec<Fragment>);

impl FragmentSink for KeptFragments {
    fn stored_depths(&mut self) -> Option<&mut LaneRow> {
        None
    }

    fn take(&mut self, shaded: Shaded<'_>, survivors: &mut Survivors, _: &mut FragmentCounts) {
        shaded.gather(survivors, &mut self.0);
    }
}

/// A thread's work on one tile.
pub(super) struct TileShading<'r> {
    around: Surroundings<'r>,
    output: &'r OutputStage,
    program: &'r DecodedPixel,
    round: &'r TileRound<'r>,
    region: Region,
    depth: Option<DepthFormat>,
    shader: TileShader,
    survivors: Survivors,
    mode: PartMode,
    /// The depth buffer's format, if the depth test is made before the program.
    early: Option<DepthFormat>,
}

impl<'r> TileShading<'r> {
    /// Starts shading with the buffers of `shader`, which has started the tile.
    pub(super) fn new(
        around: Surroundings<'r>,
        (output, program): (&'r OutputStage, &'r DecodedPixel),
        round: &'r TileRound<'r>,
        (region, depth): (Region, Option<DepthFormat>),
        shader: TileShader,
    ) -> Self {
        let together = match &round.code {
            RoundCode::Straight(program, _) => program.lanes_apart,
            RoundCode::Flow(_) => false,
        };
        let tested = depth.is_some() && output.state.depth.test.is_some();
        let interpolated = tested && !round.results().decide_depth();
        let mode = PartMode { together, depth: interpolated, given: round.constant };
        let early = depth.filter(|_| together && tested && output.tests_early(round.results()));
        Self { around, output, program, round, region, depth, shader, survivors: Survivors::new(), mode, early }
    }

    /// Shades triangles, in order.
    pub(super) fn shade(
        &mut self,
        order: &[u32],
        counts: &mut FragmentCounts,
        sink: &mut impl FragmentSink,
    ) -> Result<(), Overrun> {
        let surfaces = self.round.surfaces;
        let mut at = 0;
        while at < order.len() {
            let rest = &order[at..];
            let small = packable(surfaces, rest, self.region, &self.round.given);
            if small > 0 {
                self.shade_packed(&rest[..small], counts, sink)?;
                at += small;
                continue;
            }
            at += self.shader.take(surfaces, rest, self.mode).max(1);
            if self.shader.covered_count > 0 {
                self.shade_part(rest[0], counts, sink)?;
            }
        }
        Ok(())
    }

    /// Shades the part taken by the shader; `first` is its first triangle.
    fn shade_part(
        &mut self,
        first: u32,
        counts: &mut FragmentCounts,
        sink: &mut impl FragmentSink,
    ) -> Result<(), Overrun> {
        let Self { around, round, shader, output, survivors, .. } = self;
        round.count(shader.covered_count, counts);
        // The early test needs the depths of previous triangles; only the sink that writes immediately has them.
        let stored = self.early.and_then(|buffer| Some((buffer, sink.stored_depths()?)));
        let tested = stored.is_some();
        if let Some((buffer, stored)) = stored {
            output.test_part((&shader.covered, &shader.depth), (around.formats, buffer), (stored, survivors), counts);
            if survivors.count == 0 {
                return Ok(());
            }
        }
        match &round.code {
            RoundCode::Straight(_, plan) => {
                // The invariant block runs again only if its inputs have changed.
                if shader.fill_inputs(round.surfaces, &round.inputs, around.formats) {
                    round.give_fixed(&mut shader.slots);
                    run_steps(&plan.invariant.steps, around, &shader.run, &mut shader.slots);
                }
                round.give(first, &mut shader.slots);
                run_steps(&plan.varying.steps, around, &shader.run, &mut shader.slots);
            }
            RoundCode::Flow(plan) => {
                shader.forget_inputs();
                shader.fill_inputs(round.surfaces, &round.inputs, around.formats);
                let frame = shader.frame();
                let TileShader { slots, run, covered, .. } = shader;
                let mut run = FlowRun::new(plan, around, run, covered);
                run.run(slots, &mut counts.fetches);
                if let Some(overrun) = overrun(&run.cut, frame, first) {
                    return Err(overrun);
                }
            }
        }
        let shaded = Shaded {
            results: round.results(),
            formats: around.formats,
            slots: &shader.slots,
            covered: &shader.covered,
            depth: &shader.depth,
            packed: None,
            tested,
        };
        if !tested {
            output.test(shaded, self.depth, survivors, counts);
        }
        sink.take(shaded, survivors, counts);
        Ok(())
    }

    /// Packs small triangles with the same given values, and shades them.
    fn shade_packed(
        &mut self,
        order: &[u32],
        counts: &mut FragmentCounts,
        sink: &mut impl FragmentSink,
    ) -> Result<(), Overrun> {
        let (surfaces, frame) = (self.round.surfaces, self.shader.frame());
        self.shader.forget_inputs();
        self.shader.packed.clear(!self.mode.together);
        let mut covered = 0;
        for &triangle in order {
            if !self.shader.packed.has_room(surfaces, triangle, self.region) {
                self.shade_batch(order[0], false, counts, sink)?;
            }
            covered += self.shader.packed.add(surfaces, triangle, frame, self.region);
        }
        self.round.count(covered, counts);
        self.shade_batch(order[0], true, counts, sink)
    }

    /// Shades the packed fragments. If the early depth test leaves few fragments, waits for more triangles unless these
    /// were the last.
    fn shade_batch(
        &mut self,
        first: u32,
        last: bool,
        counts: &mut FragmentCounts,
        sink: &mut impl FragmentSink,
    ) -> Result<(), Overrun> {
        let Self { around, round, shader, output, survivors, .. } = self;
        let packed = &mut shader.packed;
        let stored = self.early.and_then(|buffer| Some((buffer, sink.stored_depths()?)));
        let tested = stored.is_some();
        if let Some((buffer, stored)) = stored {
            output.test_packed(packed, (around.formats, buffer), stored, counts);
        }
        // Rejected fragments have freed lanes: waits until more triangles fill them.
        if packed.is_empty() || tested && !last && !packed.is_worth_shading() {
            return Ok(());
        }
        packed.fill(round.surfaces, &round.inputs, around.formats, &mut shader.slots);
        match &round.code {
            RoundCode::Straight(_, plan) => {
                round.give_fixed(&mut shader.slots);
                run_steps(&plan.invariant.steps, around, &packed.run, &mut shader.slots);
                round.give(first, &mut shader.slots);
                run_steps(&plan.varying.steps, around, &packed.run, &mut shader.slots);
            }
            RoundCode::Flow(plan) => {
                let mut run = FlowRun::new(plan, around, &packed.run, &packed.covered);
                run.run(&mut shader.slots, &mut counts.fetches);
                if let Some(overrun) = packed.overrun(&run.cut) {
                    return Err(overrun);
                }
            }
        }
        let shaded = Shaded {
            results: round.results(),
            formats: around.formats,
            slots: &shader.slots,
            covered: &packed.covered,
            depth: &packed.depth,
            packed: Some(packed),
            tested,
        };
        output.test(shaded, self.depth.filter(|_| !tested), survivors, counts);
        sink.take(shaded, survivors, counts);
        shader.packed.clear(!self.mode.together);
        Ok(())
    }

    /// Returns the buffers to the pool.
    pub(super) fn end(self) {
        self.program.shaders.keep((self.round.constant, self.shader));
    }
}

/// The first fragment of a triangle that was stopped by the step budget; `cut` is by lane.
pub(crate) fn overrun(cut: &[(usize, usize)], frame: TileFrame, triangle: u32) -> Option<Overrun> {
    let of = |&(lane, instruction): &(usize, usize)| {
        let (x, y) = frame.pixel(lane);
        Overrun { triangle, y, x, instruction }
    };
    cut.iter().map(of).min()
}
