//! Shared by the suites of the systems: the card, all executors, and texels as bits.

use crossbar::card::Texels;
use refsim::device::Profile;
#[cfg(feature = "wgpu")]
use refsim::exec::gpu::testing;
use refsim::machine::{Executor, ExecutorKind};

/// The card of both systems.
pub(crate) fn nv35() -> Profile {
    Profile::named("nv35").expect("a card")
}

/// All executors by name; the scalar one first.
pub(crate) fn executors() -> Vec<(&'static str, Executor)> {
    let all = vec![("scalar", ExecutorKind::Scalar.into()), ("batch", ExecutorKind::Batch.into())];
    #[cfg(feature = "wgpu")]
    let all = all.into_iter().chain(on_gpu()).collect();
    all
}

/// The adapter; `None` without one, panics where a missing adapter counts as a failure.
#[cfg(feature = "wgpu")]
fn on_gpu() -> Option<(&'static str, Executor)> {
    let gpu = testing::shared().unwrap_or_else(|e| panic!("{e}"))?;
    Some(("wgpu", Executor::Gpu { gpu }))
}

/// The bits of all texels.
pub(crate) fn bits(texels: &Texels) -> Vec<[u32; 4]> {
    texels.texels.iter().map(|texel| texel.map(f32::to_bits)).collect()
}
