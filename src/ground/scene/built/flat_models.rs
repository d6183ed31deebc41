//! A chair and a temple with the vertex counts of the models with several textures in the paper on bi-scale transfer
//! (its Table I). The original models are not available. The temple has no interior, to match the paper's large number
//! of non-zero values per vertex; so our counts of these values are not evidence.
//!
//! Parts are flat or curved faces and tubes; each is a grid of triangles with its own normals. Texture coordinates are
//! lengths along the edges of a face. Where a tube closes, vertices are repeated; they have the same position, normal
//! and tangent and are counted once. The chair is 1 unit high, the temple 2.4 units wide.

use std::collections::BTreeSet;

use glam::DVec3;

use super::super::Material;
use super::grid::{grid_triangles, with_attributes};
use crate::elementary::on_circle;
use crate::geom::Mesh;
use crate::geom::vector::{least_axis, narrow, unit};

/// Model composed of parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FlatModel {
    /// A chair with round legs, arms and cushions: 16,101 vertices; frame, seat, back.
    Chair,
    /// A temple on steps, with round pillars around a chamber: 32,409 vertices; steps, pillars, walls, eaves, roof.
    Temple,
}

/// Mesh with a material per triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialMesh {
    /// Mesh, with normals and texture coordinates.
    pub mesh: Mesh,
    /// The mesh's materials.
    pub materials: Vec<Material>,
    /// Index of each triangle's material.
    pub material_of: Vec<u32>,
}

impl FlatModel {
    /// Builds the model. `coarser` 1 gives the paper's number of vertices; larger values, up to 16, lengthen edges by
    /// about that factor.
    pub fn model(self, coarser: u32) -> MaterialMesh {
        let coarser = coarser.clamp(1, 16);
        let (vertices, build, materials): (u32, fn(&mut FlatParts), &[Paint]) = match self {
            Self::Chair => {
                (16_101, chair, &[("frame", [0.45, 0.3, 0.2]), ("seat", [0.5, 0.2, 0.2]), ("back", [0.4, 0.35, 0.2])])
            }
            Self::Temple => (
                32_409,
                temple,
                &[
                    ("steps", [0.55, 0.52, 0.48]),
                    ("pillars", [0.6, 0.58, 0.55]),
                    ("walls", [0.5, 0.3, 0.22]),
                    ("eaves", [0.45, 0.42, 0.3]),
                    ("roof", [0.35, 0.2, 0.15]),
                ],
            ),
        };
        let wanted = (vertices / (coarser * coarser)) as usize;
        let mut parts = FlatParts::finest(wanted, build);
        parts.divide_largest(wanted.saturating_sub(parts.distinct_vertices()));
        let FlatParts { positions, normals, texture, triangles, material_of, .. } = parts;
        let mesh = with_attributes(positions, triangles, normals, texture);
        let materials = materials.iter().map(|&(name, albedo)| Material::diffuse(name, albedo)).collect();
        MaterialMesh { mesh, materials, material_of }
    }
}

