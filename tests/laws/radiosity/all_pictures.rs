//! Pictures of a room drawn with every method, for tests of identical bits here and on a GPU (tests/gpu).

use crossbar::picture::Picture;
use crossbar::radiosity::display::Display;
use crossbar::radiosity::rooms::{self, CornellBox};
use crossbar::radiosity::{Patches, Subdivision};
use crossbar::scene::Camera;
use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;

pub(crate) const FLOATS: TexelFormat = TexelFormat::Rgba32f;

pub(crate) fn rooms_and_cameras() -> Vec<(Patches, Camera)> {
    let room = |blocks, open, side: u32| {
        let scene = rooms::cornell(CornellBox { blocks, open });
        let camera = scene.views[0].camera(side, side * 3 / 4).expect("a camera");
        (Patches::new(&scene, Subdivision::AtMost(300)).expect("patches"), camera)
    };
    vec![room(true, true, 48), room(true, false, 48), room(false, false, 40)]
}

/// Numbers that identify patches.
pub(crate) fn colours(patches: &Patches) -> Vec<[f64; 3]> {
    (0..patches.list().len()).map(|i| [0.25 + i as f64, 3.0 / (1.0 + i as f64), 0.1]).collect()
}

/// Linear red, green and blue per pixel.
pub(crate) fn pixels(picture: &Picture) -> Vec<[f64; 3]> {
    picture.linear().expect("color").into_iter().map(|pixel| pixel.map(f64::from)).collect()
}

/// Flat, smooth and ids.
pub(crate) fn all_pictures(device: &str, executor: &Executor) -> [Vec<u64>; 3] {
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
