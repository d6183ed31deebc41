//! Procedural patches. Each repeats without a seam, has 128 x 128 heights, and has the same bits on every machine.

use super::field::HeightField;
use super::patch::{MesoMaterial, MesoPatch, MesoTexel};
use crate::elementary::{atan2, on_circle};
use crate::geom::random::CounterRng;
use crate::transfer::brdf::Brdf;

/// Number of heights along an edge.
const SIDE: usize = 128;

/// A procedural patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::EnumString, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum PatchKind {
    /// Round bumps of several sizes on a soft skin, slightly glossy (the paper's Figure 1).
    Bumps,
    /// Chain mail: rings of wire, each linked with its four neighbors, with highlights across the wire (Figure 5).
    Mail,
    /// Glazed tiles with joints.
    Tiles,
    /// Bricks in running bond, rough, with mortar.
    Bricks,
    /// Threads that alternate over and under each other, with highlights across the thread.
    Weave,
}

/// A point of a patch: height in edges of the patch, material, and angle of the tangent in turns.
struct Place {
    height: f64,
    material: u32,
    turns: f64,
}

impl PatchKind {
    /// All kinds.
    pub const ALL: [Self; 5] = [Self::Bumps, Self::Mail, Self::Tiles, Self::Bricks, Self::Weave];

    /// The patch, with all heights multiplied by `relief`. Panics if `relief` is negative, not finite, or makes the
    /// patch deeper than [`HeightField::DEEPEST`].
    pub fn patch(self, relief: f64) -> MesoPatch {
        assert!(relief >= 0.0, "a relief of 0 or more");
        let place: fn([f64; 2]) -> Place = match self {
            Self::Bumps => bumps,
            Self::Mail => mail,
            Self::Tiles => tiles,
            Self::Bricks => bricks,
            Self::Weave => weave,
        };
        let middle = |at: usize| (at as f64 + 0.5) / SIDE as f64;
        let places: Vec<Place> = (0..SIDE * SIDE).map(|at| place([middle(at % SIDE), middle(at / SIDE)])).collect();
        let heights: Vec<f64> = places.iter().map(|place| relief * place.height).collect();
        let texels = places.iter().map(|place| MesoTexel { material: place.material, turns: place.turns });
        let heights = HeightField::new(SIDE, &heights).expect("a relief in range");
        MesoPatch::new(heights, self.materials(), texels.collect()).expect("materials in range")
    }

    fn materials(self) -> Vec<MesoMaterial> {
        let glossy =
            |color: [f64; 3], lobe: Brdf, lobe_color: [f64; 3]| MesoMaterial { color, lobe: Some(lobe), lobe_color };
        let facets =
            |roughness: f64| Brdf::CookTorrance { albedo: 0.0, specular: 1.0, roughness, normal_incidence: 0.04 };
        let brushed = |specular: f64, roughness: [f64; 2]| Brdf::Ward { albedo: 0.0, specular, roughness };
        let diffuse = MesoMaterial::diffuse;
        match self {
            Self::Bumps => vec![glossy([0.42, 0.26, 0.16], facets(0.35), [1.0; 3])],
            Self::Mail => vec![
                diffuse([0.05, 0.04, 0.035]),
                // Rough across the wire, smooth along the wire.
                glossy([0.06, 0.06, 0.065], brushed(0.7, [0.12, 0.45]), [1.0, 0.97, 0.92]),
            ],
            Self::Tiles => vec![
                diffuse([0.45, 0.43, 0.4]),
                glossy([0.08, 0.22, 0.35], facets(0.12), [1.0; 3]),
                glossy([0.5, 0.48, 0.42], facets(0.12), [1.0; 3]),
            ],
            Self::Bricks => vec![
                diffuse([0.5, 0.48, 0.45]),
                diffuse([0.42, 0.15, 0.1]),
                diffuse([0.5, 0.2, 0.13]),
                diffuse([0.35, 0.13, 0.1]),
            ],
            Self::Weave => vec![
                glossy([0.3, 0.05, 0.06], brushed(0.25, [0.15, 0.5]), [1.0, 0.6, 0.5]),
                glossy([0.35, 0.26, 0.08], brushed(0.25, [0.15, 0.5]), [1.0, 0.9, 0.6]),
            ],
        }
    }
}

/// The signed distance on a circle of circumference 1, in [-1/2, 1/2].
fn around(from: f64, to: f64) -> f64 {
    let apart = (from - to).rem_euclid(1.0);
    if apart > 0.5 { apart - 1.0 } else { apart }
}

/// Smooth value noise on a repeating grid of `count` x `count`, in [0, 1].
fn noise([u, v]: [f64; 2], count: usize, seed: u64) -> f64 {
    let (random, cells) = (CounterRng::new(seed), count as f64);
    let (x, y) = (u * cells, v * cells);
    let (i, j) = (x.floor(), y.floor());
    let at = |across: f64, down: f64| {
        let [i, j] = [i + across, j + down].map(|index| index.rem_euclid(cells) as u64);
        random.unit(i, j, 0)
    };
    let ease = |t: f64| t * t * (3.0 - 2.0 * t);
    let (a, b) = (ease(x - i), ease(y - j));
    let row = |down: f64| (1.0 - a) * at(0.0, down) + a * at(1.0, down);
    (1.0 - b) * row(0.0) + b * row(1.0)
}

