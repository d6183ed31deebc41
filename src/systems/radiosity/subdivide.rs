//! Faces of a scene, and their subdivision into patches.

use super::patch::Patch;
use crate::error::{InputError, ensure, input_error};
use crate::geom::exact::is_degenerate;
use crate::geom::vector::wide;
use crate::scene::Scene;
use glam::DVec3;

/// Distance of a face's fourth corner from its plane, relative to the longest diagonal: the precision of f32.
const FLAT: f64 = 1e-6;

/// A flat convex part of the scene: a triangle, or two triangles that form a quadrilateral.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Face {
    /// Its three or four corners, counter-clockwise from the front.
    pub(super) corners: Vec<DVec3>,
    /// Index of its (first) triangle in the mesh.
    pub(super) triangle: u32,
    material: u32,
}

/// The faces of a scene, and the face of each triangle; [`u32::MAX`] for a triangle without area.
pub(super) fn faces_of(scene: &Scene) -> Result<(Vec<Face>, Vec<u32>), InputError> {
    let has_area: Vec<bool> = scene.mesh().iter_corners().map(|corners| !is_degenerate(&corners)).collect();
    let triangles: Vec<[DVec3; 3]> = scene.mesh().iter_corners().map(|t| t.map(wide)).collect();
    if let Some(thin) = (0..triangles.len()).find(|&i| has_area[i] && Patch::new(&triangles[i], 0, 0).is_none()) {
        return Err(too_thin_error(thin as u32));
    }
    let materials = scene.material_of();
    let (mut faces, mut face_of) = (Vec::new(), Vec::new());
    let mut i = 0;
    while i < triangles.len() {
        if !has_area[i] {
            face_of.push(u32::MAX);
            i += 1;
            continue;
        }
        let same = triangles.get(i + 1).filter(|_| materials[i] == materials[i + 1]);
        let quad = same.and_then(|next| quadrilateral(&triangles[i], next));
        let width = 1 + usize::from(quad.is_some());
        face_of.extend(std::iter::repeat_n(faces.len() as u32, width));
        let corners = quad.map_or_else(|| triangles[i].to_vec(), |quad| quad.to_vec());
        faces.push(Face { corners, triangle: i as u32, material: materials[i] });
        i += width;
    }
    ensure!(!faces.is_empty(), "radiosity::patches" => "expected a scene with surfaces, found none");
    Ok((faces, face_of))
}

pub(super) fn too_thin_error(triangle: u32) -> InputError {
    input_error!("radiosity::patches" =>
        "triangle {triangle} (counted from 0) is too thin for a patch; remove it, or merge its corners")
}

/// Merges two triangles with a common side into a quadrilateral; `None` if it is not flat and convex.
fn quadrilateral(one: &[DVec3; 3], other: &[DVec3; 3]) -> Option<[DVec3; 4]> {
    for i in 0..3 {
        let [a, b, c] = [one[i], one[(i + 1) % 3], one[(i + 2) % 3]];
        for j in 0..3 {
            if other[j] == a && other[(j + 1) % 3] == c {
                let quad = [a, b, c, other[(j + 2) % 3]];
                return is_flat_and_convex(&quad).then_some(quad);
            }
        }
    }
    None
}

fn is_flat_and_convex(quad: &[DVec3; 4]) -> bool {
    let diagonals = [quad[2] - quad[0], quad[3] - quad[1]];
    let normal = diagonals[0].cross(diagonals[1]);
    let longest = diagonals[0].length().max(diagonals[1].length());
    let lift = normal.dot(quad[1] - quad[0]).abs();
    let turns = (0..4).all(|i| {
        let side = |k: usize| quad[(k + 1) % 4] - quad[k % 4];
        side(i).cross(side(i + 1)).dot(normal) > FLAT * normal.dot(normal)
    });
    lift <= FLAT * longest * normal.length() && turns
}

/// Chooses the number of parts per side of each face, with parts as short as `most` patches in total allow.
pub(super) fn steps_for_at_most(faces: &[Face], most: usize) -> Vec<[u32; 2]> {
    let longest = faces.iter().flat_map(Face::sides).fold(0.0, f64::max);
    let count = |part: f64| faces.iter().map(|f| f.steps(part)).map(|[u, v]| f64::from(u) * f64::from(v)).sum::<f64>();
    // The number of patches decreases with the length of parts, so bisect until the interval is negligible.
    let (mut short, mut long) = (longest / 4096.0, longest);
    for _ in 0..60 {
        let middle = 0.5 * (short + long);
        if count(middle) > most as f64 {
            short = middle;
        } else {
            long = middle;
        }
    }
    faces.iter().map(|face| face.steps(long)).collect()
}

impl Face {
    /// Lengths across and along, each the longer of two opposite sides.
    fn sides(&self) -> [f64; 2] {
        let n = self.corners.len();
        let side = |i: usize| (self.corners[(i + 1) % n] - self.corners[i]).length();
        if n == 3 { [side(0).max(side(1)).max(side(2)); 2] } else { [side(0).max(side(2)), side(1).max(side(3))] }
    }

    /// Number of parts of at most this length, across and along.
    fn steps(&self, part: f64) -> [u32; 2] {
        // 1e-9 is subtracted, so that rounding does not add a part where the exact quotient is an integer.
        self.sides().map(|side| ((side / part - 1e-9).ceil() as u32).max(1))
    }

    /// Adds the patches of the face; `None` if one of them has no area. Common corners of neighbours have equal bits.
    pub(super) fn cut(&self, id: u32, [across, along]: [u32; 2], into: &mut Vec<Patch>) -> Option<()> {
        let part = |i: u32, n: u32| f64::from(i) / f64::from(n);
        if let [a, b, c, d] = self.corners[..] {
            let at = |i, j| mix(mix(a, b, part(i, across)), mix(d, c, part(i, across)), part(j, along));
            for j in 0..along {
                for i in 0..across {
                    let outline = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    into.push(Patch::new(&outline, id, self.material)?);
                }
            }
            return Some(());
        }
        let (a, b, c, n) = (self.corners[0], self.corners[1], self.corners[2], across);
        let at = |i, j| a + (part(i, n) * (b - a) + part(j, n) * (c - a));
        for j in 0..n {
            for i in 0..n - j {
                into.push(Patch::new(&[at(i, j), at(i + 1, j), at(i, j + 1)], id, self.material)?);
                if i + j + 1 < n {
                    let downwards = [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    into.push(Patch::new(&downwards, id, self.material)?);
                }
            }
        }
        Some(())
    }
}

/// Linear interpolation; exact at 0 and 1.
fn mix(a: DVec3, b: DVec3, t: f64) -> DVec3 {
    (1.0 - t) * a + t * b
}
