//! Furniture of many small triangles. Each piece is at its placement's origin and faces -y.

use super::palette::Palette;
use super::parts::{Parts, Placement, SceneRng};

/// Adds a desk of 1.6 x 0.8 m, 0.74 m high, with a box of drawers. 132 triangles.
pub(super) fn desk(parts: &mut Parts, place: Placement, palette: &Palette) {
    let (wood, dark) = (palette.wood, palette.dark_wood);
    parts.block(place, [-0.8, -0.4, 0.71], [0.8, 0.4, 0.74], wood);
    parts.block(place, [-0.78, -0.38, 0.0], [-0.75, 0.38, 0.71], dark);
    parts.block(place, [0.75, -0.38, 0.0], [0.78, 0.38, 0.71], dark);
    parts.block(place, [-0.75, 0.34, 0.25], [0.75, 0.36, 0.71], dark);
    parts.block(place, [0.33, -0.33, 0.08], [0.75, 0.34, 0.71], wood);
    for drawer in 0..3 {
        let z = 0.09 + 0.205 * f64::from(drawer);
        parts.block(place, [0.34, -0.35, z], [0.74, -0.33, z + 0.195], wood);
        parts.block(place, [0.48, -0.37, z + 0.11], [0.60, -0.35, z + 0.125], palette.metal);
    }
}

/// Adds a chair on five castors. 452 triangles.
pub(super) fn chair(parts: &mut Parts, place: Placement, palette: &Palette) {
    for leg in 0..5 {
        let place = place.turned(2, (f64::from(leg) + 0.25) / 5.0);
        parts.frustum(place, [[0.0, -0.025, 0.06], [0.3, 0.025, 0.1]], 0.008, [palette.metal; 6]);
        parts.sphere(place.to(0.28, 0.0, 0.03), 0.03, 8, 4, palette.black);
    }
    parts.cylinder(place, 0.025, [0.07, 0.43], 12, palette.metal);
    let cushion = [[-0.24, -0.23, 0.43], [0.24, 0.23, 0.47]];
    parts.block(place, cushion[0], cushion[1], palette.black);
    parts.frustum(place, [[-0.23, -0.22, 0.47], [0.23, 0.22, 0.51]], 0.025, [palette.cloth; 6]);
    parts.block(place, [-0.03, -0.29, 0.40], [0.03, -0.26, 0.70], palette.metal);
    // The frame of the back begins at its upper edge: x across, y along the back, z towards the sitter.
    let back = place.to(0.0, -0.30, 1.04).turned(0, -0.23);
    parts.block(back, [-0.22, 0.0, -0.03], [0.22, 0.46, 0.0], palette.black);
    parts.frustum(back, [[-0.21, 0.01, 0.0], [0.21, 0.45, 0.035]], 0.03, [palette.cloth; 6]);
    for x in [-0.26, 0.26] {
        parts.block(place, [x - 0.015, -0.06, 0.43], [x + 0.015, -0.02, 0.68], palette.metal);
        parts.frustum(place, [[x - 0.03, -0.18, 0.68], [x + 0.03, 0.12, 0.71]], 0.008, [palette.black; 6]);
    }
}

/// Adds a shelf of 1 x 0.3 m, with `rows` rows of `books` books each, 0.35 m high per row. 36 + 12 (`rows` + 1) + 12
/// `rows` `books` triangles.
pub(super) fn bookshelf(
    parts: &mut Parts,
    place: Placement,
    palette: &Palette,
    rng: &mut SceneRng,
    [rows, books]: [u32; 2],
) {
    let height = 0.35 * f64::from(rows) + 0.03;
    parts.block(place, [-0.5, -0.15, 0.0], [-0.475, 0.15, height], palette.wood);
    parts.block(place, [0.475, -0.15, 0.0], [0.5, 0.15, height], palette.wood);
    parts.block(place, [-0.475, 0.13, 0.0], [0.475, 0.15, height], palette.dark_wood);
    for row in 0..=rows {
        let z = 0.35 * f64::from(row);
        parts.block(place, [-0.475, -0.15, z], [0.475, 0.13, z + 0.03], palette.wood);
    }
    for row in 0..rows {
        let place = place.to(-0.47, 0.12, 0.35 * f64::from(row) + 0.03);
        // The end of each row stays empty.
        let pitch = rng.between(0.82, 0.93) / f64::from(books);
        for book in 0..books {
            let x = f64::from(book) * pitch;
            let (thick, tall) = (pitch * rng.between(0.7, 0.97), rng.between(0.2, 0.29));
            let deep = rng.between(0.16, 0.22);
            let cover = rng.one_of(&palette.covers);
            let faces = [cover, cover, cover, palette.paper, palette.paper, palette.paper];
            parts.painted_block(place, [x, -deep, 0.0], [x + thick, 0.0, tall], faces);
        }
    }
}

