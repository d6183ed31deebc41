//! Bodies composed of smoothly blended rounded pieces, and their surfaces.
//!
//! A body is the set of points where a function is negative. Marching tetrahedra (six per grid cell: Doi, Koide 1991)
//! give a surface that is closed for any function. The surface is coarsened to the requested number of vertices, and
//! the vertices are moved onto the zeros of the function.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;

use super::resample::ClosedSurface;
use crate::elementary::{atan2, sin_cos};

/// Minimum number of cells along an edge of the box: they resolve the thinnest pieces, and measure a body's surface.
const FIRST_CELLS: f64 = 64.0;
/// Vertices of the grid's surface per vertex of the result, because most triangles from tetrahedra are slivers.
const SURPLUS: f64 = 2.2;
/// Number of steps that move vertices onto the surface, and the step of finite differences for the gradient.
const STEPS: usize = 3;
const DIFFERENCE: f64 = 1e-4;

#[derive(Clone, Copy, Debug)]
pub(super) enum RoundedPiece {
    /// Ellipsoid: center and radii.
    Ball([f64; 3], [f64; 3]),
    /// Line with a radius at each end.
    Limb([f64; 3], [f64; 3], [f64; 2]),
    /// Upright cylinder with round edges: center, then radius, half of the height, and the edges' radius.
    Drum([f64; 3], [f64; 3]),
    /// Horizontal torus: center, then major and minor radius.
    Ring([f64; 3], [f64; 2]),
}

impl RoundedPiece {
    /// Approximate signed distance from the piece, negative inside.
    fn distance(self, at: DVec3) -> f64 {
        match self {
            Self::Ball(center, radii) => {
                let (from, radii) = (at - DVec3::from(center), DVec3::from(radii));
                let [scaled, steep] = [(from / radii).length(), (from / (radii * radii)).length()];
                if steep > 0.0 { scaled * (scaled - 1.0) / steep } else { -radii.min_element() }
            }
            Self::Limb(from, to, radii) => {
                let (along, at) = (DVec3::from(to) - DVec3::from(from), at - DVec3::from(from));
                let part = (at.dot(along) / along.length_squared()).clamp(0.0, 1.0);
                (at - part * along).length() - (radii[0] + part * (radii[1] - radii[0]))
            }
            Self::Drum(center, [radius, half, round]) => {
                let from = at - DVec3::from(center);
                let [out, up] = [from.truncate().length() - radius + round, from.z.abs() - half + round];
                let [beside, above] = [out.max(0.0), up.max(0.0)];
                out.max(up).min(0.0) + (beside * beside + above * above).sqrt() - round
            }
            Self::Ring(center, [radius, section]) => {
                let from = at - DVec3::from(center);
                let out = from.truncate().length() - radius;
                (out * out + from.z * from.z).sqrt() - section
            }
        }
    }
}

/// Folds around the vertical axis: `count` folds, up to `depth` deep, between two heights. `twist` is the rotation per
/// unit of height, in periods of the pattern.
#[derive(Clone, Copy, Debug)]
pub(super) struct Folds {
    pub(super) count: f64,
    pub(super) depth: f64,
    pub(super) twist: f64,
    pub(super) heights: [f64; 2],
}

impl Folds {
    fn depth_at(&self, at: DVec3) -> f64 {
        let [low, high] = self.heights;
        let within = ((at.z - low) / (high - low)).clamp(0.0, 1.0);
        let turns = self.count * atan2(at.y, at.x) / std::f64::consts::TAU + self.twist * at.z;
        4.0 * within * (1.0 - within) * self.depth * sin_cos(std::f64::consts::TAU * turns).0
    }
}

#[derive(Clone, Copy, Debug)]
enum BodyStep {
    /// Adds a piece, with the width of its blend into the body.
    Add(RoundedPiece, f64),
    /// Removes a piece, with the width of the blend.
    Carve(RoundedPiece, f64),
    Fold(Folds),
}

/// Body under construction; later pieces cover earlier folds and carvings.
#[derive(Clone, Debug, Default)]
pub(super) struct RoundedBody {
    /// Steps, with `true` if the step is repeated mirrored at x = 0.
    steps: Vec<(BodyStep, bool)>,
}

impl RoundedBody {
    pub(super) fn add(&mut self, piece: RoundedPiece, width: f64) {
        self.steps.push((BodyStep::Add(piece, width), false));
    }

    /// Adds a piece at positive x, and its mirror image.
    pub(super) fn add_both(&mut self, piece: RoundedPiece, width: f64) {
        self.steps.push((BodyStep::Add(piece, width), true));
    }

    /// Removes a piece.
    pub(super) fn carve(&mut self, piece: RoundedPiece, width: f64) {
        self.steps.push((BodyStep::Carve(piece, width), false));
    }

    /// Removes a piece at positive x, and its mirror image.
    pub(super) fn carve_both(&mut self, piece: RoundedPiece, width: f64) {
        self.steps.push((BodyStep::Carve(piece, width), true));
    }

    /// Folds the body.
    pub(super) fn fold(&mut self, folds: Folds) {
        self.steps.push((BodyStep::Fold(folds), false));
    }

    /// Approximate signed distance from the body, negative inside.
    fn distance(&self, at: DVec3) -> f64 {
        let aside = DVec3::new(at.x.abs(), at.y, at.z);
        self.steps.iter().fold(f64::MAX, |before, (step, both)| {
            let at = if *both { aside } else { at };
            match step {
                BodyStep::Add(piece, width) => smooth_min(before, piece.distance(at), *width),
                BodyStep::Carve(piece, width) => -smooth_min(-before, piece.distance(at), *width),
                BodyStep::Fold(folds) => before + folds.depth_at(at),
            }
        })
    }

