//! Objects on a desk. Each object is at its placement's origin and faces -y.

use super::palette::Palette;
use super::parts::{MaterialId, Parts, Placement, SceneRng};

/// Adds a cathode-ray monitor. 60 triangles.
pub(super) fn monitor(parts: &mut Parts, place: Placement, palette: &Palette) {
    let (case, screen) = (palette.beige, palette.screen);
    parts.frustum(place, [[-0.13, -0.13, 0.0], [0.13, 0.13, 0.02]], 0.02, [case; 6]);
    parts.block(place, [-0.06, -0.06, 0.02], [0.06, 0.06, 0.06], case);
    parts.block(place, [-0.21, -0.18, 0.06], [0.21, -0.13, 0.41], case);
    parts.frustum(
        place.to(0.0, -0.13, 0.235).turned(0, -0.25),
        [[-0.2, -0.165, 0.0], [0.2, 0.165, 0.32]],
        0.07,
        [case; 6],
    );
    parts.block(place, [-0.175, -0.184, 0.1], [0.175, -0.18, 0.375], screen);
}

/// Adds a keyboard of 78 keys. 948 triangles.
pub(super) fn keyboard(parts: &mut Parts, place: Placement, palette: &Palette) {
    let board = place.turned(0, 0.012);
    parts.block(board, [-0.22, -0.075, 0.0], [0.22, 0.075, 0.018], palette.beige);
    let mut key = |x: f64, y: f64, width: f64, height: f64| {
        let base = [[x + 0.001, y + 0.001, 0.018], [x + width - 0.001, y + height - 0.001, 0.027]];
        parts.frustum(board, base, 0.002, [palette.keys; 6]);
    };
    let pitch = 0.0205;
    // Widths in half keys, from the space bar's row to the function keys' row: 8, 12, 13, 14 and 14 keys.
    let rows: [&[u8]; 5] = [
        &[3, 2, 3, 12, 3, 2, 2, 3],
        &[4, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 6],
        &[3, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 5],
        &[3, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3],
        &[2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 4],
    ];
    for (row, widths) in (0..).zip(rows) {
        let y = -0.062 + 0.025 * f64::from(row);
        let mut x = -0.212;
        for &halves in widths {
            let width = pitch * f64::from(halves) / 2.0;
            key(x, y, width, 0.022);
            x += width;
        }
    }
    for pad in 0..17 {
        let (column, row) = (pad % 4, pad / 4);
        // The keypad: four columns of four keys, and one key above the first column.
        key(0.122 + pitch * f64::from(column), -0.062 + 0.025 * f64::from(row), pitch, 0.022);
    }
}

/// Adds a mouse. 64 triangles.
pub(super) fn mouse(parts: &mut Parts, place: Placement, palette: &Palette) {
    parts.frustum(place, [[-0.03, -0.055, 0.0], [0.03, 0.055, 0.03]], 0.009, [palette.beige; 6]);
    for x in [-0.02, 0.002] {
        parts.block(place, [x, 0.012, 0.03], [x + 0.018, 0.044, 0.033], palette.keys);
    }
    let wheel = place.to(0.0, 0.03, 0.032).turned(1, 0.25);
    parts.cylinder(wheel, 0.006, [-0.001, 0.001], 8, palette.black);
}

/// Adds a mug with coffee in it. 318 triangles.
pub(super) fn mug(parts: &mut Parts, place: Placement, palette: &Palette) {
    vessel(parts, place, [0.036, 0.095], 24, palette.china, palette.soil);
    parts.bent_tube(place.to(0.036, 0.0, 0.048), [0.026, 0.005], [-0.25, 0.25], [10, 6], palette.china);
}

/// Adds a cup of `[radius, height]`, filled below its rim. 7 `sides` + `sides` - 2 triangles.
fn vessel(
    parts: &mut Parts,
    place: Placement,
    [radius, height]: [f64; 2],
    sides: u32,
    wall: MaterialId,
    filling: MaterialId,
) {
    let inner = radius - 0.004;
    parts.disc(place, radius, 0.0, sides, false, wall);
    parts.lathe(place, &[[radius, 0.0], [radius, height], [inner, height], [inner, 0.7 * height]], sides, wall);
    parts.lathe(place, &[[inner, 0.7 * height], [0.0, 0.7 * height]], sides, filling);
}

/// Adds a cup with four pencils. 206 triangles.
pub(super) fn pencils(parts: &mut Parts, place: Placement, palette: &Palette, rng: &mut SceneRng) {
    vessel(parts, place, [0.035, 0.1], 16, palette.metal, palette.black);
    for pencil in 0..4 {
        let lean = place.to(0.0, 0.0, 0.06).turned(2, f64::from(pencil) / 4.0).to(0.012, 0.0, 0.0);
        let lean = lean.turned(1, rng.between(0.005, 0.03));
        parts.cylinder(lean, 0.004, [0.0, rng.between(0.08, 0.12)], 6, rng.one_of(&palette.covers));
    }
}

/// Adds a telephone. 192 triangles.
pub(super) fn telephone(parts: &mut Parts, place: Placement, palette: &Palette) {
    parts.frustum(place, [[-0.1, -0.1, 0.0], [0.1, 0.1, 0.05]], 0.012, [palette.black; 6]);
    for key in 0..12 {
        let (x, y) = (0.0 + 0.025 * f64::from(key % 3), -0.07 + 0.025 * f64::from(key / 3));
        parts.block(place, [x, y, 0.05], [x + 0.018, y + 0.018, 0.056], palette.keys);
    }
    parts.block(place, [-0.075, -0.07, 0.065], [-0.04, 0.07, 0.085], palette.black);
    for y in [-0.085, 0.045] {
        parts.block(place, [-0.08, y, 0.05], [-0.035, y + 0.04, 0.07], palette.black);
    }
}

/// Adds a pile of `sheets` stacks of paper, each a little askew. 12 `sheets` triangles.
pub(super) fn papers(parts: &mut Parts, place: Placement, palette: &Palette, rng: &mut SceneRng, sheets: u32) {
    for sheet in 0..sheets {
        let z = 0.006 * f64::from(sheet);
        let askew = place.facing(rng.between(-14.0, 14.0));
        parts.block(askew, [-0.105, -0.148, z], [0.105, 0.148, z + 0.005], palette.paper);
    }
}
