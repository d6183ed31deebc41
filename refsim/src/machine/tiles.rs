//! The tile executor of a draw, and its input.

use super::memory::Memory;
use super::{BoundTexture, DrawCall, ExecutorKind};
use crate::device::Profile;
use crate::exec::batch::{BatchExecutor, BatchTiles};
use crate::exec::scalar::ScalarTiles;
use crate::exec::{PixelBindings, SamplerBinding, TileDraw};
use crate::isa::Stage;

pub(super) enum Tiles<'a> {
    Scalar(Box<ScalarTiles<'a>>),
    Batch(Box<BatchTiles<'a>>),
}

pub(super) fn executor<'a>((kind, batch): (ExecutorKind, &BatchExecutor), draw: &TileDraw<'a>) -> Tiles<'a> {
    match kind {
        ExecutorKind::Scalar => Tiles::Scalar(Box::new(ScalarTiles::new(draw))),
        ExecutorKind::Batch => match batch.tiles(draw) {
            Some(tiles) => Tiles::Batch(Box::new(tiles)),
            None => Tiles::Scalar(Box::new(ScalarTiles::new(draw))),
        },
        // Draws on GPU machines don't reach this function.
        #[cfg(feature = "wgpu")]
        ExecutorKind::Wgpu => Tiles::Scalar(Box::new(ScalarTiles::new(draw))),
    }
}

/// The parameters of a draw as the tile executor receives them. An invalid handle would read as unbound, but the plan
/// has rejected it before.
pub(super) fn tile_draw<'a>(profile: &'a Profile, memory: &'a Memory, call: &DrawCall<'a>) -> TileDraw<'a> {
    let bind = |bound: BoundTexture| {
        let image = memory.current(bound.texture).ok()?;
        Some(SamplerBinding { image, state: bound.state })
    };
    TileDraw {
        program: call.pixel_program,
        rules: &profile.rules,
        bindings: PixelBindings {
            constants: call.pixel_constants,
            samplers: call.samplers.map(|slot| slot.and_then(bind)),
            bump: call.bump,
            projections: call.projections,
        },
        output: call.output_state(),
        step_budget: profile.limits.step_budget(Stage::Pixel),
    }
}