    /// The body's surface with `vertices` vertices; the body lies inside a cube of half edge `half` around the origin.
    pub(super) fn surface(&self, half: f64, vertices: usize) -> ClosedSurface {
        let first = 2.0 * half / FIRST_CELLS;
        let found = self.cut(half, first).outermost();
        let cell = first * (found.positions.len() as f64 / (SURPLUS * vertices as f64)).sqrt();
        let fine = if cell < first { self.cut(half, cell).outermost() } else { found };
        let mut surface = fine.resampled(vertices);
        surface.positions.par_iter_mut().for_each(|at| *at = self.settled(*at, cell.min(first)));
        surface
    }

    /// Moves a point onto the surface, by at most about a cell.
    fn settled(&self, mut at: DVec3, cell: f64) -> DVec3 {
        for _ in 0..STEPS {
            let value = self.distance(at);
            let slope = DVec3::AXES.map(|axis| self.distance(at + DIFFERENCE * axis) - value);
            let slope = DVec3::from(slope) / DIFFERENCE;
            let step = value * slope / slope.length_squared().max(0.1);
            at -= step.clamp_length_max(cell);
        }
        at
    }

    fn cut(&self, half: f64, cell: f64) -> ClosedSurface {
        let side = (2.0 * half / cell).ceil() as usize + 1;
        let corner = |index: usize| {
            let counts = [index % side, index / side % side, index / side / side];
            DVec3::from(counts.map(|count| count as f64 * cell - half))
        };
        let values: Vec<f64> = (0..side * side * side).into_par_iter().map(|at| self.distance(corner(at))).collect();
        let mut cut = Cut { values: &values, corner: &corner, found: ClosedSurface::default(), known: BTreeMap::new() };
        let steps = [1, side, side * side];
        for index in 0..side * side * (side - 1) {
            let [x, y] = [index % side, index / side % side];
            if x + 1 < side && y + 1 < side {
                cut.cube(index, steps);
            }
        }
        cut.found
    }
}

/// Minimum that is smoothed where its arguments differ by less than `width` (Quilez 2013, "Smooth minimum").
fn smooth_min(one: f64, other: f64, width: f64) -> f64 {
    let near = (width - (one - other).abs()).max(0.0);
    one.min(other) - if width > 0.0 { near * near / (4.0 * width) } else { 0.0 }
}

/// Paths along the edges of a cube from its first corner to its last: all orders of the axes, one per tetrahedron.
const PATHS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// Isosurface of a grid of values, under construction.
struct Cut<'a> {
    values: &'a [f64],
    corner: &'a dyn Fn(usize) -> DVec3,
    found: ClosedSurface,
    /// Vertices by the ends of the grid's edges.
    known: BTreeMap<[usize; 2], u32>,
}

impl Cut<'_> {
    fn is_inside(&self, at: usize) -> bool {
        self.values[at] < 0.0
    }

    fn cube(&mut self, first: usize, steps: [usize; 3]) {
        let last = first + steps.iter().sum::<usize>();
        let corners =
            (0..8).map(|bits| first + (0..3).filter(|axis| bits >> axis & 1 == 1).map(|a| steps[a]).sum::<usize>());
        let inside = corners.filter(|&at| self.is_inside(at)).count();
        if inside == 0 || inside == 8 {
            return;
        }
        for [a, b, _] in PATHS {
            self.tetrahedron([first, first + steps[a], first + steps[a] + steps[b], last]);
        }
    }

    fn tetrahedron(&mut self, corners: [usize; 4]) {
        let (inside, outside): (Vec<usize>, Vec<usize>) = corners.into_iter().partition(|&at| self.is_inside(at));
        let sum = |all: &[usize]| all.iter().map(|&at| (self.corner)(at)).sum::<DVec3>() / all.len() as f64;
        let toward = if inside.is_empty() || outside.is_empty() { return } else { sum(&outside) - sum(&inside) };
        let middle = |ends: [usize; 2]| 0.5 * ((self.corner)(ends[0]) + (self.corner)(ends[1]));
        let ring: Vec<[usize; 2]> = match (&inside[..], &outside[..]) {
            ([a], rest) | (rest, [a]) => rest.iter().map(|&at| [at, *a]).collect(),
            (&[a, b], &[c, d]) => vec![[a, c], [a, d], [b, d], [b, c]],
            _ => return,
        };
        let [p, q, r] = [0, 1, 2].map(|at| middle(ring[at]));
        let front = (q - p).cross(r - p).dot(toward) > 0.0;
        let mut ring: Vec<u32> = ring.into_iter().map(|ends| self.vertex(ends)).collect();
        if !front {
            ring.reverse();
        }
        for at in 2..ring.len() {
            self.found.triangles.push([ring[0], ring[at - 1], ring[at]]);
        }
    }

    /// Vertex where the surface cuts an edge of the grid, a little away from its ends.
    fn vertex(&mut self, [a, b]: [usize; 2]) -> u32 {
        let ends = [a.min(b), a.max(b)];
        *self.known.entry(ends).or_insert_with(|| {
            let [low, high] = ends.map(|at| self.values[at]);
            let part = (low / (low - high)).clamp(0.02, 0.98);
            let [from, to] = ends.map(self.corner);
            self.found.positions.push(from + part * (to - from));
            self.found.positions.len() as u32 - 1
        })
    }
}