type Paint = (&'static str, [f32; 3]);

#[derive(Clone, Debug, Default)]
struct FlatParts {
    /// Target edge length.
    edge: f64,
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    texture: Vec<[f32; 2]>,
    triangles: Vec<[u32; 3]>,
    material_of: Vec<u32>,
    /// Number of vertices that repeat others where tubes close.
    repeated: usize,
}

impl FlatParts {
    fn distinct_vertices(&self) -> usize {
        let key = |at: u32, material: u32| {
            let of = |vectors: &[[f32; 3]]| vectors[at as usize].map(|component| (component + 0.0).to_bits());
            (of(&self.positions), of(&self.normals), material)
        };
        let corners = self.triangles.iter().zip(&self.material_of);
        corners.flat_map(|(corners, &material)| corners.map(|at| key(at, material))).collect::<BTreeSet<_>>().len()
    }

    /// Builds the parts with the shortest edges that give at most this many vertices, without counting repeated
    /// vertices; edge lengths are tried from the longest in steps of one percent.
    fn finest(vertices: usize, build: fn(&mut Self)) -> Self {
        let of = |edge: f64| {
            let mut parts = Self { edge, ..Self::default() };
            build(&mut parts);
            parts
        };
        let mut best = of(1.0);
        loop {
            let next = of(best.edge / 1.01);
            if next.positions.len() - next.repeated > vertices {
                return best;
            }
            best = next;
        }
    }

    /// Inserts a vertex into the middle of each of the `count` largest triangles; on ties, the first are chosen.
    fn divide_largest(&mut self, count: usize) {
        let area = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|corner| DVec3::from(self.positions[corner as usize].map(f64::from)));
            (b - a).cross(c - a).length()
        };
        let areas: Vec<f64> = self.triangles.iter().map(area).collect();
        let mut largest: Vec<usize> = (0..areas.len()).collect();
        largest.sort_by(|&one, &other| areas[other].total_cmp(&areas[one]));
        for at in largest.into_iter().take(count) {
            let [a, b, c] = self.triangles[at];
            let middle = self.positions.len() as u32;
            let corners = [a, b, c].map(|corner| corner as usize);
            let mean =
                |of: &dyn Fn(usize) -> f32| (corners.iter().map(|&at| f64::from(of(at))).sum::<f64>() / 3.0) as f32;
            self.positions.push([0, 1, 2].map(|axis: usize| mean(&|at| self.positions[at][axis])));
            self.texture.push([0, 1].map(|axis: usize| mean(&|at| self.texture[at][axis])));
            self.normals.push(self.normals[corners[0]]);
            self.triangles[at] = [a, b, middle];
            for triangle in [[b, c, middle], [c, a, middle]] {
                self.triangles.push(triangle);
                self.material_of.push(self.material_of[at]);
            }
        }
    }

    /// Adds a parallelogram given by a corner and its two sides; `across` x `along` points out of the front.
    fn face(&mut self, corner: DVec3, across: DVec3, along: DVec3, material: u32) {
        self.trapezoid(corner, [across, across], along, material);
    }

    /// Like [`Self::face`], for a trapezoid whose upper side is at most as long as the lower one and centred above it.
    fn trapezoid(&mut self, corner: DVec3, [lower, upper]: [DVec3; 2], along: DVec3, material: u32) {
        let normal = unit(lower.cross(along)).unwrap_or(DVec3::Z);
        let counts = [self.parts(lower.length(), 1), self.parts(along.length(), 1)];
        self.grid(counts, material, &|right, up| {
            let side = lower + up * (upper - lower);
            let u = 0.5 * lower.length() + (right - 0.5) * side.length();
            (corner + up * (along + 0.5 * (lower - upper)) + right * side, normal, [u, up * along.length()])
        });
    }

    /// Like [`Self::face`], bent out of its plane: `bend` maps the fractions along both sides to a distance.
    fn bent(&mut self, corner: DVec3, [across, along]: [DVec3; 2], material: u32, bend: &dyn Fn(f64, f64) -> f64) {
        const STEP: f64 = 1e-3;
        let out = unit(across.cross(along)).unwrap_or(DVec3::Z);
        let counts = [self.parts(across.length(), 2), self.parts(along.length(), 2)];
        self.grid(counts, material, &|right, up| {
            let slope = |[x, y]: [f64; 2]| (bend(right + x, up + y) - bend(right - x, up - y)) / (2.0 * STEP);
            let normal = (across + slope([STEP, 0.0]) * out).cross(along + slope([0.0, STEP]) * out);
            let at = corner + right * across + up * along + bend(right, up) * out;
            (at, unit(normal).unwrap_or(out), [right * across.length(), up * along.length()])
        });
    }

    /// Adds the side of a round tube, without its ends, with a radius at each end.
    fn tube(&mut self, from: DVec3, to: DVec3, radii: [f64; 2], material: u32) {
        let axis = unit(to - from).unwrap_or(DVec3::Z);
        let x = unit(least_axis(axis).cross(axis)).unwrap_or(DVec3::X);
        let (y, length, round) = (axis.cross(x), from.distance(to), std::f64::consts::TAU * radii[0].max(radii[1]));
        let counts = [self.parts(round, 6), self.parts(length, 1)];
        self.repeated += counts[1] as usize + 1;
        self.grid(counts, material, &|around, up| {
            let [cos, sin] = on_circle(around.fract());
            let (out, radius) = (cos * x + sin * y, radii[0] + up * (radii[1] - radii[0]));
            let normal = length * out + (radii[0] - radii[1]) * axis;
            (from + up * length * axis + radius * out, unit(normal).unwrap_or(out), [around * round, up * length])
        });
    }

    /// Number of edges along a length, at least `least`.
    fn parts(&self, length: f64, least: u32) -> u32 {
        ((length / self.edge).round() as u32).max(least)
    }

    /// Adds a grid of triangles; a function maps the fractions along columns and rows to position, normal and texture
    /// coordinates.
    fn grid(
        &mut self,
        [columns, rows]: [u32; 2],
        material: u32,
        vertex: &dyn Fn(f64, f64) -> (DVec3, DVec3, [f64; 2]),
    ) {
        let first = self.positions.len() as u32;
        for (row, column) in (0..=rows).flat_map(|row| (0..=columns).map(move |column| (row, column))) {
            let (at, normal, texture) =
                vertex(f64::from(column) / f64::from(columns), f64::from(row) / f64::from(rows));
            self.positions.push(narrow(at));
            self.normals.push(narrow(normal));
            self.texture.push(texture.map(|length| length as f32));
        }
        self.triangles.extend(grid_triangles(first, [columns, rows]));
        self.material_of.resize(self.triangles.len(), material);
    }

    fn sides(&mut self, [x0, y0, z0]: [f64; 3], [x1, y1, z1]: [f64; 3], material: u32) {
        let at = DVec3::new;
        let (x, y, z) = (at(x1 - x0, 0.0, 0.0), at(0.0, y1 - y0, 0.0), at(0.0, 0.0, z1 - z0));
        self.face(at(x0, y1, z0), -y, z, material);
        self.face(at(x1, y0, z0), y, z, material);
        self.face(at(x0, y0, z0), x, z, material);
        self.face(at(x1, y1, z0), -x, z, material);
    }

    /// Adds a level frame around the origin between two rectangles, given by their half sides and heights; it faces up
    /// if the first rectangle is the outer one, else down.
    fn frame(&mut self, [from, to]: [[f64; 2]; 2], [low, high]: [f64; 2], material: u32) {
        let at = DVec3::new;
        for (turn, [near, side]) in [(0, [1, 0]), (1, [0, 1]), (2, [1, 0]), (3, [0, 1])] {
            let toward = |right: f64, back: f64| match turn {
                0 => at(right, -back, 0.0),
                1 => at(back, right, 0.0),
                2 => at(-right, back, 0.0),
                _ => at(-back, -right, 0.0),
            };
            let up = at(0.0, 0.0, high - low);
            let (lower, upper) = (toward(2.0 * from[side], 0.0), toward(2.0 * to[side], 0.0));
            let corner = toward(-from[side], from[near]) + at(0.0, 0.0, low);
            self.trapezoid(corner, [lower, upper], toward(0.0, to[near] - from[near]) + up, material);
        }
    }

    fn block(&mut self, low: [f64; 3], high: [f64; 3], material: u32) {
        self.sides(low, high, material);
        let ([x0, y0, z0], at) = (low, DVec3::new);
        let (x, y) = (at(high[0] - x0, 0.0, 0.0), at(0.0, high[1] - y0, 0.0));
        self.face(at(x0, high[1], z0), x, -y, material);
        self.face(at(x0, y0, high[2]), x, y, material);
    }
}

