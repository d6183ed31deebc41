//! Early depth test, for programs that do not affect its outcome.

use refsim_lanes::{LANES, LaneRow};

use super::output::{OutputStage, depth_test, population};
use super::packed::PackedLanes;
use super::store::{Survivors, quantise};
use crate::event::FragmentCounts;
use crate::exec::batch::formats::LaneFormats;
use crate::exec::batch::schedule::ResultSlots;
use crate::exec::lower::{Arith, TRUE};
use crate::output::DepthFormat;

impl OutputStage {
    /// Returns `true` if the depth test does not depend on the program: the program neither kills nor writes depth, and
    /// there is no alpha test.
    pub(crate) fn tests_early(&self, results: &ResultSlots) -> bool {
        results.killed.is_none() && results.depth.is_none() && self.state.alpha.is_none()
    }

    /// Tests the depth of a tile's lanes before the program runs.
    pub(crate) fn test_part(
        &self,
        (covered, depth): (&LaneRow, &LaneRow),
        (formats, buffer): (&LaneFormats, DepthFormat),
        (stored, out): (&mut LaneRow, &mut Survivors),
        counts: &mut FragmentCounts,
    ) {
        let Some(function) = self.state.depth.test else { return };
        let simd = formats.simd();
        out.alive = *covered;
        out.count = simd.run(
            #[inline(always)]
            || population(covered),
        );
        quantise((formats, Arith::Single), buffer, self.rules.depth_rounding, depth, out);
        let (new, alive) = (&out.depth, &mut out.alive);
        simd.run(
            #[inline(always)]
            || depth_test(function, self.state.depth.write, new, alive, stored),
        );
        counts.depth_failed += self.recount(simd, out);
    }

    /// Tests the depth of packed fragments before the program runs, in order of submission.
    pub(crate) fn test_packed(
        &self,
        packed: &mut PackedLanes,
        (formats, buffer): (&LaneFormats, DepthFormat),
        stored: &mut LaneRow,
        counts: &mut FragmentCounts,
    ) {
        let Some(function) = self.state.depth.test else { return };
        let mut new = Survivors { alive: [TRUE; LANES], count: LANES as u32, depth: [0; LANES] };
        let depths = packed.untested_depths();
        quantise((formats, Arith::Single), buffer, self.rules.depth_rounding, &depths, &mut new);
        packed.retain(|at, fragment| {
            let (new, stored) = (new.depth[at], &mut stored[usize::from(fragment.tile_lane)]);
            let passes = function.holds(Some(new.cmp(stored)));
            if passes && self.state.depth.write {
                *stored = new;
            }
            counts.depth_failed += u64::from(!passes);
            passes
        });
    }
}
