//! Normals that are smooth across flat edges and jump across sharp ones.

use std::collections::BTreeMap;

use super::mesh::Mesh;
use super::vector::{area_vector, narrow, place_bits, unit, wide};
use glam::DVec3;

impl Mesh {
    /// Returns the mesh with a normal per corner: the area-weighted mean over the triangles at the corner's position
    /// whose normals lie within an angle of the normal of the corner's triangle. `cosine` is the cosine of that angle.
    /// Vertices with several normals are duplicated; the order of triangles and the texture coordinates do not change.
    pub fn creased(&self, cosine: f64) -> Self {
        let areas: Vec<DVec3> = self.iter_corners().map(|corners| area_vector(corners.map(wide))).collect();
        let place = |vertex: u32| place_bits(self.positions()[vertex as usize]);
        let mut around: BTreeMap<[u32; 3], Vec<usize>> = BTreeMap::new();
        for (triangle, corners) in self.triangles().iter().enumerate() {
            corners.iter().for_each(|&corner| around.entry(place(corner)).or_default().push(triangle));
        }
        let normal = |triangle: usize, corner: u32| {
            let Some(own) = unit(areas[triangle]) else { return [0.0; 3] };
            let is_smooth = |other: &&usize| unit(areas[**other]).is_some_and(|other| own.dot(other) >= cosine);
            let others = around[&place(corner)].iter().filter(is_smooth);
            let sum = others.fold(DVec3::ZERO, |sum, &other| sum + areas[other]);
            narrow(unit(sum).unwrap_or(own)).map(|value| value + 0.0)
        };
        let mut known: BTreeMap<(u32, [u32; 3]), u32> = BTreeMap::new();
        let (mut of, mut normals) = (Vec::new(), Vec::new());
        let triangles = self.triangles().iter().enumerate().map(|(triangle, corners)| {
            corners.map(|corner| {
                let normal = normal(triangle, corner);
                *known.entry((corner, normal.map(f32::to_bits))).or_insert_with(|| {
                    of.push(corner as usize);
                    normals.push(normal);
                    of.len() as u32 - 1
                })
            })
        });
        let triangles = triangles.collect();
        let positions = of.iter().map(|&vertex| self.positions()[vertex]).collect();
        let texcoords = self.texcoords().map(|texture| of.iter().map(|&vertex| texture[vertex]).collect());
        let mesh = Self::new(positions, triangles);
        mesh.and_then(|mesh| mesh.with_attributes(Some(normals), texcoords))
            .expect("places and normals of a mesh are finite")
    }
}
