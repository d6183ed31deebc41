//! One floor of an office building, in the style of Soda Hall: 11,052 triangles, like the model of the Ray Engine
//! (Table 1).
//!
//! A corridor separates the rooms along the outer walls from rooms in the core. Walls have a thickness, doors are open
//! at various angles, and there is no ceiling, so that the view from above shows many small, disjoint objects.
//!
//! | what | triangles |
//! |---|---|
//! | the ground and the floors | 36 |
//! | four outer walls with 28 openings | 1,056 |
//! | bars of 28 windows | 672 |
//! | inner walls | 1,128 |
//! | 32 doors with their frames | 1,536 |
//! | 26 workplaces: desk, monitor, chair | 3,744 |
//! | 22 cupboards | 1,584 |
//! | two meeting tables with six chairs each | 936 |
//! | stairs | 192 |
//! | 14 lamps over the corridor | 168 |

use super::super::{PointLight, Scene, View};
use super::palette::Palette;
use super::parts::{MaterialId, Parts, Placement, SceneRng};

/// Height of the walls, in metres.
const HEIGHT: f64 = 2.8;
/// Dimensions of the floor, in metres.
const WIDTH: f64 = 36.0;
const DEPTH: f64 = 24.0;
/// Thickness of outer and inner walls, in metres.
const OUTER: f64 = 0.3;
const INNER: f64 = 0.15;
/// Distance from the outside to the corridor's wall, and width of the corridor, in metres.
const ROOM: f64 = 5.5;
const CORRIDOR: f64 = 2.2;
/// Width of the rooms in the core, in metres.
const HALL: f64 = 6.8;
/// Extent of the grounds around the house, in metres.
const GROUNDS: f64 = 30.0;
/// Doors: width and height of the opening, in metres.
const DOOR: [f64; 2] = [0.95, 2.1];
/// Windows: width, sill and head, in metres.
const WINDOW: [f64; 3] = [2.0, 0.9, 2.2];

/// Materials of floors, walls and doors.
struct Shell {
    wall: MaterialId,
    outside: MaterialId,
    door: MaterialId,
    frame: MaterialId,
}

/// Opening of a wall.
#[derive(Clone, Copy)]
enum Opening {
    /// Door whose leaf hangs at the left edge as seen from the wall's -y side, opened by `open` degrees towards +y.
    Door { left: f64, open: f64 },
    /// Window.
    Window { left: f64 },
}

/// Builds the floor. Random numbers open doors and move furniture.
pub(super) fn office_floor() -> Scene {
    let mut parts = Parts::default();
    let mut rng = SceneRng::default();
    let palette = Palette::new(&mut parts);
    let shell = Shell {
        wall: parts.paint("wall", [0.70, 0.68, 0.62]),
        outside: parts.paint("outside", [0.52, 0.47, 0.42]),
        door: palette.wood,
        frame: palette.white,
    };
    ground(&mut parts);
    outline(&mut parts, &shell);
    rows(&mut parts, &shell, &palette, &mut rng);
    sides(&mut parts, &shell, &palette, &mut rng);
    core(&mut parts, &shell, &palette, &mut rng);
    corridor(&mut parts, &palette);
    let top = View::upright("top", [18.0, 12.0, 46.0], [18.0, 12.0, 0.0], 0.43);
    let views = vec![
        View { up: [0.0, 1.0, 0.0], ..top },
        View::upright("side", [-7.0, -6.5, 8.5], [14.5, 11.0, 0.0], 0.42),
        View::upright("corridor", [5.9, 6.4, 1.7], [18.0, 6.55, 1.4], 0.6),
    ];
    parts.scene(views, vec![PointLight { position: [10.0, -14.0, 46.0], intensity: [5200.0, 5000.0, 4600.0] }])
}