/// Overlap of adjoining parts, so that no two faces share an edge.
const SUNK: f64 = 0.001;

/// Bend of a cushion as a function of the fractions along its sides: up to `height` in the middle.
fn cushion(height: f64) -> impl Fn(f64, f64) -> f64 {
    move |right, up| 16.0 * height * right * (1.0 - right) * up * (1.0 - up)
}

/// Adds a chair of 0.5 x 0.5, 1 high, that faces -y: round legs, arms and rails, a seat and a bent back with cushions.
fn chair(parts: &mut FlatParts) {
    let [frame, seat, back] = [0, 1, 2];
    let at = DVec3::new;
    for x in [-0.225, 0.225] {
        parts.tube(at(x, -0.225, 0.0), at(x, -0.225, 0.64), [0.02, 0.028], frame);
        parts.tube(at(1.1 * x, 0.25, 0.0), at(x, 0.215, 0.4), [0.02, 0.028], frame);
        parts.tube(at(x, 0.215, 0.4), at(x, 0.26, 1.0), [0.028, 0.02], frame);
        parts.tube(at(x, -0.2, 0.2), at(x, 0.2, 0.2), [0.015, 0.015], frame);
        // Arms with a bent upper side.
        parts.sides([x - 0.04, -0.27, 0.64], [x + 0.04, 0.2, 0.66], frame);
        parts.face(at(x - 0.04, 0.2, 0.64), at(0.08, 0.0, 0.0), at(0.0, -0.47, 0.0), frame);
        let sides = [at(0.08, 0.0, 0.0), at(0.0, 0.47, 0.0)];
        parts.bent(at(x - 0.04, -0.27, 0.66), sides, frame, &|right, _| 0.06 * right * (1.0 - right));
    }
    parts.tube(at(-0.22, -0.225, 0.3), at(0.22, -0.225, 0.3), [0.015, 0.015], frame);
    parts.tube(at(-0.225, 0.26, 0.98), at(0.225, 0.26, 0.98), [0.022, 0.022], frame);
    parts.block([-0.25, -0.25, 0.38], [0.25, 0.2, 0.42], frame);
    parts.sides([-0.23, -0.24, 0.42 + SUNK], [0.23, 0.19, 0.45], seat);
    parts.bent(at(-0.23, -0.24, 0.45), [at(0.46, 0.0, 0.0), at(0.0, 0.43, 0.0)], seat, &cushion(0.05));
    // The back: a bent sheet, its rear, and a cushion before it.
    let (right, up) = (at(0.4, 0.0, 0.0), at(0.0, 0.035, 0.44));
    let hollow = |right: f64, _: f64| -0.16 * right * (1.0 - right);
    parts.bent(at(-0.2, 0.22, 0.52), [right, up], back, &hollow);
    parts.bent(at(0.2, 0.235, 0.52), [-right, up], back, &|right, up| -hollow(right, up));
    let pad = cushion(0.07);
    parts.bent(at(-0.17, 0.2, 0.55), [0.85 * right, 0.85 * up], back, &|x, y| pad(x, y) + hollow(x, y));
}

