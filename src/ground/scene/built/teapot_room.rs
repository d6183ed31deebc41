//! A small closed room with a teapot: 2,650 triangles, like the teapot room of the Ray Engine (Table 1).
//!
//! | what | triangles |
//! |---|---|
//! | the teapot at 6 quads per patch side, of polished copper | 2,256 |
//! | the glass sphere, 16 around and 8 bands | 224 |
//! | the round plinth, 20 sides | 76 |
//! | the floor, 4 x 5 tiles | 40 |
//! | the ceiling around its light | 8 |
//! | the light | 2 |
//! | four walls | 8 |
//! | a mirror block, a glossy block, a picture on the wall | 36 |

use glam::DVec3;

use super::super::{Material, PointLight, Scene, Surface, View};
use super::palette::{glossy, lamp};
use super::parts::{MaterialId, Parts, Placement, SEED};
use crate::geom::random::CounterRng;
use crate::geom::teapot::{TeapotPart, part_of_patch, tessellate};
use crate::geom::vector::wide;

/// Quads along a side of a teapot patch.
const RATE: u32 = 6;
/// Half the width of the room, half its depth, and its height, in metres.
const HALF_WIDTH: f64 = 0.6;
const HALF_DEPTH: f64 = 0.75;
const HEIGHT: f64 = 1.1;
/// Half a side of the light in the ceiling, in metres.
const LIGHT: f64 = 0.18;

/// Builds the room. Random numbers slightly shift and rotate blocks and sphere.
pub(super) fn teapot_room() -> Scene {
    let mut parts = Parts::default();
    walls(&mut parts);
    things(&mut parts, CounterRng::new(SEED));
    let view = View::upright("front", [0.02, -0.74, 0.7], [0.01, 0.3, 0.34], 0.6);
    let lamp = PointLight { position: [0.0, 0.05, 1.0], intensity: [0.75, 0.7, 0.6] };
    let fill = PointLight { position: [-0.3, -0.65, 0.85], intensity: [0.16, 0.17, 0.2] };
    parts.scene(vec![view], vec![lamp, fill])
}

fn walls(parts: &mut Parts) {
    let (w, d, h) = (HALF_WIDTH, HALF_DEPTH, HEIGHT);
    let white = parts.paint("white", [0.74, 0.73, 0.70]);
    let red = parts.paint("red", [0.60, 0.06, 0.05]);
    let green = parts.paint("green", [0.12, 0.42, 0.10]);
    let light_tile = parts.paint("light-tile", [0.68, 0.64, 0.56]);
    let dark_tile = parts.paint("dark-tile", [0.22, 0.20, 0.19]);
    let room = Placement::ROOM;
    parts.tiles(room, [[-w, -d, 0.0], [2.0 * w, 0.0, 0.0], [0.0, 2.0 * d, 0.0]], [4, 5], |i, j| {
        if (i + j) % 2 == 0 { light_tile } else { dark_tile }
    });
    parts.quad(room, [[-w, d, 0.0], [2.0 * w, 0.0, 0.0], [0.0, 0.0, h]], white);
    parts.quad(room, [[w, -d, 0.0], [-2.0 * w, 0.0, 0.0], [0.0, 0.0, h]], white);
    parts.quad(room, [[-w, -d, 0.0], [0.0, 2.0 * d, 0.0], [0.0, 0.0, h]], red);
    parts.quad(room, [[w, d, 0.0], [0.0, -2.0 * d, 0.0], [0.0, 0.0, h]], green);
    let lamp = parts.material(lamp("lamp", [12.0, 11.0, 9.0]));
    ceiling(parts, [[-w, -d], [w, d]], [[-LIGHT, -LIGHT], [LIGHT, LIGHT]], h, white, lamp);
}

