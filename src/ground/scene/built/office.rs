//! An office with furniture of many small triangles: 34,000, like the office of the Ray Engine (Table 1).
//!
//! | what | triangles |
//! |---|---|
//! | eight workplaces of 2,928 (keyboard 948, chair 452, lamp 348, mug 318, ...) | 23,424 |
//! | four shelves of 100 books | 5,232 |
//! | three plants | 2,280 |
//! | six lights below the ceiling | 936 |
//! | two windows with blinds | 788 |
//! | two radiators | 624 |
//! | a clock | 416 |
//! | a door | 148 |
//! | a board with three markers | 132 |
//! | floor, ceiling, walls | 20 |

use super::super::{PointLight, Scene, View};
use super::desktop::{keyboard, monitor, mouse, mug, papers, pencils, telephone};
use super::furniture::{basket, bookshelf, chair, desk, desk_lamp, plant, radiator};
use super::palette::{Palette, lamp};
use super::parts::{MaterialId, Parts, Placement, SceneRng};

/// Dimensions of the room, in metres.
const WIDTH: f64 = 9.6;
const DEPTH: f64 = 6.6;
const HEIGHT: f64 = 2.8;
/// Left edges of the windows in the far wall, in metres; all are 1.8 m wide, from 0.9 to 2.4 m high.
const WINDOWS: [f64; 2] = [1.6, 6.0];
const WINDOW: [f64; 3] = [1.8, 0.9, 2.4];
/// Distance of the glass behind the wall, in metres.
const RECESS: f64 = 0.2;

/// Builds the office. Random numbers rotate chairs, and move the objects on the desks.
pub(super) fn office() -> Scene {
    let mut parts = Parts::default();
    let mut rng = SceneRng::default();
    let palette = Palette::new(&mut parts);
    shell(&mut parts, &palette);
    for left in WINDOWS {
        window(&mut parts, left, &palette);
        radiator(&mut parts, Placement::at(left + 0.9, DEPTH - 0.08, 0.0), &palette, 24);
    }
    door(&mut parts, Placement::at(0.0, 1.6, 0.0).turned(2, 0.25), &palette);
    workplaces(&mut parts, &palette, &mut rng);
    along_the_walls(&mut parts, &palette, &mut rng);
    for (x, y) in [(2.4, 1.3), (4.8, 1.3), (7.2, 1.3), (2.4, 4.4), (4.8, 4.4), (7.2, 4.4)] {
        ceiling_light(&mut parts, Placement::at(x, y, HEIGHT), &palette);
    }
    let views = vec![
        View::upright("front", [0.55, 0.5, 1.7], [4.6, 4.0, 0.7], 0.52),
        View::upright("desk", [2.9, 2.35, 1.35], [2.2, 3.55, 0.8], 0.5),
    ];
    parts.scene(
        views,
        vec![
            PointLight { position: [2.4, 2.6, 2.2], intensity: [4.2, 4.2, 3.9] },
            PointLight { position: [7.2, 2.6, 2.2], intensity: [4.2, 4.2, 3.9] },
        ],
    )
}

/// Adds floor, ceiling and walls, all facing inwards. 20 triangles.
fn shell(parts: &mut Parts, palette: &Palette) {
    let carpet = parts.paint("carpet", [0.36, 0.37, 0.40]);
    let wall = parts.paint("wall", [0.72, 0.69, 0.60]);
    let (w, d, h) = (WIDTH, DEPTH, HEIGHT);
    let room = Placement::ROOM;
    parts.quad(room, [[0.0, 0.0, 0.0], [w, 0.0, 0.0], [0.0, d, 0.0]], carpet);
    parts.quad(room, [[0.0, d, h], [w, 0.0, 0.0], [0.0, -d, 0.0]], palette.white);
    parts.quad(room, [[w, 0.0, 0.0], [-w, 0.0, 0.0], [0.0, 0.0, h]], wall);
    parts.quad(room, [[0.0, 0.0, 0.0], [0.0, d, 0.0], [0.0, 0.0, h]], wall);
    parts.quad(room, [[w, d, 0.0], [0.0, -d, 0.0], [0.0, 0.0, h]], wall);
    // Around the windows: below, above, and three pieces between.
    let [wide, sill, head] = WINDOW;
    let mut piece = |x: f64, z: f64, width: f64, height: f64| {
        parts.quad(room, [[x, d, z], [width, 0.0, 0.0], [0.0, 0.0, height]], wall);
    };
    piece(0.0, 0.0, w, sill);
    piece(0.0, head, w, h - head);
    piece(0.0, sill, WINDOWS[0], head - sill);
    piece(WINDOWS[0] + wide, sill, WINDOWS[1] - WINDOWS[0] - wide, head - sill);
    piece(WINDOWS[1] + wide, sill, w - WINDOWS[1] - wide, head - sill);
}

