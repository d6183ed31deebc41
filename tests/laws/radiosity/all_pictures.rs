//! Rooms with numbered patches, for tests of pictures here and on a GPU (tests/gpu).

use crossbar::picture::Picture;
use crossbar::radiosity::rooms::{self, CornellBox};
use crossbar::radiosity::{Patches, Subdivision};
use crossbar::scene::Camera;
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
