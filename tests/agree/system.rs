//! Helpers of the systems' suites: the card, all executors, and texels as bits.

use crossbar::card::{CardError, MeshView, Texels};
use crossbar::scene::Camera;
use refsim::device::Profile;
#[cfg(feature = "wgpu")]
use refsim::exec::gpu::testing;
use refsim::machine::{Executor, ExecutorKind};
use refsim::texture::TexelFormat;

/// The card that all suites of systems use.
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

/// The adapter; `None` if there is none; panics if a missing adapter counts as a failure.
#[cfg(feature = "wgpu")]
fn on_gpu() -> Option<(&'static str, Executor)> {
    let gpu = testing::shared().unwrap_or_else(|e| panic!("{e}"))?;
    Some(("wgpu", Executor::Gpu { gpu }))
}

pub(crate) fn bits(texels: &Texels) -> Vec<[u32; 4]> {
    texels.texels.iter().map(|texel| texel.map(f32::to_bits)).collect()
}

/// Panics if the results of executors differ from the scalar executor's.
pub(crate) fn all_find<T: PartialEq>(what: &str, mut found: impl FnMut(&str, Executor) -> T) {
    let mut reference = None;
    for (name, executor) in executors() {
        let what = format!("{what}, {name}");
        let found = found(&what, executor);
        match &reference {
            None => reference = Some(found),
            Some(reference) => assert!(*reference == found, "{what}: differs from the scalar executor"),
        }
    }
}

/// Compares lit pictures of all executors' cards, from above and at a grazing angle, where hills occlude each other and
/// texture reads cross the edges of the maps.
pub(crate) fn pictures_agree<C>(
    what: &str,
    format: TexelFormat,
    card: impl Fn(Executor) -> Result<C, CardError>,
    draw: impl Fn(&mut C, &MeshView) -> Result<Texels, CardError>,
) {
    let cameras = [[0.5, -1.4, 2.6], [2.2, -1.9, 0.45]]
        .map(|eye| Camera::new(eye, [0.0; 3], [0.0, 0.0, 1.0], 0.45, 29, 23).expect("a camera"));
    all_find(what, |what, executor| {
        let mut card = card(executor).unwrap_or_else(|e| panic!("{what}: {e}"));
        cameras.map(|camera| {
            let view = MeshView { camera, exposure: 0.8, format };
            let picture = draw(&mut card, &view).unwrap_or_else(|e| panic!("{what}: {e}"));
            let lit = picture.texels.iter().filter(|texel| texel[..3].iter().any(|&value| value > 0.0)).count();
            assert!(lit > 20, "{what}: {lit} pixels with light");
            bits(&picture)
        })
    });
}