/// Adds a temple with six pillars along its front and eight along each side, as it is seen from outside.
fn temple(parts: &mut FlatParts) {
    let [steps, pillars, walls, eaves, roof] = [0, 1, 2, 3, 4];
    let at = DVec3::new;
    let chamber = [0.6, 0.95];
    parts.face(at(-1.28, 1.68, 0.0), at(2.56, 0.0, 0.0), at(0.0, -3.36, 0.0), steps);
    for step in 0..3 {
        let (inset, height) = (0.08 * f64::from(step), 0.06 * f64::from(step));
        let [width, depth] = [1.28 - inset, 1.68 - inset];
        parts.sides([-width, -depth, height], [width, depth, height + 0.06], steps);
        let inner = if step < 2 { [width - 0.08 + SUNK, depth - 0.08 + SUNK] } else { chamber };
        parts.frame([[width, depth], inner], [height + 0.06 - SUNK * SUNK; 2], steps);
    }
    let (base, top) = (0.18, 0.98);
    for (across, along) in (0..6).flat_map(|across| (0..8).map(move |along| (across, along))) {
        if (1..5).contains(&across) && (1..7).contains(&along) {
            continue;
        }
        let (x, y) = (-0.95 + 0.38 * f64::from(across), -1.35 + 2.7 / 7.0 * f64::from(along));
        let mut drum = |[low, high]: [f64; 2], radii| parts.tube(at(x, y, low), at(x, y, high), radii, pillars);
        drum([base, base + 0.06], [0.09, 0.07]);
        drum([base + 0.06 + SUNK, top - 0.06 - SUNK], [0.065, 0.052]);
        drum([top - 0.06, top], [0.055, 0.09]);
    }
    let [width, depth] = chamber;
    parts.sides([-width, -depth, base + SUNK], [width, depth, top - SUNK], walls);
    let [width, depth] = [1.12, 1.52];
    parts.frame([[width - 0.9, depth - 0.9], [width, depth]], [top; 2], eaves);
    parts.sides([-width, -depth, top], [width, depth, top + 0.12], eaves);
    // The roof: two bent slopes and two gables over the eaves.
    let (foot, ridge, width, depth) = (top + 0.12 + SUNK, top + 0.6, 1.26, 1.66);
    let (up, along) = (ridge - foot, at(0.0, 2.0 * depth, 0.0));
    let sag = |_: f64, up: f64| -0.3 * up * (1.0 - up);
    parts.bent(at(width, -depth, foot), [along, at(-width, 0.0, up)], roof, &sag);
    parts.bent(at(-width, depth, foot), [-along, at(width, 0.0, up)], roof, &sag);
    let under = |right: f64, up: f64| -sag(right, up);
    parts.bent(at(width, depth, foot - 0.03), [-along, at(-width, 0.0, up)], eaves, &under);
    parts.bent(at(-width, -depth, foot - 0.03), [along, at(width, 0.0, up)], eaves, &under);
    let (across, inner) = (at(2.0 * width, 0.0, 0.0), depth - 0.1);
    parts.trapezoid(at(-width, -inner, foot), [across, 0.001 * across], at(0.0, 0.0, up - 0.02), eaves);
    parts.trapezoid(at(width, inner, foot), [-across, -0.001 * across], at(0.0, 0.0, up - 0.02), eaves);
}
