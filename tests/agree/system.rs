//! What the systems' own suites share: the card, every way to draw on it, and texels as bits.

use crossbar::card::Texels;
use refsim::device::Profile;
#[cfg(feature = "wgpu")]
use refsim::exec::gpu::testing;
use refsim::machine::{Executor, ExecutorKind};

/// The card of both systems.
pub(crate) fn nv35() -> Profile {
    Profile::named("nv35").expect("a card")
}

/// Every way to draw, by name; the scalar executor first.
pub(crate) fn executors() -> Vec<(&'static str, Executor)> {
    let all = vec![("scalar", ExecutorKind::Scalar.into()), ("batch", ExecutorKind::Batch.into())];
    #[cfg(feature = "wgpu")]
    let all = all.into_iter().chain(on_gpu()).collect();
    all
}

/// The adapter that there is; without one, nothing, except where that is a failure.
#[cfg(feature = "wgpu")]
fn on_gpu() -> Option<(&'static str, Executor)> {
    let gpu = testing::shared().unwrap_or_else(|e| panic!("{e}"))?;
    Some(("wgpu", Executor::Gpu { gpu }))
}

/// The bits of all texels.
pub(crate) fn bits(texels: &Texels) -> Vec<[u32; 4]> {
    texels.texels.iter().map(|texel| texel.map(f32::to_bits)).collect()
}
