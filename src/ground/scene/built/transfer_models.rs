//! Models with the vertex counts of those in the papers on compressed transfer (Table 1 of each), which are not
//! available: smooth ones, bumpy ones, a head, and two polygons of which one shadows the other.
//!
//! All have normals and texture coordinates. The first three are closed; where the texture's two ends meet, the mesh
//! repeats vertices, which have the same position, normal and tangent and count once.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::geodesic::{Lobe, Sphere, bumped};
use crate::elementary::{acos, atan2, sin_cos};
use crate::geom::Mesh;
use crate::geom::vector::{narrow, unit};

/// Model with the vertex count of a paper's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransferModel {
    /// A smooth closed body with a neck that shadows its breast, about 2.5 units high. Stands in for the paper's bird.
    Smooth,
    /// A closed body covered with bumps that shadow each other, about 2.5 units high. Stands in for the paper's Buddha.
    Bumpy,
    /// A closed head with nose, eye sockets, ears and neck, about 2.5 units high.
    Head,
    /// A ground 4 units wide, and above it a blocker 1 unit wide, both facing up (Figure 6).
    Polygons,
    /// The smooth body with the 11,556 vertices of the bunny in the paper on all-frequency transfer.
    Bunny,
    /// The smooth body with the 32,768 vertices of its bird.
    Tweety,
    /// The bumpy body with the 54,100 vertices of its Buddha.
    Buddha,
    /// The smooth body with the 3,286 vertices of the bunny in the paper on bi-scale transfer (its Tables I and II).
    BiScaleBunny,
    /// The smooth body with 12,380 vertices (Table II).
    BiScaleBunnyMiddle,
    /// The smooth body with 47,960 vertices (Table II).
    BiScaleBunnyFine,
    /// The bumpy body with the 10,652 vertices of its armor (Table I).
    BiScaleArmor,
}

/// Parts of an icosahedron's edge, which give 10 parts^2 + 2 vertices, and the number of the largest faces that are
/// divided, which adds a vertex each.
const SMOOTH: [u32; 2] = [69, 1_076];
const BUMPY: [u32; 2] = [70, 988];
const HEAD: [u32; 2] = [70, 1_058];
const BUNNY: [u32; 2] = [33, 664];
const TWEETY: [u32; 2] = [57, 276];
const BUDDHA: [u32; 2] = [73, 808];
const BI_SCALE_BUNNY: [u32; 2] = [18, 44];
const BI_SCALE_BUNNY_MIDDLE: [u32; 2] = [35, 128];
const BI_SCALE_BUNNY_FINE: [u32; 2] = [69, 348];
const BI_SCALE_ARMOR: [u32; 2] = [32, 410];

impl TransferModel {
    /// Builds the mesh with edges about `coarser` times as long: with 1, as many vertices as the paper's. Values above
    /// 16 count as 16.
    pub fn mesh(self, coarser: u32) -> Mesh {
        let coarser = coarser.clamp(1, 16);
        match self {
            Self::Smooth => smooth(SMOOTH, coarser),
            Self::Bumpy => bumpy(BUMPY, coarser),
            Self::Head => head(coarser),
            Self::Polygons => polygons(coarser),
            Self::Bunny => smooth(BUNNY, coarser),
            Self::Tweety => smooth(TWEETY, coarser),
            Self::Buddha => bumpy(BUDDHA, coarser),
            Self::BiScaleBunny => smooth(BI_SCALE_BUNNY, coarser),
            Self::BiScaleBunnyMiddle => smooth(BI_SCALE_BUNNY_MIDDLE, coarser),
            Self::BiScaleBunnyFine => smooth(BI_SCALE_BUNNY_FINE, coarser),
            Self::BiScaleArmor => bumpy(BI_SCALE_ARMOR, coarser),
        }
    }
}

