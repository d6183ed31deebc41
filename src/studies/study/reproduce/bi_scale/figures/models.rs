//! Stand-ins for the models and materials of the figures.

use glam::DVec3;

use super::scene::{FigureSize, TexturedModel};
use crate::bi_scale::texture::PatchKind;
use crate::scene::Material;
use crate::scene::built::flat_models::{FlatModel, MaterialMesh};
use crate::scene::built::transfer_models::TransferModel;

/// Indices into [`FigureSize::texels`].
const FINE: usize = 0;
const COARSE: usize = 1;

/// Figure 1: a bunny with bumps.
pub(super) fn bunny(size: FigureSize) -> TexturedModel {
    smooth("bunny", TransferModel::BiScaleBunny, PatchKind::Bumps, size)
}

/// Figure 5: mail armor.
pub(super) fn armor(size: FigureSize) -> TexturedModel {
    smooth("armor", TransferModel::BiScaleArmor, PatchKind::Mail, size)
}

/// Figure 8: the bunny; its material is not stated, and rough bricks show shadows of the patch.
pub(super) fn rough_bunny(size: FigureSize) -> TexturedModel {
    smooth("bunny", TransferModel::BiScaleBunny, PatchKind::Bricks, size)
}

fn smooth(name: &'static str, model: TransferModel, patch: PatchKind, size: FigureSize) -> TexturedModel {
    let mesh = model.mesh(size.coarser);
    let material_of = vec![0; mesh.len()];
    let materials = vec![Material::diffuse(name, [0.5; 3])];
    let model = MaterialMesh { mesh, materials, material_of };
    TexturedModel { name, model, patches: vec![(patch, FINE)], eye: DVec3::new(1.6, -2.4, 0.9) }
}

/// Figure 6: a chair of three materials.
pub(super) fn chair(size: FigureSize) -> TexturedModel {
    let patches = vec![(PatchKind::Bumps, COARSE), (PatchKind::Weave, FINE), (PatchKind::Mail, COARSE)];
    let model = FlatModel::Chair.model(size.coarser);
    TexturedModel { name: "chair", model, patches, eye: DVec3::new(1.6, -2.4, 1.2) }
}

/// Figure 7: a temple of five materials, of which the eaves have the larger patch.
pub(super) fn temple(size: FigureSize) -> TexturedModel {
    let patches = vec![
        (PatchKind::Tiles, COARSE),
        (PatchKind::Bumps, COARSE),
        (PatchKind::Bricks, COARSE),
        (PatchKind::Weave, FINE),
        (PatchKind::Mail, COARSE),
    ];
    let model = FlatModel::Temple.model(size.coarser);
    TexturedModel { name: "temple", model, patches, eye: DVec3::new(1.5, -2.6, 1.0) }
}
