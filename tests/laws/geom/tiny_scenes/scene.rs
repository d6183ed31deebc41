//! Tiny numbered scenes: at most a dozen triangles each, with the special cases of an intersector.

use crossbar::geom::random::CounterRng;
use crossbar::geom::{Mesh, Ray, Sides};

/// Number of rays of a scene.
const RAYS: usize = 16;

/// A mesh of 1 to 12 triangles, and rays that are hard for it.
pub(crate) struct Scene {
    pub(crate) mesh: Mesh,
    pub(crate) rays: Vec<Ray>,
    pub(crate) sides: Sides,
    /// True if all coordinates, including ray origins, have the same moderate size: products neither overflow nor
    /// underflow in f32.
    pub(crate) moderate: bool,
}

/// Consecutive random numbers for one scene.
struct Dice {
    stream: CounterRng,
    scene: u64,
    throws: u64,
}

impl Dice {
    fn bits(&mut self) -> u64 {
        self.throws += 1;
        self.stream.bits(self.scene, self.throws, 0)
    }

    fn below(&mut self, sides: usize) -> usize {
        (self.bits() % sides as u64) as usize
    }

    fn one_of<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.below(values.len())]
    }

    fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / 16_777_216.0
    }

    fn vector(&mut self, mut component: impl FnMut(&mut Self) -> f32) -> [f32; 3] {
        [component(self), component(self), component(self)]
    }
}

/// The kind of coordinates in a scene.
#[derive(Clone, Copy, PartialEq)]
enum Coordinates {
    /// Few values, so that triangles are degenerate or coplanar, share corners, and lie in planes of octree cells.
    Grid,
    Free,
    /// A mixture of both.
    Mixed,
}

fn coordinate(dice: &mut Dice, kind: Coordinates) -> f32 {
    let grid = kind == Coordinates::Grid || (kind == Coordinates::Mixed && dice.below(2) == 0);
    if grid { (dice.below(9) as f32 - 4.0) / 4.0 } else { 2.0 * dice.unit() - 1.0 }
}

impl Scene {
    pub(crate) fn new(number: u64) -> Self {
        let mut dice = Dice { stream: CounterRng::new(2002), scene: number, throws: 0 };
        let kind = dice.one_of(&[Coordinates::Grid, Coordinates::Grid, Coordinates::Free, Coordinates::Mixed]);
        // Coordinate scales: mostly 1, sometimes tiny or huge, sometimes mixed within the scene.
        let scales: &[f32] = match dice.below(8) {
            0 => &[1e-30],
            1 => &[1e30],
            2 => &[1e-6, 1.0, 1e6],
            3 => &[1e-30, 1.0],
            4 => &[1e-12, 1e12],
            _ => &[1.0],
        };
        let offset = if dice.below(6) == 0 { dice.one_of(&[1e3f32, 1e5, 1e7]) } else { 0.0 };
        let mut positions = Vec::new();
        let count = 1 + dice.below(12);
        let mut triangles = Vec::new();
        for _ in 0..count {
            let scale = dice.one_of(scales);
            triangles.push(triangle(&mut dice, kind, scale, offset, &mut positions));
        }
        let mesh = Mesh::new(positions, triangles).expect("finite corners and indices in range");
        let rays = (0..RAYS).filter_map(|_| ray(&mut dice, kind, scales, offset, &mesh)).collect();
        let sides = if dice.below(2) == 0 { Sides::Front } else { Sides::Both };
        Self { mesh, rays, sides, moderate: scales == [1.0] }
    }
}

/// A triangle with new corners, corners of other triangles, a copy of another triangle (with either winding), or a
/// needle.
fn triangle(dice: &mut Dice, kind: Coordinates, scale: f32, offset: f32, positions: &mut Vec<[f32; 3]>) -> [u32; 3] {
    let first = positions.len() as u32;
    let mut fresh = |dice: &mut Dice| {
        let position = dice.vector(|dice| offset + scale * coordinate(dice, kind));
        positions.push(position);
        (positions.len() - 1) as u32
    };
    let old = |dice: &mut Dice| dice.below(first.max(1) as usize) as u32;
    match dice.below(8) {
        // Shares an edge, or a corner.
        0 | 1 if first > 1 => [old(dice), old(dice), fresh(dice)],
        2 if first > 1 => [old(dice), fresh(dice), fresh(dice)],
        // A copy, or degenerate.
        3 if first > 2 => [old(dice), old(dice), old(dice)],
        // A needle: two corners next to each other.
        4 => {
            let (a, b) = (fresh(dice), fresh(dice));
            let near = positions[b as usize].map(|x| f32::from_bits(x.to_bits() ^ 1));
            positions.push(near);
            [a, b, b + 1]
        }
        // In a plane of constant x, y or z.
        5 => {
            let all = [fresh(dice), fresh(dice), fresh(dice)];
            let axis = dice.below(3);
            let level = positions[all[0] as usize][axis];
            for id in all {
                positions[id as usize][axis] = level;
            }
            all
        }
        _ => [fresh(dice), fresh(dice), fresh(dice)],
    }
}

/// A point of a triangle: a corner, a point on an edge, or a point inside, up to the rounding of f32.
fn point(dice: &mut Dice, mesh: &Mesh) -> [f32; 3] {
    let id = dice.below(mesh.len()) as u32;
    let [a, b, c] = mesh.corners(id).expect("a triangle of the mesh");
    match dice.below(4) {
        0 => a,
        1 => mix(a, b, 0.5),
        2 => mix(a, b, dice.unit()),
        _ => mix(mix(a, b, dice.unit()), c, dice.unit()),
    }
}

fn mix(a: [f32; 3], b: [f32; 3], share: f32) -> [f32; 3] {
    [0, 1, 2].map(|axis| a[axis] * (1.0 - share) + b[axis] * share)
}

fn ray(dice: &mut Dice, kind: Coordinates, scales: &[f32], offset: f32, mesh: &Mesh) -> Option<Ray> {
    let target = point(dice, mesh);
    let zero = |dice: &mut Dice| dice.one_of(&[0.0f32, -0.0]);
    let reach = 3.0 * dice.one_of(scales);
    let outside = |dice: &mut Dice| dice.vector(|dice| offset + reach * coordinate(dice, kind));
    let direction = match dice.below(8) {
        // Along an axis.
        0 | 1 => {
            let mut direction = dice.vector(zero);
            direction[dice.below(3)] = dice.one_of(&[1.0f32, -1.0, 0.5, 1e-3]);
            direction
        }
        // In the plane of two axes.
        2 => {
            let mut direction = dice.vector(|dice| dice.one_of(&[1.0f32, -1.0, 0.5]));
            direction[dice.below(3)] = zero(dice);
            direction
        }
        3 => dice.vector(|dice| coordinate(dice, kind)),
        // Along an edge of a triangle, and so in its plane.
        4 => {
            let [a, b, _] = mesh.corners(dice.below(mesh.len()) as u32)?;
            [0, 1, 2].map(|axis| b[axis] - a[axis])
        }
        // From a point outside to the target.
        _ => {
            let origin = outside(dice);
            return Ray::new(origin, [0, 1, 2].map(|axis| target[axis] - origin[axis])).ok();
        }
    };
    let origin = match dice.below(3) {
        // On the surface.
        0 => target,
        // Back from it.
        1 => [0, 1, 2].map(|axis| target[axis] - reach * direction[axis]),
        _ => outside(dice),
    };
    Ray::new(origin, direction).ok()
}