/// Builds a body with a neck.
fn smooth(size: [u32; 2], coarser: u32) -> Mesh {
    let lobes = [
        Lobe { toward: [0.55, 0.0, 0.85], height: 0.9, narrow: 14.0 },
        Lobe { toward: [1.0, 0.0, 0.75], height: 0.35, narrow: 60.0 },
        Lobe { toward: [-1.0, 0.0, 0.1], height: 0.6, narrow: 9.0 },
        Lobe { toward: [0.1, 0.9, 0.2], height: 0.2, narrow: 6.0 },
        Lobe { toward: [0.1, -0.9, 0.2], height: 0.2, narrow: 6.0 },
        Lobe { toward: [0.95, 0.0, 0.3], height: -0.15, narrow: 20.0 },
    ];
    let shape = |toward: DVec3| {
        let at = toward * bumped(toward, &lobes) * DVec3::new(1.0, 0.7, 0.85);
        // Bent, so that the head overhangs the breast.
        at + DVec3::X * (0.12 * at.z * at.z)
    };
    closed(size, coarser, &shape)
}

/// Builds a body with bumps.
fn bumpy(size: [u32; 2], coarser: u32) -> Mesh {
    let lobes = [
        Lobe { toward: [0.0, 0.0, 1.0], height: 0.45, narrow: 9.0 },
        Lobe { toward: [0.6, 0.7, 0.2], height: 0.25, narrow: 12.0 },
        Lobe { toward: [-0.6, 0.7, 0.2], height: 0.25, narrow: 12.0 },
        Lobe { toward: [0.0, -1.0, -0.2], height: 0.3, narrow: 5.0 },
        Lobe { toward: [0.0, 0.3, -1.0], height: 0.35, narrow: 4.0 },
    ];
    let shape = |toward: DVec3| {
        let wave = |at: f64, turns: f64| sin_cos(TAU * turns * at).0;
        let bumps = wave(toward.x, 3.5) * wave(toward.y, 3.5) + wave(toward.y, 5.0) * wave(toward.z, 5.0);
        toward * (bumped(toward, &lobes) + 0.06 * bumps) * DVec3::new(0.9, 0.75, 1.1)
    };
    closed(size, coarser, &shape)
}

/// Builds a head of 50,060 vertices.
fn head(coarser: u32) -> Mesh {
    let lobes = [
        Lobe { toward: [0.0, -1.0, -0.1], height: 0.25, narrow: 45.0 },
        Lobe { toward: [0.35, -1.0, 0.2], height: -0.1, narrow: 40.0 },
        Lobe { toward: [-0.35, -1.0, 0.2], height: -0.1, narrow: 40.0 },
        Lobe { toward: [0.0, -1.0, 0.45], height: 0.06, narrow: 30.0 },
        Lobe { toward: [0.0, -1.0, -0.5], height: -0.06, narrow: 60.0 },
        Lobe { toward: [0.0, -0.9, -0.75], height: 0.12, narrow: 25.0 },
        Lobe { toward: [1.0, 0.1, 0.0], height: 0.22, narrow: 60.0 },
        Lobe { toward: [-1.0, 0.1, 0.0], height: 0.22, narrow: 60.0 },
        Lobe { toward: [0.0, 0.35, -1.0], height: 0.4, narrow: 7.0 },
    ];
    let shape = |toward: DVec3| toward * bumped(toward, &lobes) * DVec3::new(0.78, 0.95, 1.05);
    closed(HEAD, coarser, &shape)
}

