//! Models with the vertex counts of the models in the papers on compressed transfer (Table 1 of each): the Stanford
//! bunny, two polygons of which one shadows the other, and stand-ins for unavailable models (a Buddha, a bird, a head
//! and an armor).
//!
//! All have normals and texture coordinates. All but the polygons are closed; at the texture's seam the mesh repeats
//! vertices, which have the same position, normal and tangent and are counted once.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::bodies;
use super::bunny::bunny;
use super::grid::{grid_triangles, with_attributes};
use super::resample::ClosedSurface;
use crate::elementary::{acos, atan2};
use crate::geom::Mesh;
use crate::geom::vector::{narrow, unit};

/// Model with the vertex count of a paper's model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransferModel {
    /// A bird with 48,688 vertices, as in the paper on clustered principal components.
    Bird,
    /// A Buddha in a folded coat with 49,990 vertices, as in the paper on clustered principal components.
    FoldedBuddha,
    /// A head with 50,060 vertices, as in the paper on clustered principal components.
    Head,
    /// A ground 4 units wide, and above it a blocker 1 unit wide, both facing up (Figure 6).
    Polygons,
    /// The Stanford bunny with 11,556 vertices, as in the paper on all-frequency transfer.
    Bunny,
    /// The bird with 32,768 vertices, as in the paper on all-frequency transfer.
    Tweety,
    /// The Buddha with 54,100 vertices, as in the paper on all-frequency transfer.
    Buddha,
    /// The Stanford bunny with 3,286 vertices, as in the paper on bi-scale transfer (its Tables I and II).
    BiScaleBunny,
    /// The Stanford bunny with 12,380 vertices (Table II).
    BiScaleBunnyMiddle,
    /// The Stanford bunny with 47,960 vertices (Table II).
    BiScaleBunnyFine,
    /// An armor with 10,652 vertices, as in the paper on bi-scale transfer (Table I).
    BiScaleArmor,
}

impl TransferModel {
    /// Builds the mesh. `coarser` 1 gives the paper's number of vertices; larger values, up to 16, lengthen edges by
    /// about that factor.
    pub fn mesh(self, coarser: u32) -> Mesh {
        let coarser = coarser.clamp(1, 16);
        let (build, vertices): (fn(usize) -> ClosedSurface, usize) = match self {
            Self::Polygons => return polygons(coarser),
            Self::Bird => (bodies::bird, 48_688),
            Self::FoldedBuddha => (bodies::buddha, 49_990),
            Self::Head => (bodies::head, 50_060),
            Self::Bunny => (bunny, 11_556),
            Self::Tweety => (bodies::bird, 32_768),
            Self::Buddha => (bodies::buddha, 54_100),
            Self::BiScaleBunny => (bunny, 3_286),
            Self::BiScaleBunnyMiddle => (bunny, 12_380),
            Self::BiScaleBunnyFine => (bunny, 47_960),
            Self::BiScaleArmor => (bodies::armor, 10_652),
        };
        textured(&build(vertices / (coarser * coarser) as usize))
    }
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
            }
        }
        triangles.extend(grid_triangles(first, [counts - 1; 2]));
    }
    let normals = vec![[0.0, 0.0, 1.0]; positions.len()];
    with_attributes(positions, triangles, normals, texture)
}

/// Mesh of a surface around the origin with texture coordinates by direction: longitude and latitude. The latitude's
/// sign changes where the surface faces inwards, so that no texture is mirrored.
fn textured(surface: &ClosedSurface) -> Mesh {
    let toward = |at: DVec3| longitude_and_latitude(unit(at).unwrap_or(DVec3::Z));
    let around: Vec<[f64; 2]> = surface.positions.iter().map(|&at| toward(at)).collect();
    // Mesh vertices by surface vertex and texture coordinate.
    let mut known = BTreeMap::new();
    let (mut of, mut texture) = (Vec::new(), Vec::new());
    let triangles = surface.triangles.iter().map(|face| {
        let along = unrolled(face.map(|corner| around[corner as usize][0]));
        let up = face.map(|corner| around[corner as usize][1]);
        let [a, b, c] =
            [0, 1, 2].map(|corner| [along[corner], up[corner]].map(|coordinate| f64::from(coordinate as f32)));
        let is_mirrored = (b[0] - a[0]) * (c[1] - a[1]) < (c[0] - a[0]) * (b[1] - a[1]);
        [0, 1, 2].map(|corner| {
            let vertex = face[corner] as usize;
            let coordinates = [along[corner], if is_mirrored { -up[corner] } else { up[corner] }].map(|at| at as f32);
            *known.entry((vertex, coordinates.map(f32::to_bits))).or_insert_with(|| {
                of.push(vertex);
                texture.push(coordinates);
                of.len() as u32 - 1
            })
        })
    });
    let triangles = triangles.collect();
    let of = |values: &[DVec3]| of.iter().map(|&vertex| narrow(values[vertex])).collect();
    with_attributes(of(&surface.positions), triangles, of(&surface.normals()), texture)
}

/// Longitudes of a face's corners, unwrapped to less than half a turn apart. For the face around a pole this is
/// impossible; all its corners get its first longitude, so its texture has no area.
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
