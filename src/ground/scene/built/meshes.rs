//! Named meshes built by the project, without lights and views.

use super::super::Material;
use super::flat_models::{FlatModel, MaterialMesh};
use super::stand_ins;
use super::transfer_models::TransferModel;
use crate::geom::Mesh;

const CHAIR: &str = "bi-scale-chair";
const TEMPLE: &str = "bi-scale-temple";

type Builder = fn() -> Mesh;

/// Name, one-line description and builder of each mesh.
const MESHES: &[(&str, &str, Builder)] = &[
    ("all-frequency-buddha", "54,100 vertices, closed, a standing Buddha", || TransferModel::Buddha.mesh(1)),
    ("all-frequency-bunny", "11,556 vertices, closed, the Stanford bunny coarsened", || TransferModel::Bunny.mesh(1)),
    ("all-frequency-teapot", "51,361 vertices, 32 patches of 40 x 40 quads", teapot),
    ("all-frequency-tweety", "32,768 vertices, closed, a bird", || TransferModel::Tweety.mesh(1)),
    ("bi-scale-armor", "10,652 vertices, closed, a suit of armor", || TransferModel::BiScaleArmor.mesh(1)),
    ("bi-scale-bunny", "3,286 vertices, closed, the Stanford bunny coarsened", || TransferModel::BiScaleBunny.mesh(1)),
    ("bi-scale-bunny-fine", "the same refined to 47,960 vertices", || TransferModel::BiScaleBunnyFine.mesh(1)),
    ("bi-scale-bunny-middle", "the same with 12,380 vertices", || TransferModel::BiScaleBunnyMiddle.mesh(1)),
    (CHAIR, "16,101 vertices, curved parts of three materials", || FlatModel::Chair.model(1).mesh),
    (TEMPLE, "32,409 vertices, parts of five materials", || FlatModel::Temple.model(1).mesh),
    ("stand-in-dolphin", "21,952 faces, closed, a dolphin", stand_ins::dolphin),
    ("stand-in-head", "7,232 faces, closed, a head", stand_ins::head),
    ("stanford-bunny", "69,451 faces, the Stanford bunny as scanned, with five holes", stand_ins::bunny),
    ("transfer-bird", "48,688 vertices, closed, a bird", || TransferModel::Bird.mesh(1)),
    ("transfer-buddha", "49,990 vertices, closed, a standing Buddha", || TransferModel::FoldedBuddha.mesh(1)),
    ("transfer-head", "50,060 vertices, closed, a head", || TransferModel::Head.mesh(1)),
    ("transfer-polygons", "58,624 vertices, a ground and a blocker", || TransferModel::Polygons.mesh(1)),
];

/// Builds the teapot with about as many vertices as in the paper on all-frequency transfer (its Table 1).
fn teapot() -> Mesh {
    crate::geom::teapot::teapot(40).expect("a rate in range")
}

/// Names of all meshes, in alphabetical order.
pub fn names() -> impl Iterator<Item = &'static str> {
    MESHES.iter().map(|entry| entry.0)
}

/// One-line description of a mesh.
pub fn description(name: &str) -> Option<&'static str> {
    MESHES.iter().find(|entry| entry.0 == name).map(|entry| entry.1)
}

/// Builds the mesh with this name.
pub fn build(name: &str) -> Option<Mesh> {
    MESHES.iter().find(|entry| entry.0 == name).map(|entry| entry.2())
}

/// Builds the mesh with this name and its materials; a mesh without materials gets one, `plain`, with a reflectance of
/// one half.
pub fn build_with_materials(name: &str) -> Option<MaterialMesh> {
    match name {
        CHAIR => Some(FlatModel::Chair.model(1)),
        TEMPLE => Some(FlatModel::Temple.model(1)),
        _ => build(name).map(|mesh| {
            let materials = vec![Material::diffuse("plain", [0.5; 3])];
            MaterialMesh { material_of: vec![0; mesh.len()], materials, mesh }
        }),
    }
}
