//! Normals that are smooth across flat edges and jump across sharp ones.

use std::collections::BTreeMap;

use super::mesh::Mesh;
use super::vector::{narrow, unit, wide};
use glam::DVec3;

impl Mesh {
    /// Returns the mesh with a normal per corner: the mean of the triangles at the corner's position whose normals lie
    /// within an angle of the corner's own triangle, weighted by area. `cosine` is that of the angle. Vertices with
    /// several normals are repeated; triangles keep their order, vertices their texture coordinates.
    #[must_use]
    pub fn creased(&self, cosine: f64) -> Self {
        let areas: Vec<DVec3> = self
            .iter_corners()
            .map(|corners| {
                let [a, b, c] = corners.map(wide);
                (b - a).cross(c - a)
            })
            .collect();
        // -0 and +0 are the same position.
        let place = |vertex: u32| self.positions()[vertex as usize].map(|value| (value + 0.0).to_bits());
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
        let mesh = Self::new(positions, triangles).and_then(|mesh| mesh.with_normals(normals));
        let texture = self.texcoords().map(|texture| of.iter().map(|&vertex| texture[vertex]).collect());
        let mesh = match texture {
            Some(texture) => mesh.and_then(|mesh| mesh.with_texcoords(texture)),
            None => mesh,
        };
        mesh.expect("places and normals of a mesh are finite")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two squares that meet at a right angle, the first of two triangles.
    fn corner() -> Mesh {
        let positions =
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
        let mesh = Mesh::new(positions.to_vec(), vec![[0, 1, 2], [0, 2, 3], [0, 3, 5], [0, 5, 4]]).expect("a mesh");
        mesh.with_texcoords(positions.map(|[x, y, z]| [x + z, y]).to_vec()).expect("coordinates")
    }

    #[test]
    fn sharp_edges_have_two_normals() {
        let sharp = corner().creased(0.5);
        assert_eq!((sharp.len(), sharp.positions().len()), (4, 8));
        for (triangle, corners) in sharp.triangles().iter().enumerate() {
            let expected = if triangle < 2 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
            for &at in corners {
                assert_eq!(sharp.normals().expect("normals")[at as usize], expected);
            }
            let of =
                |mesh: &Mesh| mesh.triangles()[triangle].map(|at| mesh.texcoords().expect("coordinates")[at as usize]);
            assert_eq!(of(&sharp), of(&corner()));
        }
        assert!(sharp.iter_corners().eq(corner().iter_corners()));
    }

    #[test]
    fn flat_edges_have_one() {
        let smooth = corner().creased(-1.0);
        assert_eq!(smooth.positions().len(), 6);
        let expected: Vec<[f32; 3]> = corner().vertex_normals().into_iter().map(narrow).collect();
        let at = |mesh: &Mesh, triangle: usize, corner: usize| mesh.triangles()[triangle][corner] as usize;
        for (triangle, corner_at) in (0..4).flat_map(|triangle| (0..3).map(move |corner| (triangle, corner))) {
            let found = smooth.normals().expect("normals")[at(&smooth, triangle, corner_at)];
            assert_eq!(found, expected[at(&corner(), triangle, corner_at)]);
        }
    }
}
