//! Scenes built by the project: exact triangle counts, the same bits on every platform.
//!
//! Units are metres, z is up, fronts face outwards (of a room: inwards). Coordinates are computed in f64 by additions,
//! products, square roots and [`crate::elementary`], and rounded to f32 once. Random numbers move and rotate
//! objects; they never change a count.
//!
//! - `parts`, `solids`: quads, blocks, surfaces of revolution, combined with their materials;
//! - one file per scene;
//! - [`stand_ins`]: meshes with the face counts of models that a paper shows;
//! - [`transfer_models`]: meshes with the vertex counts of other papers' models, normals and texture coordinates;
//! - `bunny`, `bodies`: the surfaces of these models; `isosurface` makes bodies of rounded pieces, `resample` gives a
//!   closed surface any number of vertices;
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
mod harbour;
mod isosurface;
pub mod meshes;
mod office;
mod office_floor;
mod palette;
mod parts;
mod resample;
pub mod rooms;
mod solids;
pub mod stand_ins;
mod teapot_room;
pub mod transfer_models;
mod white_box;

use super::Scene;

use cornell_box::cornell_box;
use harbour::harbour;
use office::office;
use office_floor::office_floor;
use teapot_room::teapot_room;
use white_box::white_box;

pub use parts::SEED;

type Builder = fn() -> Scene;

/// Name, one-line description and builder of each scene.
const SCENES: &[(&str, &str, Builder)] = &[
    ("cornell-box", "the Cornell box with its two blocks", cornell_box),
    ("cornell-room", "a Cornell box closed in front, without blocks: the radiosity paper's scene", || {
        rooms::cornell(rooms::CornellBox { blocks: false, open: false })
    }),
    ("cornell-room-blocks", "the same with its two blocks", || {
        rooms::cornell(rooms::CornellBox { blocks: true, open: false })
    }),
    ("harbour", "a boat in wavy water that reflects: Figure 1 of the Ray Engine", harbour),
    ("office", "an office with eight desks and much on them: Figure 6 c of the Ray Engine", office),
    (
        "office-floor",
        "one floor of an office building without its ceiling: Figure 6 d and e of the Ray Engine",
        office_floor,
    ),
    (
        "teapot-room",
        "a small room with a metal teapot, a glass sphere and two blocks: Figure 6 a and b of the Ray Engine",
        teapot_room,
    ),
    ("white-box", "a closed box that shines inwards everywhere: a white furnace", white_box),
];

/// Names of all scenes, in alphabetical order.
pub fn names() -> impl Iterator<Item = &'static str> {
    SCENES.iter().map(|entry| entry.0)
}

/// One-line description of a scene.
pub fn description(name: &str) -> Option<&'static str> {
    SCENES.iter().find(|entry| entry.0 == name).map(|entry| entry.1)
}

/// Builds the scene with this name.
pub fn build(name: &str) -> Option<Scene> {
    SCENES.iter().find(|entry| entry.0 == name).map(|entry| entry.2())
}
