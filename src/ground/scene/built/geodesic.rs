//! Deformed geodesic spheres: closed meshes of any number of vertices.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::elementary::exp;
use crate::geom::Mesh;
use crate::geom::vector::{narrow, unit};

/// Bump of a sphere, or a dent if its height is negative.
pub(super) struct Lobe {
    /// Direction of its centre.
    pub(super) toward: [f64; 3],
    /// Height over the sphere, of radius 1.
    pub(super) height: f64,
    /// Steepness of the falloff.
    pub(super) narrow: f64,
}

/// Radius of a unit sphere with bumps, in a direction.
pub(super) fn bumped(toward: DVec3, lobes: &[Lobe]) -> f64 {
    let height = |lobe: &Lobe| {
        let middle = unit(DVec3::from(lobe.toward)).unwrap_or(DVec3::Z);
        lobe.height * exp(lobe.narrow * (toward.dot(middle) - 1.0))
    };
    1.0 + lobes.iter().map(height).sum::<f64>()
}

/// Builds the geodesic sphere of `20 * parts * parts` faces, modified by `change`, with every direction mapped by
/// `shape`.
pub(super) fn mesh_of(parts: u32, shape: &dyn Fn(DVec3) -> DVec3, change: impl FnOnce(&mut Sphere)) -> Mesh {
    let mut sphere = Sphere::new(parts);
    change(&mut sphere);
    let positions = sphere.directions.iter().map(|&toward| narrow(shape(toward))).collect();
    Mesh::new(positions, sphere.faces).expect("indices are those of directions, and shapes are finite")
}

/// Triangulated unit sphere, fronts outwards.
pub(super) struct Sphere {
    pub(super) directions: Vec<DVec3>,
    pub(super) faces: Vec<[u32; 3]>,
}

impl Sphere {
    /// Creates an icosahedron with each edge divided into `parts` parts.
    pub(super) fn new(parts: u32) -> Self {
        let (corners, triangles) = icosahedron();
        let mut known = BTreeMap::new();
        let mut sphere = Self { directions: Vec::new(), faces: Vec::new() };
        for triangle in triangles {
            let mut vertex = |counts: [u32; 3]| {
                // Independent of the triangle's orientation, so that shared points are bit-identical.
                let mut key =
                    [0, 1, 2].map(|at| (triangle[at], counts[at])).map(|own| if own.1 == 0 { (0, 0) } else { own });
                key.sort_unstable();
                *known.entry(key).or_insert_with(|| {
                    let sum: DVec3 = key.iter().map(|&(corner, count)| corners[corner] * f64::from(count)).sum();
                    sphere.directions.push(unit(sum).unwrap_or(DVec3::Z));
                    sphere.directions.len() as u32 - 1
                })
            };
            for row in 0..parts {
                for column in 0..parts - row {
                    let [a, b, c] = [[0, 0], [1, 0], [0, 1]].map(|[right, up]| [column + right, row + up]);
                    let mut at = |[x, y]: [u32; 2]| vertex([parts - x - y, x, y]);
                    let [a, b, c] = [at(a), at(b), at(c)];
                    sphere.faces.push([a, b, c]);
                    if column + row + 2 <= parts {
                        let d = at([column + 1, row + 1]);
                        sphere.faces.push([b, d, c]);
                    }
                }
            }
        }
        sphere
    }

    /// Divides the faces that are largest after applying `shape` into three each.
    pub(super) fn divide_largest(&mut self, count: usize, shape: &dyn Fn(DVec3) -> DVec3) {
        let area = |face: [u32; 3]| {
            let [a, b, c] = face.map(|corner| shape(self.directions[corner as usize]));
            (b - a).cross(c - a).length_squared()
        };
        let mut by_area: Vec<(f64, usize)> = self.faces.iter().map(|&face| area(face)).zip(0..).collect();
        by_area.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        for (_, face) in by_area.into_iter().take(count) {
            let [a, b, c] = self.faces[face];
            let sum: DVec3 = [a, b, c].iter().map(|&corner| self.directions[corner as usize]).sum();
            let middle = self.directions.len() as u32;
            self.directions.push(unit(sum).unwrap_or(DVec3::Z));
            self.faces[face] = [a, b, middle];
            self.faces.extend([[b, c, middle], [c, a, middle]]);
        }
    }

    /// Removes the lowest faces, so that `left` are left.
    pub(super) fn open_at_the_bottom(&mut self, left: usize) {
        let height = |face: &[u32; 3]| face.iter().map(|&corner| self.directions[corner as usize].z).sum::<f64>();
        let mut by_height: Vec<(f64, usize)> = self.faces.iter().map(height).zip(0..).collect();
        by_height.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut kept: Vec<usize> = by_height.into_iter().take(left).map(|(_, face)| face).collect();
        kept.sort_unstable();
        self.faces = kept.into_iter().map(|face| self.faces[face]).collect();
    }
}

/// Corners and triangles of an icosahedron, fronts outwards.
fn icosahedron() -> ([DVec3; 12], [[usize; 3]; 20]) {
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    let mut corners = [DVec3::ZERO; 12];
    for (at, corner) in corners.iter_mut().enumerate() {
        let signed = |bit: usize, value: f64| if at >> bit & 1 == 0 { value } else { -value };
        let [short, long] = [signed(0, 1.0), signed(1, golden)];
        *corner = [DVec3::new(0.0, short, long), DVec3::new(short, long, 0.0), DVec3::new(long, 0.0, short)][at / 4];
    }
    // Three corners 2 apart are a triangle.
    let mut triangles = [[0; 3]; 20];
    let mut next = triangles.iter_mut();
    let near = |a: usize, b: usize| corners[a].distance_squared(corners[b]) < 5.0;
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(c, a) {
                    let outwards = corners[a].dot(corners[b].cross(corners[c])) > 0.0;
                    if let Some(triangle) = next.next() {
                        *triangle = if outwards { [a, b, c] } else { [a, c, b] };
                    }
                }
            }
        }
    }
    (corners, triangles)
}
