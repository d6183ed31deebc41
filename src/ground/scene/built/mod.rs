//! Scenes built by the project: exact triangle counts, the same bits on every platform.
//!
//! Units are metres, z is up, fronts face outwards (of a room: inwards). Coordinates are computed in f64 by additions,
//! products, square roots and [`crate::elementary`], and rounded to f32 once. Random numbers move and rotate
//! objects; they never change a count.
//!
//! - `parts`, `solids`: quads, blocks, surfaces of revolution, put together with their materials;
//! - one file a scene;
//! - [`stand_ins`]: meshes with the face counts of models that a paper shows;
//! - [`transfer_models`]: meshes with the vertex counts of those of others, with normals and texture coordinates;
//! - `bunny`, `bodies`: the surfaces of these; `isosurface` makes bodies of rounded pieces, `resample` gives a closed
//!   surface any number of vertices;
//! - [`flat_models`]: models of flat parts with several materials;
//! - [`meshes`]: all of these by name;
//! - [`ground`]: a square below a model that receives its shadow.

mod bodies;
mod bunny;
mod cornell_box;
mod desktop;
pub mod flat_models;
mod furniture;
pub mod ground;
mod isosurface;
pub mod meshes;
mod office;
mod office_floor;
mod palette;
mod parts;
mod resample;
mod rng;
pub mod rooms;
mod solids;
pub mod stand_ins;
mod teapot_room;
pub mod transfer_models;
mod white_box;

use super::Scene;

use cornell_box::cornell_box;
use office::office;
use office_floor::office_floor;
use teapot_room::teapot_room;
use white_box::white_box;

pub use rng::SEED;

/// Scene with its name.
struct BuiltScene {
    name: &'static str,
    what: &'static str,
    build: fn() -> Scene,
}

const SCENES: &[BuiltScene] = &[
    BuiltScene { name: "cornell-box", what: "the Cornell box with its two blocks", build: cornell_box },
    BuiltScene {
        name: "cornell-room",
        what: "a Cornell box closed in front, without blocks: the radiosity paper's scene",
        build: || rooms::cornell(rooms::CornellBox { blocks: false, open: false }),
    },
    BuiltScene {
        name: "cornell-room-blocks",
        what: "the same with its two blocks",
        build: || rooms::cornell(rooms::CornellBox { blocks: true, open: false }),
    },
    BuiltScene {
        name: "office",
        what: "an office with eight desks and much on them: Figure 6 c of the Ray Engine",
        build: office,
    },
    BuiltScene {
        name: "office-floor",
        what: "one floor of an office building without its ceiling: Figure 6 d and e of the Ray Engine",
        build: office_floor,
    },
    BuiltScene {
        name: "teapot-room",
        what: "a small room with a metal teapot, a glass sphere and two blocks: Figure 6 a and b of the Ray Engine",
        build: teapot_room,
    },
    BuiltScene {
        name: "white-box",
        what: "a closed box that shines inwards everywhere: a white furnace",
        build: white_box,
    },
];

/// Names of all scenes, in alphabetical order.
pub fn names() -> impl Iterator<Item = &'static str> {
    SCENES.iter().map(|entry| entry.name)
}

/// One-line description of a scene.
pub fn description(name: &str) -> Option<&'static str> {
    SCENES.iter().find(|entry| entry.name == name).map(|entry| entry.what)
}

/// Builds the scene with this name.
pub fn build(name: &str) -> Option<Scene> {
    SCENES.iter().find(|entry| entry.name == name).map(|entry| (entry.build)())
}
