//! Models of flat parts with the vertex counts of the models with several textures in the paper on bi-scale transfer
//! (its Table I): a chair and a temple. The original models are not available.
//!
//! Parts are blocks, walls and roofs, of which every face is a grid of triangles with its own normal. Texture
//! coordinates are lengths, 1 per unit, along the edges of a face. Units are those of the models: the chair is 1 high,
//! the temple 2.4 wide.

use glam::DVec3;

use super::super::Material;
use crate::geom::Mesh;
use crate::geom::vector::{narrow, unit};

/// Model of flat parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FlatModel {
    /// A chair with arms: 16,101 vertices; frame, seat, back.
    Chair,
    /// A temple on steps, with pillars around a chamber: 32,409 vertices; steps, pillars, walls, eaves, roof.
    Temple,
}

/// Mesh with a material per triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialMesh {
    /// Mesh, with normals and texture coordinates.
    pub mesh: Mesh,
    /// Its materials.
    pub materials: Vec<Material>,
    /// Index of each triangle's material.
    pub material_of: Vec<u32>,
}

impl FlatModel {
    /// Builds the model with edges about `coarser` times as long: with 1, as many vertices as the paper's. Values above
    /// 16 count as 16.
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
        parts.divide_largest(wanted.saturating_sub(parts.positions.len()));
        let FlatParts { positions, normals, texture, triangles, material_of, .. } = parts;
        let mesh = Mesh::new(positions, triangles).and_then(|mesh| mesh.with_normals(normals));
        let mesh = mesh.and_then(|mesh| mesh.with_texcoords(texture)).expect("finite numbers, as many as vertices");
        let materials = materials.iter().map(|&(name, albedo)| Material::diffuse(name, albedo)).collect();
        MaterialMesh { mesh, materials, material_of }
    }
}

/// Name and reflectance of a material.
type Paint = (&'static str, [f32; 3]);

/// Builder of a model of flat parts.
#[derive(Clone, Debug, Default)]
struct FlatParts {
    /// Target edge length.
    edge: f64,
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    texture: Vec<[f32; 2]>,
    triangles: Vec<[u32; 3]>,
    material_of: Vec<u32>,
}

impl FlatParts {
    /// Builds the parts with the shortest edges that give at most this many vertices; edge lengths are tried in steps
    /// of a hundredth.
    fn finest(vertices: usize, build: fn(&mut Self)) -> Self {
        let mut edge = 0.005;
        loop {
            let mut parts = Self { edge, ..Self::default() };
            build(&mut parts);
            // The coarsest model has one quad per face.
            if parts.positions.len() <= vertices || edge > 10.0 {
                return parts;
            }
            edge *= 1.01;
        }
    }

    /// Inserts a vertex into the middle of each of the `count` largest triangles, the first of equals.
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

    /// Like [`Self::face`], with another upper side, as long or shorter, whose middle stands above the lower one's.
    fn trapezoid(&mut self, corner: DVec3, [lower, upper]: [DVec3; 2], along: DVec3, material: u32) {
        let parts = |side: DVec3| ((side.length() / self.edge).round() as u32).max(1);
        let (columns, rows) = (parts(lower), parts(along));
        let normal = narrow(unit(lower.cross(along)).unwrap_or(DVec3::Z));
        let first = self.positions.len() as u32;
        for row in 0..=rows {
            let up = f64::from(row) / f64::from(rows);
            let side = lower + up * (upper - lower);
            for column in 0..=columns {
                let right = f64::from(column) / f64::from(columns);
                let at = corner + up * (along + 0.5 * (lower - upper)) + right * side;
                self.positions.push(narrow(at));
                self.normals.push(normal);
                let u = 0.5 * lower.length() + (right - 0.5) * side.length();
                self.texture.push([u as f32, (up * along.length()) as f32]);
            }
        }
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
            let a = first + row * (columns + 1) + column;
            let [b, c, d] = [a + 1, a + columns + 2, a + columns + 1];
            for triangle in [[a, b, c], [a, c, d]] {
                self.triangles.push(triangle);
                self.material_of.push(material);
            }
        }
    }

    /// Adds a block between two corners.
    fn block(&mut self, [x0, y0, z0]: [f64; 3], [x1, y1, z1]: [f64; 3], material: u32) {
        let at = DVec3::new;
        let (x, y, z) = (at(x1 - x0, 0.0, 0.0), at(0.0, y1 - y0, 0.0), at(0.0, 0.0, z1 - z0));
        self.face(at(x0, y1, z0), -y, z, material);
        self.face(at(x1, y0, z0), y, z, material);
        self.face(at(x0, y0, z0), x, z, material);
        self.face(at(x1, y1, z0), -x, z, material);
        self.face(at(x0, y1, z0), x, -y, material);
        self.face(at(x0, y0, z1), x, y, material);
    }
}

