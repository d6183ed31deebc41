//! The Cornell box, as measured at Cornell University: 42 triangles, open in front.
//!
//! The published coordinates are in millimetres, x to the left and y up; here x runs to the right and z up, in metres.
//! The ceiling has a hole where the light is, so that no two faces lie in one plane.

use super::super::{Material, PointLight, Scene, View};
use super::parts::{MaterialId, Parts, Placement};

/// Builds the box with its two blocks and its light.
pub(super) fn cornell_box() -> Scene {
    let mut parts = Parts::default();
    let white = parts.paint("white", [0.73, 0.73, 0.73]);
    let red = parts.paint("red", [0.61, 0.06, 0.06]);
    let green = parts.paint("green", [0.12, 0.43, 0.10]);
    let light = parts.material(Material { emission: [17.0, 12.0, 4.0], ..Material::diffuse("light", [0.78; 3]) });
    walls(&mut parts, white, [red, green], light);
    let short = [[130.0, 65.0], [82.0, 225.0], [240.0, 272.0], [290.0, 114.0]];
    let tall = [[423.0, 247.0], [265.0, 296.0], [314.0, 456.0], [472.0, 406.0]];
    block(&mut parts, short, 165.0, white);
    block(&mut parts, tall, 330.0, white);
    // Half of a 25 mm film divided by a focal length of 35 mm.
    let view = View::upright("front", [0.278, -0.8, 0.273], [0.278, 0.0, 0.273], 0.357_142_87);
    let lamp = PointLight { position: [0.278, 0.2795, 0.53], intensity: [0.23, 0.165, 0.055] };
    parts.scene(vec![view], vec![lamp])
}

/// Converts a point of the published list: x to the left, depth, height in millimetres.
fn measured([x, height, depth]: [f64; 3]) -> [f64; 3] {
    [(556.0 - x) / 1000.0, depth / 1000.0, height / 1000.0]
}

fn wall(parts: &mut Parts, corners: [[f64; 3]; 4], material: MaterialId) {
    parts.polygon(Placement::ROOM, &corners.map(measured), material);
}

fn walls(parts: &mut Parts, white: MaterialId, [left, right]: [MaterialId; 2], light: MaterialId) {
    let top = 548.8;
    wall(parts, [[552.8, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 559.2], [549.6, 0.0, 559.2]], white);
    wall(parts, [[549.6, 0.0, 559.2], [0.0, 0.0, 559.2], [0.0, top, 559.2], [556.0, top, 559.2]], white);
    wall(parts, [[0.0, 0.0, 559.2], [0.0, 0.0, 0.0], [0.0, top, 0.0], [0.0, top, 559.2]], right);
    wall(parts, [[552.8, 0.0, 0.0], [549.6, 0.0, 559.2], [556.0, top, 559.2], [556.0, top, 0.0]], left);
    let outer = [[556.0, top, 0.0], [556.0, top, 559.2], [0.0, top, 559.2], [0.0, top, 0.0]];
    let inner = [[343.0, top, 227.0], [343.0, top, 332.0], [213.0, top, 332.0], [213.0, top, 227.0]];
    for at in 0..4 {
        let next = (at + 1) % 4;
        wall(parts, [outer[at], outer[next], inner[next], inner[at]], white);
    }
    wall(parts, inner, light);
}

/// Adds a block on a quadrilateral of the floor, whose corners run counter-clockwise seen from above. The block has a
/// lower face. 12 triangles.
fn block(parts: &mut Parts, base: [[f64; 2]; 4], height: f64, material: MaterialId) {
    let ring = |height: f64| base.map(|[x, depth]| [x, height, depth]);
    let (low, high) = (ring(0.0), ring(height));
    wall(parts, high, material);
    for at in 0..4 {
        let next = (at + 1) % 4;
        wall(parts, [low[at], low[next], high[next], high[at]], material);
    }
    wall(parts, [low[3], low[2], low[1], low[0]], material);
}
