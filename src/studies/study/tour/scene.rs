//! The room, and the two models in it.

use glam::DVec3;

use crate::error::InputError;
use crate::geom::Mesh;
use crate::geom::vector::{narrow, wide};
use crate::options::Size;
use crate::radiosity::rooms::{CornellBox, cornell};
use crate::scene::built::transfer_models::TransferModel;
use crate::scene::{Camera, Material, Scene};
use crate::study::glossy_model::GlossyTransfer;
use crate::transfer::brdf::Brdf;

/// The bunny's transfer.
pub(super) const BUNNY: GlossyTransfer = GlossyTransfer {
    // A sharper lobe would show ringing: a lamp this small is too sharp for five orders of harmonics.
    brdf: Brdf::Phong { albedo: 0.5, specular: 0.3, exponent: 6.0 },
    order: 5,
    exit_order: 5,
    clusters: 32,
    vectors: 6,
    iterations: 5,
};
/// Size of a coarse body in the room relative to its model, which therefore hides it.
const WITHIN: f64 = 0.86;

/// A Cornell box, a bunny on its short block, and a suit of armor on its floor.
#[derive(Debug)]
pub(super) struct TourScene {
    /// Walls and blocks, then coarse bodies in place of the models; these reflect light and cast shadows.
    pub(super) room: Scene,
    /// Walls and blocks alone: the first triangles of the room.
    pub(super) walls: Mesh,
    pub(super) bunny: Mesh,
    pub(super) statue: Mesh,
    pub(super) camera: Camera,
}

impl TourScene {
    pub(super) fn new(size: Size, coarser: u32) -> Result<Self, InputError> {
        let empty = cornell(CornellBox { blocks: true, open: true });
        let camera = empty.views.first().expect("a view of the box").camera(size.width, size.height)?;
        // Model, divisors of its detail and of its coarse body's detail, height, and the point on which it stands.
        let places = [
            (TransferModel::BiScaleBunny, [coarser, 10], 1.5, DVec3::new(1.86, 1.69, 1.651)),
            (TransferModel::BiScaleArmor, [2 * coarser, 16], 2.2, DVec3::new(4.2, 1.25, 0.001)),
        ];
        let (mut positions, mut triangles) = (empty.mesh().positions().to_vec(), empty.mesh().triangles().to_vec());
        let (mut materials, mut material_of) = (empty.materials().to_vec(), empty.material_of().to_vec());
        materials.push(Material::diffuse("models", [0.6; 3]));
        for (model, [_, body], height, foot) in places {
            let body = placed(&model.mesh(body), WITHIN * height, foot)?;
            let first = positions.len() as u32;
            triangles.extend(body.triangles().iter().map(|triangle| triangle.map(|corner| first + corner)));
            positions.extend(body.positions());
            material_of.resize(triangles.len(), materials.len() as u32 - 1);
        }
        let [bunny, statue] = places.map(|(model, [fine, _], height, foot)| placed(&model.mesh(fine), height, foot));
        Ok(Self {
            room: Scene::new(Mesh::new(positions, triangles)?, materials, material_of, Vec::new())?,
            walls: empty.mesh().clone(),
            bunny: bunny?,
            statue: statue?,
            camera,
        })
    }
}

/// A model scaled to a height, standing on a point.
fn placed(model: &Mesh, height: f64, foot: DVec3) -> Result<Mesh, InputError> {
    let [low, high] = model.bounds().map_or([DVec3::ZERO; 2], |bounds| bounds.map(wide));
    let (scale, middle) = (height / (high - low).z, (0.5 * (low + high)).with_z(low.z));
    let positions = model.positions().iter().map(|&at| narrow(foot + scale * (wide(at) - middle))).collect();
    let placed = Mesh::new(positions, model.triangles().to_vec())?;
    match model.normals() {
        Some(normals) => placed.with_normals(normals.to_vec()),
        None => Ok(placed),
    }
}

/// The center of a model's bounding box.
pub(super) fn middle(model: &Mesh) -> DVec3 {
    model.bounds().map_or(DVec3::ZERO, |[low, high]| 0.5 * (wide(low) + wide(high)))
}