/// Adds the grounds and the floors, all at height 0 without overlap. 36 triangles.
fn ground(parts: &mut Parts) {
    let lawn = parts.paint("lawn", [0.16, 0.24, 0.10]);
    let carpet = parts.paint("carpet", [0.38, 0.36, 0.33]);
    let paving = parts.paint("paving", [0.34, 0.33, 0.32]);
    let linoleum = parts.paint("linoleum", [0.50, 0.40, 0.28]);
    let floor = |parts: &mut Parts, low: [f64; 2], high: [f64; 2], material| {
        let [x, y] = [high[0] - low[0], high[1] - low[1]];
        parts.quad(Placement::ROOM, [[low[0], low[1], 0.0], [x, 0.0, 0.0], [0.0, y, 0.0]], material);
    };
    // Rectangular rings of four pieces, for the rooms and for the corridor.
    let around = |parts: &mut Parts, outer: f64, inner: f64, material| {
        floor(parts, [outer, outer], [WIDTH - outer, inner], material);
        floor(parts, [outer, DEPTH - inner], [WIDTH - outer, DEPTH - outer], material);
        floor(parts, [outer, inner], [inner, DEPTH - inner], material);
        floor(parts, [WIDTH - inner, inner], [WIDTH - outer, DEPTH - inner], material);
    };
    around(parts, 0.0, ROOM, carpet);
    around(parts, ROOM, ROOM + CORRIDOR, linoleum);
    let (x, y) = (ROOM + CORRIDOR, ROOM + CORRIDOR);
    floor(parts, [x, y], [x + HALL, DEPTH - y], carpet);
    floor(parts, [x + HALL, y], [WIDTH - x - HALL, DEPTH - y], linoleum);
    floor(parts, [WIDTH - x - HALL, y], [WIDTH - x, DEPTH - y], carpet);
    // Lawn on all sides, a path to the front and a yard at the right.
    floor(parts, [-GROUNDS, -GROUNDS], [16.5, 0.0], lawn);
    floor(parts, [16.5, -GROUNDS], [19.5, 0.0], paving);
    floor(parts, [19.5, -GROUNDS], [WIDTH + GROUNDS, 0.0], lawn);
    floor(parts, [-GROUNDS, 0.0], [0.0, DEPTH], lawn);
    floor(parts, [WIDTH, 0.0], [WIDTH + 9.0, DEPTH], paving);
    floor(parts, [WIDTH + 9.0, 0.0], [WIDTH + GROUNDS, DEPTH], lawn);
    floor(parts, [-GROUNDS, DEPTH], [WIDTH + GROUNDS, DEPTH + GROUNDS], lawn);
}

/// Adds a wall along its placement's x from 0 to `length`, `thick` to +y, with openings from left to right. Each solid
/// section is a block.
fn wall(
    parts: &mut Parts,
    place: Placement,
    [length, thick]: [f64; 2],
    openings: &[Opening],
    shell: &Shell,
    material: MaterialId,
) {
    let mut from = 0.0;
    let stretch = |parts: &mut Parts, x: [f64; 2], z: [f64; 2]| {
        parts.block(place, [x[0], 0.0, z[0]], [x[1], thick, z[1]], material);
    };
    for &opening in openings {
        match opening {
            Opening::Door { left, open } => {
                let right = left + DOOR[0];
                stretch(parts, [from, left], [0.0, HEIGHT]);
                stretch(parts, [left, right], [DOOR[1], HEIGHT]);
                door(parts, place.to(left, thick / 2.0, 0.0), open, shell);
                from = right;
            }
            Opening::Window { left } => {
                let [wide, sill, head] = WINDOW;
                let right = left + wide;
                stretch(parts, [from, left], [0.0, HEIGHT]);
                stretch(parts, [left, right], [0.0, sill]);
                stretch(parts, [left, right], [head, HEIGHT]);
                window(parts, place.to(left, thick / 2.0, sill), shell);
                from = right;
            }
        }
    }
    stretch(parts, [from, length], [0.0, HEIGHT]);
}

