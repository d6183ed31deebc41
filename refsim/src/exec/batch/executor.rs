//! The batch executor, as owned by machines.

use std::sync::Arc;

use refsim_lanes::SimdLevel;

use super::run::TextureTables;
use super::tile::{BatchTiles, PixelPrograms};
use super::vertex::{BatchVertices, VertexPrograms};
use crate::device::Rules;
use crate::exec::{Constants, TileDraw};
use crate::isa::Program;
use crate::raster::ComponentMask;

/// The batch executor: caches, shared by clones, and a SIMD level.
#[derive(Clone, Debug, Default)]
pub struct BatchExecutor {
    decoded: Arc<DecodedCaches>,
    simd: Option<SimdLevel>,
}

#[derive(Debug, Default)]
struct DecodedCaches {
    pixel: PixelPrograms,
    vertex: VertexPrograms,
    textures: TextureTables,
}

impl BatchExecutor {
    /// Sets the SIMD level. `None`, the default, selects the widest level that the processor supports; an unsupported
    /// level falls back to a supported one. The level only affects the speed.
    pub fn set_simd_level(&mut self, level: Option<SimdLevel>) {
        self.simd = level;
    }

    /// The SIMD level in use.
    pub fn simd(&self) -> SimdLevel {
        self.simd.unwrap_or(SimdLevel::widest())
    }

    /// Prepares a draw. Returns `None` if only the scalar executor can run it: the program has more values than there
    /// are slots, or every fragment exceeds the step budget.
    pub fn tiles<'a>(&self, draw: &TileDraw<'a>) -> Option<BatchTiles<'a>> {
        BatchTiles::new(draw, (&self.decoded.pixel, &self.decoded.textures), self.simd())
    }

    /// Prepares a vertex program that computes the position and the `needed` components. Returns `None` if only the
    /// scalar executor can run it: every vertex exceeds the step budget.
    pub fn vertices(
        &self,
        (program, constants): (&Program, &Constants),
        rules: &Rules,
        needed: ComponentMask,
        step_budget: u32,
    ) -> Option<BatchVertices> {
        let programs = &self.decoded.vertex;
        BatchVertices::new((program, constants), rules, needed, step_budget, programs, self.simd())
    }
}