/// Adds a desk lamp with an emitting disc in its shade, which hangs over +x. 348 triangles.
pub(super) fn desk_lamp(parts: &mut Parts, place: Placement, palette: &Palette) {
    parts.cylinder(place, 0.08, [0.0, 0.02], 20, palette.black);
    let lower = place.to(0.0, 0.0, 0.02).turned(1, -0.06);
    parts.cylinder(lower, 0.008, [0.0, 0.28], 8, palette.metal);
    let elbow = lower.to(0.0, 0.0, 0.28);
    parts.sphere(elbow, 0.014, 8, 4, palette.black);
    let upper = elbow.turned(1, 0.24);
    parts.cylinder(upper, 0.007, [0.0, 0.24], 8, palette.metal);
    let shade = upper.to(0.0, 0.0, 0.25).turned(1, -0.17);
    let profile = [[0.0, 0.035], [0.024, 0.035], [0.072, -0.07], [0.076, -0.07], [0.03, 0.04], [0.0, 0.04]];
    parts.lathe(shade, &profile, 20, palette.covers[1]);
    parts.disc(shade, 0.05, -0.03, 10, false, palette.bulb);
}

/// Adds a plant of `leaves` leaves in a pot, about 1 m high. 160 + 24 `leaves` triangles.
pub(super) fn plant(parts: &mut Parts, place: Placement, palette: &Palette, rng: &mut SceneRng, leaves: u32) {
    let pot = [[0.0, 0.0], [0.12, 0.0], [0.17, 0.3], [0.155, 0.3], [0.15, 0.26]];
    parts.lathe(place, &pot, 20, palette.clay);
    parts.lathe(place, &[[0.15, 0.26], [0.0, 0.27]], 20, palette.soil);
    for leaf in 0..leaves {
        // The golden angle from one leaf to the next.
        let around = place.to(0.0, 0.0, 0.24).turned(2, 0.381_966 * f64::from(leaf) + rng.between(-0.02, 0.02));
        let lean = 0.02 + 0.13 * f64::from(leaf) / f64::from(leaves) + rng.between(0.0, 0.02);
        let stem = around.to(0.03, 0.0, 0.0).turned(1, lean);
        let length = rng.between(0.35, 0.7);
        parts.cylinder(stem, 0.006, [0.0, length], 5, palette.leaf);
        blade(parts, stem.to(0.0, 0.0, length - 0.01).turned(1, lean + 0.05), palette, rng.between(0.2, 0.34));
    }
}

/// Adds a leaf along z, with a ridge on both sides. 8 triangles.
fn blade(parts: &mut Parts, place: Placement, palette: &Palette, length: f64) {
    let ring = [[0.0, 0.0, 0.0], [0.0, 0.06, 0.4 * length], [0.02, 0.0, length], [0.0, -0.06, 0.4 * length]];
    let (outer, inner) = ([0.018, 0.0, 0.4 * length], [0.008, 0.0, 0.4 * length]);
    for at in 0..4 {
        let (here, next) = (ring[at], ring[(at + 1) % 4]);
        parts.triangle([here, next, outer].map(|at| place.point(at)), None, palette.leaf);
        parts.triangle([next, here, inner].map(|at| place.point(at)), None, palette.leaf);
    }
}

/// Adds a waste-paper basket, open above. 8 `sides` triangles.
pub(super) fn basket(parts: &mut Parts, place: Placement, palette: &Palette, sides: u32) {
    let profile = [[0.0, 0.0], [0.11, 0.0], [0.14, 0.3], [0.134, 0.3], [0.105, 0.006], [0.0, 0.006]];
    parts.lathe(place, &profile, sides, palette.metal);
}

/// Adds a radiator below a window, with its back to +y. 24 + 12 `fins` triangles.
pub(super) fn radiator(parts: &mut Parts, place: Placement, palette: &Palette, fins: u32) {
    let width = 0.06 * f64::from(fins);
    for z in [0.15, 0.6] {
        parts.block(place, [-width / 2.0, 0.03, z], [width / 2.0, 0.06, z + 0.05], palette.white);
    }
    for fin in 0..fins {
        let x = 0.06 * f64::from(fin) - width / 2.0;
        parts.block(place, [x + 0.008, -0.03, 0.12], [x + 0.052, 0.03, 0.68], palette.white);
    }
}