/// Adds two posts and a lintel of a frame, and a leaf. 48 triangles.
fn door(parts: &mut Parts, place: Placement, open: f64, shell: &Shell) {
    let [wide, high] = DOOR;
    for x in [0.0, wide - 0.04] {
        parts.block(place, [x, -0.1, 0.0], [x + 0.04, 0.1, high - 0.04], shell.frame);
    }
    parts.block(place, [0.0, -0.1, high - 0.04], [wide, 0.1, high - 0.001], shell.frame);
    let leaf = place.to(0.045, 0.0, 0.0).facing(open);
    parts.block(leaf, [0.0, -0.02, 0.01], [wide - 0.09, 0.02, high - 0.05], shell.door);
}

/// Adds two bars across an opening without glass. 24 triangles.
fn window(parts: &mut Parts, place: Placement, shell: &Shell) {
    let [wide, sill, head] = WINDOW;
    let high = head - sill;
    parts.block(place, [wide / 2.0 - 0.03, -0.04, 0.0], [wide / 2.0 + 0.03, 0.04, high], shell.frame);
    parts.block(place, [0.0, -0.03, 0.65 * high - 0.03], [wide, 0.03, 0.65 * high + 0.03], shell.frame);
}

/// Adds the outer walls, with a window per room.
fn outline(parts: &mut Parts, shell: &Shell) {
    let windows = |count: u32, first: f64, pitch: f64| {
        (0..count).map(|i| Opening::Window { left: first + pitch * f64::from(i) }).collect::<Vec<_>>()
    };
    let (long, short) = (windows(9, 1.0, 4.0), windows(5, 1.1, 4.48));
    let between = DEPTH - 2.0 * OUTER;
    let outside = shell.outside;
    wall(parts, Placement::at(0.0, 0.0, 0.0), [WIDTH, OUTER], &long, shell, outside);
    wall(parts, Placement::at(0.0, DEPTH - OUTER, 0.0), [WIDTH, OUTER], &long, shell, outside);
    wall(parts, Placement::at(OUTER, OUTER, 0.0).facing(90.0), [between, OUTER], &short, shell, outside);
    wall(parts, Placement::at(WIDTH, OUTER, 0.0).facing(90.0), [between, OUTER], &short, shell, outside);
}

/// Returns the random opening angle of a door, in degrees: a third are shut.
fn ajar(rng: &mut SceneRng) -> f64 {
    (rng.between(-60.0, 110.0)).max(0.0)
}

/// Adds the rows of nine rooms along the two long sides.
fn rows(parts: &mut Parts, shell: &Shell, palette: &Palette, rng: &mut SceneRng) {
    for degrees in [0.0, 180.0] {
        // Each row is built in the frame of its corner of the house; the second row is the first, rotated by half a
        // turn.
        let house = if degrees == 0.0 { Placement::ROOM } else { Placement::at(WIDTH, DEPTH, 0.0).facing(180.0) };
        let doors: Vec<Opening> =
            (0..9).map(|i| Opening::Door { left: 0.6 + 4.0 * f64::from(i), open: ajar(rng) }).collect();
        // The wall is built from its far end, so that the doors open into the rooms.
        let base = house.to(WIDTH - OUTER, ROOM, 0.0).facing(180.0);
        wall(parts, base, [WIDTH - 2.0 * OUTER, INNER], &doors, shell, shell.wall);
        for room in 1..9 {
            let place = house.to(4.0 * f64::from(room) + INNER / 2.0, OUTER, 0.0).facing(90.0);
            wall(parts, place, [ROOM - INNER - OUTER, INNER], &[], shell, shell.wall);
        }
        for room in 0..9 {
            let place = house.to(4.0 * f64::from(room) + 2.0, OUTER, 0.0);
            let desks = if room == 4 { 2 } else { 1 };
            furnish(parts, place, [desks, u32::from([1, 3, 4, 6, 7].contains(&room))], palette, rng);
        }
    }
}