/// Adds a ceiling that faces down, with a square light in it. 10 triangles.
pub(super) fn ceiling(
    parts: &mut Parts,
    [low, high]: [[f64; 2]; 2],
    hole: [[f64; 2]; 2],
    height: f64,
    around: MaterialId,
    within: MaterialId,
) {
    let ring = |[low, high]: [[f64; 2]; 2]| {
        [[low[0], low[1]], [low[0], high[1]], [high[0], high[1]], [high[0], low[1]]].map(|[x, y]| [x, y, height])
    };
    let (outer, inner) = (ring([low, high]), ring(hole));
    for at in 0..4 {
        let next = (at + 1) % 4;
        parts.polygon(Placement::ROOM, &[outer[at], outer[next], inner[next], inner[at]], around);
    }
    parts.polygon(Placement::ROOM, &inner, within);
}

fn things(parts: &mut Parts, random: CounterRng) {
    // A number from -1 to 1 for each movable object.
    let wobble = |thing: u64| 2.0 * random.unit(thing, 0, 0) - 1.0;
    let mut material =
        |name: &str, surface| parts.material(Material { name: name.into(), surface, emission: [0.0; 3] });
    let copper = material("copper", Surface::Mirror { reflectance: [0.90, 0.66, 0.48] });
    let glass = material("glass", Surface::Glass { index: 1.5, transmittance: [0.97, 0.98, 0.98] });
    let mirror = material("mirror", Surface::Mirror { reflectance: [0.88; 3] });
    let lacquer = parts.material(glossy("lacquer", [0.08, 0.16, 0.42], [0.35; 3], 60.0));
    let stone = parts.paint("stone", [0.62, 0.60, 0.56]);
    let picture = parts.paint("picture", [0.75, 0.52, 0.12]);
    parts.cylinder(Placement::at(0.0, 0.12, 0.0), 0.225, [0.0, 0.15], 20, stone);
    teapot(parts, Placement::at(-0.01, 0.12, 0.15).facing(-14.0), 0.092, copper);
    let block = Placement::at(-0.34 + 0.01 * wobble(0), 0.47, 0.0).facing(22.0 + 4.0 * wobble(1));
    parts.block(block, [-0.13, -0.13, 0.0], [0.13, 0.13, 0.66], mirror);
    let block = Placement::at(-0.37, -0.1 + 0.01 * wobble(2), 0.0).facing(-24.0 + 6.0 * wobble(3));
    parts.block(block, [-0.08, -0.08, 0.0], [0.08, 0.08, 0.16], lacquer);
    parts.sphere(Placement::at(0.37 + 0.01 * wobble(4), -0.06, 0.125), 0.125, 16, 8, glass);
    parts.block(Placement::at(0.2, HALF_DEPTH, 0.56), [-0.2, -0.015, 0.0], [0.2, -0.002, 0.32], picture);
}

/// Adds the teapot with smooth normals: each corner has the area-weighted mean normal of its part's triangles there.
fn teapot(parts: &mut Parts, place: Placement, scale: f64, material: MaterialId) {
    let teapot = tessellate(RATE).expect("a rate in range");
    let corners: Vec<[DVec3; 3]> = teapot.mesh.iter_corners().map(|corners| corners.map(wide)).collect();
    let part = |triangle: usize| match part_of_patch(u32::from(teapot.patch_of[triangle])) {
        // Body and bottom join without a crease.
        TeapotPart::Bottom => TeapotPart::Body,
        other => other,
    };
    let mut sums = std::collections::BTreeMap::<(u32, TeapotPart), DVec3>::new();
    for (triangle, ([a, b, c], indices)) in corners.iter().zip(teapot.mesh.triangles()).enumerate() {
        let normal = (*b - *a).cross(*c - *a);
        for &index in indices {
            *sums.entry((index, part(triangle))).or_default() += normal;
        }
    }
    for (triangle, (at, indices)) in corners.iter().zip(teapot.mesh.triangles()).enumerate() {
        let normals = indices.map(|index| place.direction(sums[&(index, part(triangle))]));
        parts.triangle(at.map(|at| place.point(at * scale)), Some(normals), material);
    }
}
