//! Named meshes built by the project that are not scenes.

use super::super::Material;
use super::flat_models::{FlatModel, MaterialMesh};
use super::stand_ins;
use super::transfer_models::TransferModel;
use crate::geom::Mesh;

/// Mesh with its name.
struct BuiltMesh {
    name: &'static str,
    what: &'static str,
    build: fn() -> Mesh,
}

const CHAIR: &str = "bi-scale-chair";
const TEMPLE: &str = "bi-scale-temple";

const MESHES: &[BuiltMesh] = &[
    BuiltMesh {
        name: "all-frequency-buddha",
        what: "54,100 vertices, closed, a standing Buddha",
        build: || TransferModel::Buddha.mesh(1),
    },
    BuiltMesh {
        name: "all-frequency-bunny",
        what: "11,556 vertices, closed, the Stanford bunny refined",
        build: || TransferModel::Bunny.mesh(1),
    },
    BuiltMesh { name: "all-frequency-teapot", what: "51,361 vertices, 32 patches of 40 x 40 quads", build: teapot },
    BuiltMesh {
        name: "all-frequency-tweety",
        what: "32,768 vertices, closed, a bird",
        build: || TransferModel::Tweety.mesh(1),
    },
    BuiltMesh {
        name: "bi-scale-armor",
        what: "10,652 vertices, closed, a suit of armor",
        build: || TransferModel::BiScaleArmor.mesh(1),
    },
    BuiltMesh {
        name: "bi-scale-bunny",
        what: "3,286 vertices, closed, the Stanford bunny refined",
        build: || TransferModel::BiScaleBunny.mesh(1),
    },
    BuiltMesh {
        name: "bi-scale-bunny-fine",
        what: "the same with 47,960 vertices",
        build: || TransferModel::BiScaleBunnyFine.mesh(1),
    },
    BuiltMesh {
        name: "bi-scale-bunny-middle",
        what: "the same with 12,380 vertices",
        build: || TransferModel::BiScaleBunnyMiddle.mesh(1),
    },
    BuiltMesh {
        name: CHAIR,
        what: "16,101 vertices, curved parts of three materials",
        build: || FlatModel::Chair.model(1).mesh,
    },
    BuiltMesh {
        name: TEMPLE,
        what: "32,409 vertices, parts of five materials",
        build: || FlatModel::Temple.model(1).mesh,
    },
    BuiltMesh {
        name: "stand-in-bunny",
        what: "69,451 faces, the Stanford bunny refined, one face open at the bottom",
        build: stand_ins::bunny,
    },
    BuiltMesh { name: "stand-in-dolphin", what: "21,952 faces, closed, a dolphin", build: stand_ins::dolphin },
    BuiltMesh { name: "stand-in-head", what: "7,232 faces, closed, a head", build: stand_ins::head },
    BuiltMesh { name: "transfer-bird", what: "48,688 vertices, closed, a bird", build: || TransferModel::Bird.mesh(1) },
    BuiltMesh {
        name: "transfer-buddha",
        what: "49,990 vertices, closed, a standing Buddha",
        build: || TransferModel::FoldedBuddha.mesh(1),
    },
    BuiltMesh { name: "transfer-head", what: "50,060 vertices, closed, a head", build: || TransferModel::Head.mesh(1) },
    BuiltMesh {
        name: "transfer-polygons",
        what: "58,624 vertices, a ground and a blocker",
        build: || TransferModel::Polygons.mesh(1),
    },
];

/// Builds the teapot with about as many vertices as in the paper on all-frequency transfer (its Table 1).
fn teapot() -> Mesh {
    crate::geom::teapot::teapot(40).expect("a rate in range")
}

/// Names of all meshes, in alphabetical order.
pub fn names() -> impl Iterator<Item = &'static str> {
    MESHES.iter().map(|entry| entry.name)
}

/// One-line description of a mesh.
pub fn description(name: &str) -> Option<&'static str> {
    MESHES.iter().find(|entry| entry.name == name).map(|entry| entry.what)
}

/// Builds the mesh with this name.
pub fn build(name: &str) -> Option<Mesh> {
    MESHES.iter().find(|entry| entry.name == name).map(|entry| (entry.build)())
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