/// Adds three rooms at each of the two short sides.
fn sides(parts: &mut Parts, shell: &Shell, palette: &Palette, rng: &mut SceneRng) {
    let long = DEPTH - 2.0 * ROOM;
    for turned in [false, true] {
        let house = if turned { Placement::at(WIDTH, DEPTH, 0.0).facing(180.0) } else { Placement::ROOM };
        let doors: Vec<Opening> =
            (0..3).map(|i| Opening::Door { left: 1.4 + long / 3.0 * f64::from(i), open: ajar(rng) }).collect();
        wall(parts, house.to(ROOM, ROOM, 0.0).facing(90.0), [long, INNER], &doors, shell, shell.wall);
        for room in 1..3 {
            let place = house.to(OUTER, ROOM + long / 3.0 * f64::from(room), 0.0);
            wall(parts, place, [ROOM - INNER - OUTER, INNER], &[], shell, shell.wall);
        }
        for room in 0..3 {
            let middle = ROOM + long / 3.0 * (f64::from(room) + 0.5);
            furnish(parts, house.to(OUTER, middle, 0.0).facing(-90.0), [1, 1], palette, rng);
        }
    }
}

/// Adds the core: two meeting rooms, two store rooms with shelves, and stairs between.
fn core(parts: &mut Parts, shell: &Shell, palette: &Palette, rng: &mut SceneRng) {
    let (x, y) = (ROOM + CORRIDOR, ROOM + CORRIDOR);
    let (long, deep) = (WIDTH - 2.0 * x, DEPTH - 2.0 * y);
    for turned in [false, true] {
        let house = if turned { Placement::at(WIDTH, DEPTH, 0.0).facing(180.0) } else { Placement::ROOM };
        let doors: Vec<Opening> = [1.2, 7.6, 11.4, 17.6].map(|left| Opening::Door { left, open: ajar(rng) }).to_vec();
        wall(parts, house.to(x, y, 0.0), [long, INNER], &doors, shell, shell.wall);
        for left in [x + INNER, x + HALL] {
            let place = house.to(left, y + INNER, 0.0).facing(90.0);
            wall(parts, place, [deep - 2.0 * INNER, INNER], &[], shell, shell.wall);
        }
        meeting(parts, house.to(x + 3.4, y + deep / 2.0, 0.0), palette, rng);
        for shelf in 0..3 {
            cupboard(parts, house.to(x + 7.6 + 1.3 * f64::from(shelf), y + 3.2, 0.0), palette);
        }
    }
    stairs(parts, Placement::at(WIDTH / 2.0 - 2.4, DEPTH / 2.0 - 0.3, 0.0), palette);
}

/// Adds lamps over the corridor.
fn corridor(parts: &mut Parts, palette: &Palette) {
    let middle = ROOM + CORRIDOR / 2.0;
    let shine = [palette.metal, palette.metal, palette.metal, palette.metal, palette.tube, palette.metal];
    for lamp in 0..7 {
        let x = middle + (WIDTH - 2.0 * middle) / 6.0 * f64::from(lamp);
        for y in [middle, DEPTH - middle] {
            parts.painted_block(Placement::at(x, y, HEIGHT - 0.1), [-0.6, -0.1, 0.0], [0.6, 0.1, 0.06], shine);
        }
    }
}

/// Furnishes a room of one or two workplaces, with or without a cupboard; the placement is the middle of the window's
/// wall, and the room extends towards +y.
fn furnish(parts: &mut Parts, place: Placement, [desks, cupboards]: [u32; 2], palette: &Palette, rng: &mut SceneRng) {
    let left = place.to(-1.35, 1.5 + rng.between(-0.15, 0.15), 0.0).facing(90.0);
    workplace(parts, left, palette, rng);
    if desks == 2 {
        let right = place.to(1.35, 1.5 + rng.between(-0.15, 0.15), 0.0).facing(-90.0);
        workplace(parts, right, palette, rng);
    }
    for _ in 0..cupboards {
        cupboard(parts, place.to(1.7, 4.2 + rng.between(-0.3, 0.1), 0.0).facing(-90.0), palette);
    }
}