const SLATS: u32 = 26;

/// Adds the recess, a bright sky behind it, a frame and a half-closed blind. 10 + 72 + 12 `SLATS` triangles.
fn window(parts: &mut Parts, left: f64, palette: &Palette) {
    let [wide, sill, head] = WINDOW;
    let high = head - sill;
    let place = Placement::at(left, DEPTH, sill);
    let sky = parts.material(lamp(&format!("sky-{}", if left < 3.0 { "left" } else { "right" }), [7.0, 7.8, 9.0]));
    parts.quad(place, [[0.0, RECESS, 0.0], [wide, 0.0, 0.0], [0.0, 0.0, high]], sky);
    parts.quad(place, [[0.0, 0.0, 0.0], [wide, 0.0, 0.0], [0.0, RECESS, 0.0]], palette.white);
    parts.quad(place, [[0.0, RECESS, high], [wide, 0.0, 0.0], [0.0, -RECESS, 0.0]], palette.white);
    parts.quad(place, [[0.0, 0.0, 0.0], [0.0, RECESS, 0.0], [0.0, 0.0, high]], palette.white);
    parts.quad(place, [[wide, RECESS, 0.0], [0.0, -RECESS, 0.0], [0.0, 0.0, high]], palette.white);
    let (near, far) = (RECESS - 0.06, RECESS - 0.01);
    for x in [0.0, wide / 2.0 - 0.02, wide - 0.04] {
        parts.block(place, [x, near, 0.0], [x + 0.04, far, high], palette.white);
    }
    for z in [0.0, high - 0.04] {
        parts.block(place, [0.04, near + 0.005, z], [wide - 0.04, far - 0.005, z + 0.04], palette.white);
    }
    parts.block(place, [0.02, 0.03, high - 0.05], [wide - 0.02, 0.08, high - 0.01], palette.metal);
    for slat in 0..SLATS {
        let tilted = place.to(wide / 2.0, 0.055, high - 0.07 - 0.026 * f64::from(slat)).turned(0, 0.09);
        parts.block(tilted, [-0.87, -0.0125, -0.0006], [0.87, 0.0125, 0.0006], palette.white);
    }
}

/// Adds a closed door with its frame and a handle, on a wall that faces -y. 148 triangles.
fn door(parts: &mut Parts, place: Placement, palette: &Palette) {
    let wall = place.turned(2, 0.5);
    parts.block(wall, [-0.45, 0.002, 0.002], [0.45, 0.04, 2.05], palette.wood);
    for (x, low, high) in [(-0.53, 0.002, 2.13), (0.45, 0.002, 2.13)] {
        parts.block(wall, [x, 0.002, low], [x + 0.08, 0.055, high], palette.dark_wood);
    }
    parts.block(wall, [-0.45, 0.002, 2.05], [0.45, 0.055, 2.13], palette.dark_wood);
    for z in [0.2, 1.15] {
        parts.frustum(
            wall.to(0.0, 0.04, z).turned(0, -0.25),
            [[-0.33, -0.75, 0.0], [0.33, 0.0, 0.012]],
            0.02,
            [palette.wood; 6],
        );
    }
    parts.cylinder(wall.to(0.38, 0.04, 1.03).turned(0, -0.25), 0.012, [0.0, 0.05], 8, palette.metal);
    parts.sphere(wall.to(0.38, 0.11, 1.03), 0.028, 8, 4, palette.metal);
}

/// Adds eight workplaces in two blocks of four.
fn workplaces(parts: &mut Parts, palette: &Palette, rng: &mut SceneRng) {
    for (x, y, degrees) in [
        (2.2, 3.1, 0.0),
        (3.82, 3.1, 0.0),
        (2.2, 3.92, 180.0),
        (3.82, 3.92, 180.0),
        (6.3, 3.1, 0.0),
        (7.92, 3.1, 0.0),
        (6.3, 3.92, 180.0),
        (7.92, 3.92, 180.0),
    ] {
        workplace(parts, Placement::at(x, y, 0.0).facing(degrees), palette, rng);
    }
}

