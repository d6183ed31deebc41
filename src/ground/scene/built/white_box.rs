//! A closed box of grey emitting walls: 12 triangles. The radiance inside is emission / (1 - albedo) everywhere.

use super::super::{Material, Scene, View};
use super::parts::{Parts, Placement};

/// Builds a box from 0 to 1 whose walls face inwards, with emission and albedo of one half: the radiance is 1 in every
/// direction.
pub(super) fn white_box() -> Scene {
    let mut parts = Parts::default();
    let wall = parts.material(Material { emission: [0.5; 3], ..Material::diffuse("wall", [0.5; 3]) });
    for [corner, across, along] in [
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
        [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
    ] {
        parts.quad(Placement::ROOM, [corner, across, along], wall);
    }
    let view = View::upright("front", [0.5, 0.1, 0.5], [0.5, 1.0, 0.5], 0.75);
    parts.scene(vec![view], Vec::new())
}