/// Adds a desk, a chair at its -y side, and a monitor. 144 triangles.
fn workplace(parts: &mut Parts, place: Placement, palette: &Palette, rng: &mut SceneRng) {
    parts.block(place, [-0.8, -0.4, 0.7], [0.8, 0.4, 0.74], palette.wood);
    for x in [-0.78, 0.74] {
        parts.block(place, [x, -0.36, 0.0], [x + 0.04, 0.36, 0.7], palette.dark_wood);
    }
    parts.block(place, [-0.74, 0.3, 0.2], [0.74, 0.32, 0.7], palette.dark_wood);
    let monitor = place.to(-0.1, 0.05, 0.74).facing(rng.between(-15.0, 15.0));
    parts.block(monitor, [-0.2, -0.12, 0.0], [0.2, 0.25, 0.37], palette.beige);
    parts.block(monitor, [-0.17, -0.125, 0.05], [0.17, -0.12, 0.34], palette.screen);
    let seat = place.to(rng.between(-0.3, 0.3), rng.between(-0.9, -0.6), 0.0);
    chair(parts, seat.facing(rng.between(-50.0, 50.0)), palette);
}

/// Adds a chair of four legs. 72 triangles.
fn chair(parts: &mut Parts, place: Placement, palette: &Palette) {
    parts.block(place, [-0.22, -0.22, 0.42], [0.22, 0.22, 0.46], palette.cloth);
    parts.block(place, [-0.22, -0.24, 0.55], [0.22, -0.2, 0.9], palette.cloth);
    for (x, y, high) in [(-0.2, -0.22, 0.55), (0.17, -0.22, 0.55), (-0.2, 0.18, 0.42), (0.17, 0.18, 0.42)] {
        // The hind legs carry the back.
        let back = if high > 0.5 { 0.035 } else { 0.0 };
        parts.block(place, [x, y - back, 0.0], [x + 0.03, y + 0.015, high], palette.metal);
    }
}

/// Adds an open cupboard with three boards, its back to +y. 72 triangles.
fn cupboard(parts: &mut Parts, place: Placement, palette: &Palette) {
    for x in [-0.5, 0.47] {
        parts.block(place, [x, -0.2, 0.0], [x + 0.03, 0.2, 1.8], palette.wood);
    }
    parts.block(place, [-0.47, 0.18, 0.0], [0.47, 0.2, 1.8], palette.dark_wood);
    for board in 0..3 {
        let z = 0.05 + 0.85 * f64::from(board);
        parts.block(place, [-0.47, -0.19, z], [0.47, 0.18, z + 0.03], palette.wood);
    }
}

/// Adds a long table with six chairs.
fn meeting(parts: &mut Parts, place: Placement, palette: &Palette, rng: &mut SceneRng) {
    parts.block(place, [-2.0, -0.6, 0.7], [2.0, 0.6, 0.74], palette.dark_wood);
    for x in [-1.6, 1.5] {
        parts.block(place, [x, -0.4, 0.0], [x + 0.1, 0.4, 0.7], palette.metal);
    }
    for seat in 0..3 {
        let x = -1.3 + 1.3 * f64::from(seat);
        chair(parts, place.to(x, -0.8, 0.0).facing(rng.between(-20.0, 20.0)), palette);
        chair(parts, place.to(x, 0.8, 0.0).facing(180.0 + rng.between(-20.0, 20.0)), palette);
    }
}

/// Adds a flight of sixteen steps. 192 triangles.
fn stairs(parts: &mut Parts, place: Placement, palette: &Palette) {
    for step in 0..16 {
        let (x, z) = (0.28 * f64::from(step), 0.17 * f64::from(step));
        parts.block(place, [x, -1.0, z], [x + 0.3, 1.0, z + 0.17], palette.white);
    }
}