/// Adds a desk with its objects, a chair and a basket.
fn workplace(parts: &mut Parts, place: Placement, palette: &Palette, rng: &mut SceneRng) {
    desk(parts, place, palette);
    let seat = place.to(rng.between(-0.35, -0.05), rng.between(-0.75, -0.55), 0.0);
    chair(parts, seat.facing(rng.between(-35.0, 35.0)), palette);
    basket(parts, place.to(-0.55, 0.1, 0.0), palette, 20);
    let top = place.to(0.0, 0.0, 0.74);
    monitor(parts, top.to(-0.12, 0.08, 0.0).facing(rng.between(-12.0, 12.0)), palette);
    keyboard(parts, top.to(-0.15, -0.25, 0.0).facing(rng.between(-5.0, 5.0)), palette);
    mouse(parts, top.to(0.16, rng.between(-0.29, -0.2), 0.0).facing(rng.between(-15.0, 15.0)), palette);
    mug(parts, top.to(rng.between(0.27, 0.32), rng.between(-0.1, 0.0), 0.0).facing(rng.between(0.0, 360.0)), palette);
    pencils(parts, top.to(-0.48, 0.0, 0.0), palette, rng);
    telephone(parts, top.to(0.62, -0.1, 0.0).facing(-20.0), palette);
    papers(parts, top.to(-0.6, -0.2, 0.0), palette, rng, 4);
    desk_lamp(parts, top.to(0.5, 0.24, 0.0).facing(rng.between(140.0, 200.0)), palette);
}

/// Adds shelves, plants, a clock and a board.
fn along_the_walls(parts: &mut Parts, palette: &Palette, rng: &mut SceneRng) {
    for y in [0.9, 1.92, 2.94, 3.96] {
        bookshelf(parts, Placement::at(WIDTH - 0.16, y, 0.0).facing(-90.0), palette, rng, [5, 20]);
    }
    for (x, y, leaves) in [(0.5, 6.1, 27), (4.7, 6.2, 21), (9.1, 5.9, 27)] {
        plant(parts, Placement::at(x, y, 0.0), palette, rng, leaves);
    }
    board(parts, Placement::at(0.0, 4.2, 1.5).facing(90.0), palette);
    clock(parts, Placement::at(4.7, DEPTH, 2.1).turned(0, 0.25), palette);
}

/// Adds a board of 2 m on a wall that faces -y, with a tray of markers.
fn board(parts: &mut Parts, place: Placement, palette: &Palette) {
    let place = place.turned(2, 0.5);
    parts.block(place, [-1.0, 0.002, -0.5], [1.0, 0.02, 0.5], palette.paper);
    parts.block(place, [-1.0, 0.002, -0.56], [1.0, 0.08, -0.53], palette.metal);
    for marker in 0..3 {
        let lying = place.to(-0.6 + 0.2 * f64::from(marker), 0.05, -0.52).turned(1, 0.25);
        parts.cylinder(lying, 0.01, [0.0, 0.12], 10, palette.covers[marker as usize]);
    }
}

fn clock(parts: &mut Parts, place: Placement, palette: &Palette) {
    parts.cylinder(place, 0.16, [0.002, 0.03], 32, palette.black);
    parts.cylinder(place, 0.145, [0.03, 0.033], 32, palette.paper);
    for hour in 0..12 {
        let tick = place.turned(2, f64::from(hour) / 12.0);
        parts.block(tick, [0.115, -0.004, 0.033], [0.135, 0.004, 0.035], palette.black);
    }
    for (turns, length, z) in [(0.31, 0.075, 0.035), (0.06, 0.11, 0.037)] {
        parts.block(place.turned(2, turns), [-0.015, -0.004, z], [length, 0.004, z + 0.001], palette.black);
    }
}

/// Adds an emitting box below the ceiling, in a frame, with blades below it. 156 triangles.
fn ceiling_light(parts: &mut Parts, place: Placement, palette: &Palette) {
    let shine: [MaterialId; 6] =
        [palette.white, palette.white, palette.white, palette.white, palette.tube, palette.white];
    parts.painted_block(place, [-0.6, -0.15, -0.04], [0.6, 0.15, -0.002], shine);
    for y in [-0.18, 0.15] {
        parts.block(place, [-0.63, y, -0.09], [0.63, y + 0.03, -0.002], palette.metal);
    }
    for x in [-0.63, 0.6] {
        parts.block(place, [x, -0.15, -0.09], [x + 0.03, 0.15, -0.002], palette.metal);
    }
    for blade in 0..8 {
        let x = -0.47 + 0.134 * f64::from(blade);
        parts.block(place, [x - 0.002, -0.15, -0.085], [x + 0.002, 0.15, -0.05], palette.metal);
    }
}