/// 5 x 5 hemispheres of random sizes, slightly displaced from a grid.
fn bumps(place: [f64; 2]) -> Place {
    const COUNT: u64 = 5;
    let random = CounterRng::new(7);
    let mut height = 0.0_f64;
    for bump in 0..COUNT * COUNT {
        let chance = |dimension: u64| random.unit(bump, 0, dimension);
        let center = [bump % COUNT, bump / COUNT].map(|at| (at as f64 + 0.5) / COUNT as f64);
        let center = [0, 1].map(|axis: usize| center[axis] + 0.05 * (chance(axis as u64) - 0.5));
        let radius = 0.07 + 0.035 * chance(2);
        let [x, y] = [0, 1].map(|axis: usize| around(place[axis], center[axis]));
        let square = radius * radius - x * x - y * y;
        if square > 0.0 {
            height = height.max(square.sqrt());
        }
    }
    Place { height: height + 0.004 * noise(place, 32, 8), material: 0, turns: 0.0 }
}

/// Two rings in each direction, tilted alternately, on two shifted grids: each ring passes through its four neighbors.
fn mail(place: [f64; 2]) -> Place {
    const RADIUS: f64 = 0.2;
    const WIRE: f64 = 0.035;
    const TILT: f64 = 0.3;
    let mut found = Place { height: -0.09, material: 0, turns: 0.0 };
    for ring in 0..8 {
        // Rings of one grid lean one way; rings of the other grid, shifted by half a ring, lean the other way.
        let (grid, at) = (ring / 4, ring % 4);
        let shift = 0.25 * f64::from(grid);
        let center = [f64::from(at % 2) * 0.5 + shift, f64::from(at / 2) * 0.5 + shift];
        let [x, y] = [0, 1].map(|axis: usize| around(place[axis], center[axis]));
        let from_center = (x * x + y * y).sqrt();
        let off = from_center - RADIUS;
        let square = WIRE * WIRE - off * off;
        if square > 0.0 {
            let lean = if grid == 0 { TILT } else { -TILT };
            let height = square.sqrt() + lean * x;
            if height > found.height {
                // The tangent follows the wire, perpendicular to the direction from the ring's center.
                let turns = atan2(x, -y) / std::f64::consts::TAU;
                found = Place { height, material: 1, turns };
            }
        }
    }
    found
}

/// Height profile of a rounded block around the origin: 0 outside, 1 on top.
fn block([x, y]: [f64; 2], [width, depth]: [f64; 2], edge: f64) -> f64 {
    let inside = (width / 2.0 - x.abs()).min(depth / 2.0 - y.abs());
    let t = (inside / edge).clamp(0.0, 1.0);
    (t * (2.0 - t)).sqrt()
}

/// 4 x 4 square tiles of two colors.
fn tiles([u, v]: [f64; 2]) -> Place {
    let [i, j] = [u, v].map(|at| (at * 4.0).floor());
    let place = [u * 4.0 - i - 0.5, v * 4.0 - j - 0.5];
    let top = block(place, [0.92, 0.92], 0.05);
    let material = if top == 0.0 { 0 } else { 1 + u32::from((i + j).rem_euclid(2.0) == 0.0) };
    let grout = 0.002 * noise([u, v], 64, 9);
    Place { height: if material == 0 { grout } else { 0.01 + 0.02 * top }, material, turns: 0.0 }
}

/// Four courses of two bricks, every other one shifted by half a brick.
fn bricks([u, v]: [f64; 2]) -> Place {
    let course = (v * 4.0).floor();
    let shift = if course.rem_euclid(2.0) == 0.0 { 0.0 } else { 0.5 };
    let along = (u * 2.0 + shift).rem_euclid(2.0);
    let brick = along.floor();
    let place = [(along - brick - 0.5) / 2.0, (v * 4.0 - course - 0.5) / 4.0];
    let top = block(place, [0.47, 0.22], 0.012);
    let random = CounterRng::new(11);
    let chance = |dimension| random.unit(course as u64, brick as u64, dimension);
    let rough = 0.012 * noise([u, v], 48, 12) + 0.004 * noise([u, v], 24, 13);
    if top == 0.0 {
        return Place { height: rough, material: 0, turns: 0.0 };
    }
    let material = 1 + (3.0 * chance(0)) as u32;
    Place { height: 0.012 + 0.03 * top + 0.008 * chance(1) + rough, material: material.min(3), turns: 0.0 }
}

/// Four threads in each direction, alternately over and under.
fn weave([u, v]: [f64; 2]) -> Place {
    const THREADS: f64 = 4.0;
    let [i, j] = [u, v].map(|at| (at * THREADS).floor());
    let [x, y] = [u * THREADS - i - 0.5, v * THREADS - j - 0.5];
    let round = |across: f64| {
        let square = 0.45 * 0.45 - across * across;
        (square > 0.0).then(|| square.sqrt())
    };
    // Each thread is up where the other is down.
    let sign = if (i + j).rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
    let wave = |along: f64| on_circle(along / 2.0)[0];
    let warp = round(y).map(|top| top + 0.25 * sign * wave(x));
    let weft = round(x).map(|top| top - 0.25 * sign * wave(y));
    let floor = -0.35;
    let (height, material, turns) = match (warp, weft) {
        (Some(warp), Some(weft)) if warp >= weft => (warp, 0, 0.0),
        (_, Some(weft)) => (weft, 1, 0.25),
        (Some(warp), None) => (warp, 0, 0.0),
        (None, None) => (floor, 0, 0.0),
    };
    Place { height: height.max(floor) / THREADS * 0.5, material, turns }
}
