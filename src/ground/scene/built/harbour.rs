//! A boat in wavy water, as in Figure 1 of the Ray Engine: 19,130 triangles.
//!
//! | what | triangles |
//! |---|---|
//! | the water, a mirror of 96 x 96 quads over three waves | 18,432 |
//! | the sky, four rings of 24 sides | 168 |
//! | the hull, its deck and two ends | 326 |
//! | cabin, mast, and five posts | 168 |
//! | the quay and two houses | 36 |

use glam::DVec3;

use super::super::{Material, PointLight, Scene, Surface, View};
use super::palette::lamp;
use super::parts::{Parts, Placement};
use crate::elementary::on_circle;

/// Quads along an edge of the water, and half its edge in metres.
const QUADS: i32 = 96;
const HALF: f64 = 12.0;
/// Waves: amplitude in metres, turns per metre along x and y, and phase in turns.
const WAVES: [[f64; 4]; 3] = [[0.03, 0.31, 0.42, 0.1], [0.022, -0.55, 0.36, 0.4], [0.012, 0.83, -0.66, 0.7]];
/// Number of segments along the hull, and around half of a cross section.
const STATIONS: u32 = 14;
const AROUND: u32 = 10;
/// Rings of the sky: height over radius, and radiance below it.
const SKY: [(f64, [f32; 3]); 4] =
    [(0.12, [0.9, 0.76, 0.6]), (0.3, [0.72, 0.76, 0.82]), (0.6, [0.46, 0.62, 0.85]), (1.0, [0.27, 0.45, 0.76])];

pub(super) fn harbour() -> Scene {
    let mut parts = Parts::default();
    water(&mut parts);
    sky(&mut parts);
    boat(&mut parts);
    shore(&mut parts);
    let view = View::upright("boat", [-2.7, -4.6, 1.35], [0.05, 0.35, 0.22], 0.36);
    let sun = PointLight { position: [-7.0, -8.0, 6.0], intensity: [400.0, 380.0, 340.0] };
    let fill = PointLight { position: [6.0, -7.0, 5.0], intensity: [70.0, 80.0, 95.0] };
    parts.scene(vec![view], vec![sun, fill])
}

/// Point of the water's surface above a point of the plane, and its normal.
fn surface(x: f64, y: f64) -> (DVec3, DVec3) {
    let (mut height, mut normal) = (0.0, DVec3::Z);
    for [amplitude, across, along, phase] in WAVES {
        let [cos, sin] = on_circle(across * x + along * y + phase);
        height += amplitude * sin;
        normal -= std::f64::consts::TAU * amplitude * cos * DVec3::new(across, along, 0.0);
    }
    (DVec3::new(x, y, height), normal)
}

fn water(parts: &mut Parts) {
    let surface_of = Surface::Mirror { reflectance: [0.55, 0.64, 0.68] };
    let water = parts.material(Material { name: "water".into(), surface: surface_of, emission: [0.0; 3] });
    let at = |column: i32, row: i32| {
        let [x, y] = [column, row].map(|step| HALF * (2.0 * f64::from(step) / f64::from(QUADS) - 1.0));
        surface(x, y)
    };
    for (row, column) in (0..QUADS).flat_map(|row| (0..QUADS).map(move |column| (row, column))) {
        let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| at(column + i, row + j));
        parts.triangle([a.0, b.0, c.0], Some([a.1, b.1, c.1]), water);
        parts.triangle([a.0, c.0, d.0], Some([a.1, c.1, d.1]), water);
    }
}

/// A dome that emits inwards, with one radiance per ring. It ends below the water, which extends beyond it.
fn sky(parts: &mut Parts) {
    let mut below = [1.0, -0.05];
    for (ring, (height, radiance)) in SKY.into_iter().enumerate() {
        let ring = parts.material(lamp(&format!("sky-{ring}"), radiance));
        let above = [(1.0 - height * height).max(0.0).sqrt(), height];
        parts.lathe(Placement::ROOM, &[above, below].map(|[r, z]| [HALF * r, HALF * z]), 24, ring);
        below = above;
    }
}

fn boat(parts: &mut Parts) {
    let (hull, deck) = (parts.paint("hull", [0.62, 0.07, 0.05]), parts.paint("deck", [0.6, 0.42, 0.24]));
    let (white, mast) = (parts.paint("cabin", [0.82, 0.81, 0.76]), parts.paint("mast", [0.45, 0.3, 0.16]));
    // From stern to bow; around a section from port over the keel to starboard.
    let point = |station: u32, around: u32| {
        let along = 1.74 * f64::from(station) / f64::from(STATIONS) - 0.76;
        let [across, down] = on_circle(0.5 * f64::from(around) / f64::from(AROUND));
        let (half, gunwale) = (0.52 * (1.0 - along * along).sqrt(), 0.32 + 0.2 * along * along);
        DVec3::new(1.5 * along, -half * across, gunwale - (gunwale + 0.2) * down)
    };
    for station in 0..STATIONS {
        for around in 0..AROUND {
            let corners = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(i, j)| point(station + i, around + j));
            parts.polygon(Placement::ROOM, &corners, hull);
        }
        let corners = [(0, 0), (1, 0), (1, AROUND), (0, AROUND)].map(|(i, at)| point(station + i, at));
        parts.polygon(Placement::ROOM, &corners, deck);
    }
    let end = |station: u32| (0..=AROUND).map(move |around| point(station, around));
    parts.polygon(Placement::ROOM, &end(0).rev().collect::<Vec<_>>(), hull);
    parts.polygon(Placement::ROOM, &end(STATIONS).collect::<Vec<_>>(), hull);
    parts.frustum(Placement::at(-0.45, 0.0, 0.3), [[-0.35, -0.24, 0.0], [0.35, 0.24, 0.42]], 0.05, [white; 6]);
    parts.cylinder(Placement::at(0.25, 0.0, 0.3), 0.03, [0.0, 1.5], 10, mast);
    for post in 0..5 {
        parts.cylinder(Placement::at(-2.6 + 1.3 * f64::from(post), 2.2, -0.6), 0.07, [0.0, 1.2], 7, mast);
    }
}

fn shore(parts: &mut Parts) {
    let stone = parts.paint("quay", [0.5, 0.47, 0.42]);
    let ochre = parts.paint("ochre-house", [0.78, 0.55, 0.2]);
    let green = parts.paint("green-house", [0.25, 0.45, 0.33]);
    parts.block(Placement::at(0.0, 5.2, -0.5), [-9.0, 0.0, 0.0], [9.0, 4.0, 0.85], stone);
    parts.frustum(Placement::at(-2.4, 6.0, 0.35), [[-1.2, 0.0, 0.0], [1.2, 1.6, 2.3]], 0.25, [ochre; 6]);
    parts.frustum(Placement::at(1.8, 6.2, 0.35), [[-1.5, 0.0, 0.0], [1.5, 1.6, 1.6]], 0.25, [green; 6]);
}
