//! Scenes of the project by name: files in this folder, and rooms built in code.
//!
//! A scene's files are those of `crossbar scene NAME --out`, its mesh compressed: `NAME.toml`, `NAME.mtl` and
//! `NAME.obj.gz`. Units are metres, z is up, fronts face outwards (inwards in a room).

use std::io::Read as _;
use std::path::Path;

use flate2::read::GzDecoder;

use super::scene_file;
use super::scene_obj::parse_scene;
use crate::scene::Scene;
use crate::scene::built::rooms::{CornellBox, cornell};

enum SceneSource {
    /// The scene file, the compressed OBJ file and the material library.
    Files(&'static str, &'static [u8], &'static str),
    Room(CornellBox),
}

macro_rules! files {
    ($name:literal) => {
        SceneSource::Files(
            include_str!(concat!($name, ".toml")),
            include_bytes!(concat!($name, ".obj.gz")),
            include_str!(concat!($name, ".mtl")),
        )
    };
}

/// Name, one-line description and source of each scene.
const SCENES: &[(&str, &str, SceneSource)] = &[
    ("cornell-box", "the Cornell box with its two blocks", files!("cornell_box")),
    (
        "cornell-room",
        "a Cornell box closed in front, without blocks: the radiosity paper's scene",
        SceneSource::Room(CornellBox { blocks: false, open: false }),
    ),
    (
        "cornell-room-blocks",
        "the closed Cornell box with its two blocks",
        SceneSource::Room(CornellBox { blocks: true, open: false }),
    ),
    ("harbour", "a boat in wavy water that reflects: Figure 1 of the Ray Engine", files!("harbour")),
    ("office", "an office with eight desks and many objects on them: Figure 6 c of the Ray Engine", files!("office")),
    (
        "office-floor",
        "one floor of an office building without its ceiling: Figure 6 d and e of the Ray Engine",
        files!("office_floor"),
    ),
    (
        "teapot-room",
        "a small room with a metal teapot, a glass sphere and two blocks: Figure 6 a and b of the Ray Engine",
        files!("teapot_room"),
    ),
    ("white-box", "a closed box that shines inwards everywhere: a white furnace", files!("white_box")),
];

/// Names of all scenes, in alphabetical order.
pub fn names() -> impl Iterator<Item = &'static str> {
    SCENES.iter().map(|entry| entry.0)
}

/// One-line description of a scene.
pub fn description(name: &str) -> Option<&'static str> {
    SCENES.iter().find(|entry| entry.0 == name).map(|entry| entry.1)
}

/// The scene with this name.
pub fn named(name: &str) -> Option<Scene> {
    SCENES.iter().find(|entry| entry.0 == name).map(|entry| match entry.2 {
        SceneSource::Files(views, mesh, materials) => read(name, views, mesh, materials),
        SceneSource::Room(room) => cornell(room),
    })
}

/// Reads a scene's files. They are part of the program, and tests read every one, so reading fails only if memory runs
/// out, and then any other allocation would end the program too.
fn read(name: &str, views: &str, mesh: &[u8], materials: &str) -> Scene {
    let mut obj = Vec::new();
    GzDecoder::new(mesh).read_to_end(&mut obj).expect("a compressed file, and memory for its text");
    let library = &mut |_: &Path| Ok(materials.as_bytes().to_vec());
    let mut scene = parse_scene(&obj, Path::new(name), library).expect("a scene");
    (_, scene.views, scene.point_lights) = scene_file::parse(views, Path::new(name)).expect("views and lights");
    scene
}
