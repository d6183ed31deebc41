//! Faces of a mesh with their corners, normals and areas.

use glam::DVec3;

use crate::geom::Mesh;
use crate::geom::vector::{area_vector, unit, wide};

/// Faces of a mesh, in its order.
#[derive(Debug, Clone)]
pub(super) struct AtlasSurface {
    corners: Vec<[[f32; 3]; 3]>,
    /// Normals at the corners of each face; of length 1, or zero where none is known.
    normals: Vec<[DVec3; 3]>,
    areas: Vec<f64>,
    /// `true` if the mesh had normals.
    given: bool,
}

impl AtlasSurface {
    /// Collects the faces of `mesh`; `welded` is the same mesh with vertices merged by position.
    pub(super) fn new(mesh: &Mesh, welded: &Mesh) -> Self {
        let corners: Vec<_> = mesh.iter_corners().collect();
        let areas = (0..mesh.len() as u32).map(|face| mesh.area(face)).collect();
        Self { corners, normals: corner_normals(mesh, welded), areas, given: mesh.normals().is_some() }
    }

    pub(super) fn len(&self) -> usize {
        self.corners.len()
    }

    /// Returns the faces with vertices merged by position.
    pub(super) fn welded(&self) -> Mesh {
        let positions = self.corners.iter().flatten().copied().collect();
        let triangles = (0..self.corners.len() as u32).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect();
        Mesh::new(positions, triangles).map(|mesh| mesh.welded()).unwrap_or_default()
    }

    pub(super) fn corners(&self, face: u32) -> [DVec3; 3] {
        self.corners[face as usize].map(wide)
    }

    pub(super) fn normals(&self, face: u32) -> [DVec3; 3] {
        self.normals[face as usize]
    }

    pub(super) fn areas(&self) -> &[f64] {
        &self.areas
    }

    pub(super) const fn has_given_normals(&self) -> bool {
        self.given
    }

    pub(super) fn point(&self, face: u32, weights: [f64; 3]) -> DVec3 {
        combined(self.corners(face), weights)
    }

    pub(super) fn normal(&self, face: u32, weights: [f64; 3]) -> DVec3 {
        let normals = self.normals(face);
        unit(combined(normals, weights)).unwrap_or(normals[0])
    }

    /// Normal of a face, with twice its area as length.
    pub(super) fn area_vector(&self, face: u32) -> DVec3 {
        area_vector(self.corners(face))
    }

    pub(super) fn centroid(&self, face: u32) -> DVec3 {
        let [a, b, c] = self.corners(face);
        (a + b + c) / 3.0
    }
}

/// Weighted sum of three vectors.
pub(super) fn combined([a, b, c]: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    a * weights[0] + b * weights[1] + c * weights[2]
}

/// Normals at the corners of each face: the mesh's, else the mean of the faces at each position, else the face's own.
fn corner_normals(mesh: &Mesh, welded: &Mesh) -> Vec<[DVec3; 3]> {
    let computed = welded.vertex_normals();
    let given = mesh.normals();
    let faces = mesh.triangles().iter().zip(welded.triangles()).zip(mesh.iter_corners());
    let normals = faces.map(|((own, shared), corners)| {
        let flat = unit(area_vector(corners.map(wide))).unwrap_or(DVec3::ZERO);
        std::array::from_fn(|corner| {
            let given = given.and_then(|normals| unit(wide(normals[own[corner] as usize])));
            let known = given.unwrap_or(computed[shared[corner] as usize]);
            if known == DVec3::ZERO { flat } else { known }
        })
    });
    normals.collect()
}
