//! Pictures of radiosity.

use std::sync::Arc;

use crossbar::picture::Picture;
use crossbar::radiosity::display::Display;
use crossbar::radiosity::rooms::{self, CornellBox};
use refsim::device::Profile;
use refsim::exec::gpu::Gpu;
use refsim::machine::{Executor, ExecutorKind};

use crate::all_pictures::{FLOATS, colours, pixels, rooms_and_cameras};

pub(crate) fn the_same_pictures(gpu: &Arc<Gpu>) {
    let batch = all_pictures("nv35", &ExecutorKind::Batch.into());
    let found = all_pictures("nv35", &Executor::Gpu { gpu: Arc::clone(gpu) });
    assert!(found == batch);
}

/// Flat, smooth and ids.
fn all_pictures(device: &str, executor: &Executor) -> [Vec<u64>; 3] {
    let (patches, _) = rooms_and_cameras().remove(0);
    let scene = rooms::cornell(CornellBox { blocks: true, open: true });
    let camera = scene.views[0].camera(24, 18).expect("a camera");
    let mut machine = executor.machine(Profile::named(device).expect("a device")).expect("a machine");
    let display = Display::new(&mut machine, &patches, &camera, FLOATS).expect("a display");
    let texture = display.upload(&mut machine, &colours(&patches)).expect("a texture");
    let bits = |picture: Picture| pixels(&picture).iter().flatten().map(|value| value.to_bits()).collect();
    let flat = bits(display.flat(&mut machine, texture, 1.0).expect("a picture"));
    let smooth = bits(display.smooth(&mut machine, texture, 1.0).expect("a picture"));
    let ids = display.ids(&mut machine).expect("ids");
    [flat, smooth, ids.into_iter().map(|id| id.map_or(u64::MAX, u64::from)).collect()]
}