/// Overlap of adjoining parts, so that no two faces share an edge.
const SUNK: f64 = 0.001;

/// Adds a chair of 0.5 x 0.5, 1 high, that faces -y.
fn chair(parts: &mut FlatParts) {
    let [frame, seat, back] = [0, 1, 2];
    for x in [-0.25, 0.2] {
        parts.block([x, -0.25, 0.0], [x + 0.05, -0.2, 0.65], frame);
        parts.block([x, 0.2, 0.0], [x + 0.05, 0.25, 1.0], frame);
        parts.block([x + SUNK, -0.2 - SUNK, 0.36], [x + 0.05 - SUNK, 0.2 + SUNK, 0.4], frame);
        // Arms.
        parts.block([x - 0.01, -0.27, 0.65 - SUNK], [x + 0.06, 0.2 + SUNK, 0.68], frame);
    }
    parts.block([-0.2 - SUNK, -0.24, 0.36], [0.2 + SUNK, -0.21, 0.4], frame);
    parts.block([-0.2 - SUNK, 0.21, 0.36], [0.2 + SUNK, 0.24, 0.4], frame);
    parts.block([-0.245, -0.245, 0.4 - SUNK], [0.245, 0.195, 0.47], seat);
    parts.block([-0.2 - SUNK, 0.21, 0.55], [0.2 + SUNK, 0.245, 0.95], back);
    // The cushion of the back.
    parts.block([-0.17, 0.17, 0.58], [0.17, 0.21 + SUNK, 0.92], back);
}

/// Adds a temple with six pillars along its front and eight along each side.
fn temple(parts: &mut FlatParts) {
    let [steps, pillars, walls, eaves, roof] = [0, 1, 2, 3, 4];
    for step in 0..3 {
        let inset = 0.06 * f64::from(step);
        let (width, depth, height) = (1.2 - inset, 1.6 - inset, 0.06 * f64::from(step));
        parts.block([-width, -depth, height - SUNK], [width, depth, height + 0.06], steps);
    }
    let (base, top) = (0.18, 0.98);
    for (across, along) in (0..6).flat_map(|across| (0..8).map(move |along| (across, along))) {
        if (1..5).contains(&across) && (1..7).contains(&along) {
            continue;
        }
        let (x, y) = (-0.95 + 0.38 * f64::from(across), -1.35 + 2.7 / 7.0 * f64::from(along));
        let mut drum = |half: f64, low: f64, high: f64| {
            parts.block([x - half, y - half, low - SUNK], [x + half, y + half, high + SUNK], pillars);
        };
        drum(0.09, base, base + 0.05);
        drum(0.06, base + 0.05, top - 0.05);
        drum(0.09, top - 0.05, top);
    }
    // The chamber, open in front.
    let mut wall = |low: [f64; 2], high: [f64; 2]| {
        parts.block([low[0], low[1], base - SUNK], [high[0], high[1], top + SUNK], walls);
    };
    wall([-0.55, -0.9], [-0.5, 0.9]);
    wall([0.5, -0.9], [0.55, 0.9]);
    wall([-0.5 - SUNK, 0.85], [0.5 + SUNK, 0.9 - SUNK]);
    wall([-0.5 - SUNK, -0.9 + SUNK], [-0.2, -0.85]);
    wall([0.2, -0.9 + SUNK], [0.5 + SUNK, -0.85]);
    parts.block([-1.08, -1.48, top], [1.08, 1.48, top + 0.12], eaves);
    // The roof: two slopes and two gables over the eaves.
    let (foot, ridge, width, depth) = (top + 0.12 - SUNK, top + 0.55, 1.16, 1.56);
    let at = DVec3::new;
    let (up, along) = (ridge - foot, at(0.0, 2.0 * depth, 0.0));
    parts.face(at(width, -depth, foot), along, at(-width, 0.0, up), roof);
    parts.face(at(-width, depth, foot), -along, at(width, 0.0, up), roof);
    let across = at(2.0 * width, 0.0, 0.0);
    parts.trapezoid(at(-width, -depth, foot), [across, 0.001 * across], at(0.0, 0.0, up), eaves);
    parts.trapezoid(at(width, depth, foot), [-across, -0.001 * across], at(0.0, 0.0, up), eaves);
    parts.face(at(-width, depth, foot), across, -along, eaves);
}
