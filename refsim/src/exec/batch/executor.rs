//! The batch executor as machines hold it.

use std::sync::Arc;

use super::lanes::SimdLevel;
use super::run::TextureTables;
use super::tile::{BatchTiles, BatchTracer, PixelPrograms};
use super::vertex::{BatchVertices, VertexPrograms};
use crate::device::Rules;
use crate::exec::{Constants, TileDraw};
use crate::isa::Program;
use crate::raster::ComponentMask;

/// The batch executor: what it has decoded, which its clones share, and the vector instructions that it uses.
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
    /// Chooses vector instructions: `None`, as in a new executor, for the widest that the processor has; a level that
    /// it lacks stands for what it has of it. The level changes nothing but the time that work takes.
    pub fn set_simd_level(&mut self, level: Option<SimdLevel>) {
        self.simd = level;
    }

    /// The vector instructions in use.
    pub fn simd(&self) -> SimdLevel {
        self.simd.unwrap_or(SimdLevel::widest())
    }

    /// Prepares a draw. `None` where the scalar executor has to do it: if the program has more values than there are
    /// slots, or if no fragment can end within the step budget.
    pub fn tiles<'a>(&self, draw: &TileDraw<'a>) -> Option<BatchTiles<'a>> {
        BatchTiles::new(draw, (&self.decoded.pixel, &self.decoded.textures), self.simd())
    }

    /// Prepares to follow pixels through a draw; `None` as for [`Self::tiles`].
    pub fn tracer<'a>(&self, draw: &TileDraw<'a>) -> Option<BatchTracer<'a>> {
        Some(BatchTracer::new(draw, self.tiles(draw)?, &self.decoded.textures))
    }

    /// Prepares a vertex program, which makes the position and the components that are `needed`. `None` where the
    /// scalar executor has to run it: if no vertex can end within the step budget.
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