/// Builds a ground of 240 x 240 vertices and a blocker of 32 x 32: 58,624 vertices.
fn polygons(coarser: u32) -> Mesh {
    let (mut positions, mut texture, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for (counts, width, height) in [(240 / coarser, 4.0, 0.0), (32 / coarser, 1.0, 0.5)] {
        let first = positions.len() as u32;
        for row in 0..counts {
            for column in 0..counts {
                let [u, v] = [column, row].map(|at| f64::from(at) / f64::from(counts - 1));
                positions.push(narrow(DVec3::new(width * (u - 0.5), width * (v - 0.5), height)));
                texture.push([u as f32, v as f32]);
                if row + 1 < counts && column + 1 < counts {
                    let a = first + row * counts + column;
                    let [b, c, d] = [a + 1, a + counts + 1, a + counts];
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
    }
    let normals = vec![[0.0, 0.0, 1.0]; positions.len()];
    finished(positions, triangles, normals, texture)
}

/// Builds a deformed geodesic sphere, its faces divided where they are largest after deformation.
fn closed([parts, divided]: [u32; 2], coarser: u32, shape: &dyn Fn(DVec3) -> DVec3) -> Mesh {
    let mut sphere = Sphere::new(parts / coarser);
    sphere.divide_largest((divided / (coarser * coarser)) as usize, shape);
    let places: Vec<[f32; 3]> = sphere.directions.iter().map(|&toward| narrow(shape(toward))).collect();
    let plain = Mesh::new(places.clone(), sphere.faces.clone()).expect("shapes are finite");
    let normals: Vec<[f32; 3]> = plain.vertex_normals().into_iter().map(narrow).collect();
    let around: Vec<[f64; 2]> = sphere.directions.iter().map(|&toward| longitude_and_latitude(toward)).collect();
    // Vertices by sphere vertex and texture coordinate.
    let mut known = BTreeMap::new();
    let (mut of, mut texture) = (Vec::new(), Vec::new());
    let triangles = sphere.faces.iter().map(|face| {
        let along = unrolled(face.map(|corner| around[corner as usize][0]));
        [0, 1, 2].map(|corner| {
            let (vertex, u) = (face[corner] as usize, along[corner] as f32);
            *known.entry((vertex, u.to_bits())).or_insert_with(|| {
                of.push(vertex);
                texture.push([u, around[vertex][1] as f32]);
                of.len() as u32 - 1
            })
        })
    });
    let triangles = triangles.collect();
    let of = |values: &[[f32; 3]]| of.iter().map(|&vertex| values[vertex]).collect();
    finished(of(&places), triangles, of(&normals), texture)
}

/// Longitudes of a face's corners, unwrapped to less than half a turn apart; the face around a pole, where that is
/// impossible, gets its first longitude throughout: its texture has no area.
fn unrolled(turns: [f64; 3]) -> [f64; 3] {
    let least = turns.map(|at| if at + 0.5 < turns[0] { at + 1.0 } else { at });
    let behind = least.iter().any(|&at| at > turns[0] + 0.5);
    let least = least.map(|at| if behind && at <= turns[0] + 0.5 { at + 1.0 } else { at });
    let [low, high] = [least.into_iter().fold(9.0, f64::min), least.into_iter().fold(0.0, f64::max)];
    if high - low < 0.5 { least } else { [turns[0]; 3] }
}

/// Texture coordinates of a direction, both in [0, 1]. The axis is tilted so that no vertex lies on it.
fn longitude_and_latitude(toward: DVec3) -> [f64; 2] {
    let axis = unit(DVec3::new(0.031, 0.047, 1.0)).unwrap_or(DVec3::Z);
    let x = unit(DVec3::X - DVec3::X.dot(axis) * axis).unwrap_or(DVec3::X);
    let turns = atan2(axis.cross(x).dot(toward), x.dot(toward)) / TAU;
    [if turns < 0.0 { turns + 1.0 } else { turns }, 1.0 - acos(axis.dot(toward).clamp(-1.0, 1.0)) / PI]
}

fn finished(
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<[f32; 3]>,
    texture: Vec<[f32; 2]>,
) -> Mesh {
    let mesh = Mesh::new(positions, triangles).and_then(|mesh| mesh.with_normals(normals));
    mesh.and_then(|mesh| mesh.with_texcoords(texture)).expect("finite numbers, as many as vertices")
}
