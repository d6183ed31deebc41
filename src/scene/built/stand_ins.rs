//! Stand-ins for the models of the subsurface paper, which are not at hand: as many faces as it prints, shapes that
//! resemble them a little.
//!
//! Each is a geodesic sphere, bent and dented. A closed mesh has an even number of faces, so the bunny, with an odd
//! one, is open: at the bottom.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::elementary::exp;
use crate::geom::Mesh;
use crate::geom::vector::{narrow, unit};

/// A stand-in that can be asked for by name.
struct StandIn {
    name: &'static str,
    what: &'static str,
    build: fn() -> Mesh,
}

const STAND_INS: &[StandIn] = &[
    StandIn { name: "stand-in-bunny", what: "69,451 faces, open at the bottom", build: bunny },
    StandIn { name: "stand-in-dolphin", what: "21,952 faces, closed, long and thin in places", build: dolphin },
    StandIn { name: "stand-in-head", what: "7,232 faces, closed", build: head },
];

/// The names of all stand-ins, in alphabetical order.
pub fn names() -> impl Iterator<Item = &'static str> {
    STAND_INS.iter().map(|entry| entry.name)
}

/// What a stand-in is, in one line.
pub fn description(name: &str) -> Option<&'static str> {
    STAND_INS.iter().find(|entry| entry.name == name).map(|entry| entry.what)
}

/// The stand-in of a name.
pub fn build(name: &str) -> Option<Mesh> {
    STAND_INS.iter().find(|entry| entry.name == name).map(|entry| (entry.build)())
}

/// A stand-in for the paper's head: 7,232 faces, closed, about 2.3 units high.
pub fn head() -> Mesh {
    let lobes = [
        Lobe { toward: [0.0, -1.0, -0.1], height: 0.22, narrow: 45.0 },
        Lobe { toward: [0.35, -1.0, 0.2], height: -0.08, narrow: 40.0 },
        Lobe { toward: [-0.35, -1.0, 0.2], height: -0.08, narrow: 40.0 },
        Lobe { toward: [0.0, -1.0, -0.5], height: -0.05, narrow: 60.0 },
        Lobe { toward: [1.0, 0.1, 0.0], height: 0.2, narrow: 60.0 },
        Lobe { toward: [-1.0, 0.1, 0.0], height: 0.2, narrow: 60.0 },
        Lobe { toward: [0.0, 0.4, -1.0], height: 0.3, narrow: 6.0 },
    ];
    let shape = |toward: DVec3| toward * bumped(toward, &lobes) * DVec3::new(0.75, 0.95, 1.05);
    mesh_of(19, &shape, |sphere| sphere.divide_largest(6, &shape))
}

/// A stand-in for the paper's dolphin: 21,952 faces, closed, about 4 units long, with thin fins.
pub fn dolphin() -> Mesh {
    let fins = [
        Lobe { toward: [0.1, 0.0, 1.0], height: 0.5, narrow: 90.0 },
        Lobe { toward: [0.5, 0.8, -0.5], height: 0.8, narrow: 120.0 },
        Lobe { toward: [0.5, -0.8, -0.5], height: 0.8, narrow: 120.0 },
        Lobe { toward: [-1.0, 0.25, 0.0], height: 0.4, narrow: 150.0 },
        Lobe { toward: [-1.0, -0.25, 0.0], height: 0.4, narrow: 150.0 },
    ];
    let shape = |toward: DVec3| {
        // Thick in front of the middle, thin towards the tail, and bent upwards at both ends.
        let girth = 0.18 + 0.22 * (1.0 + toward.x) * (1.2 - toward.x);
        let at = toward * bumped(toward, &fins) * DVec3::new(2.0, girth, girth);
        at + DVec3::Z * (0.08 * at.x * at.x)
    };
    mesh_of(33, &shape, |sphere| sphere.divide_largest(86, &shape))
}

/// A stand-in for the paper's bunny: 69,451 faces, open at the bottom, about 2.5 units high.
pub fn bunny() -> Mesh {
    let lobes = [
        Lobe { toward: [0.8, 0.0, 0.7], height: 0.45, narrow: 9.0 },
        Lobe { toward: [0.42, 0.28, 1.0], height: 0.75, narrow: 110.0 },
        Lobe { toward: [0.42, -0.28, 1.0], height: 0.75, narrow: 110.0 },
        Lobe { toward: [-1.0, 0.0, -0.2], height: 0.15, narrow: 40.0 },
        Lobe { toward: [0.4, 0.6, -0.8], height: 0.15, narrow: 20.0 },
        Lobe { toward: [0.4, -0.6, -0.8], height: 0.15, narrow: 20.0 },
    ];
    let fur = |toward: DVec3| {
        let wave = |at: f64| 16.0 * at * at * at - 12.0 * at;
        1.0 + 0.004 * wave(toward.x) * wave(toward.y) + 0.003 * wave(toward.z)
    };
    let shape = |toward: DVec3| toward * (bumped(toward, &lobes) * fur(toward)) * DVec3::new(1.1, 0.9, 1.0);
    mesh_of(60, &shape, |sphere| sphere.open_at_the_bottom(69_451))
}

/// A bump of a sphere, or with a negative height a dent.
struct Lobe {
    toward: [f64; 3],
    height: f64,
    /// How quickly it falls off to its sides.
    narrow: f64,
}

/// The radius of a bumped unit sphere.
fn bumped(toward: DVec3, lobes: &[Lobe]) -> f64 {
    let height = |lobe: &Lobe| {
        let middle = unit(DVec3::from(lobe.toward)).unwrap_or(DVec3::Z);
        lobe.height * exp(lobe.narrow * (toward.dot(middle) - 1.0))
    };
    1.0 + lobes.iter().map(height).sum::<f64>()
}

/// The geodesic sphere of `20 * parts * parts` faces, changed, with every direction in its place.
fn mesh_of(parts: u32, shape: &dyn Fn(DVec3) -> DVec3, change: impl FnOnce(&mut Sphere)) -> Mesh {
    let mut sphere = Sphere::new(parts);
    change(&mut sphere);
    let positions = sphere.directions.iter().map(|&toward| narrow(shape(toward))).collect();
    Mesh::new(positions, sphere.faces).expect("indices are those of directions, and shapes are finite")
}

/// A triangulated unit sphere, fronts outwards.
struct Sphere {
    directions: Vec<DVec3>,
    faces: Vec<[u32; 3]>,
}

impl Sphere {
    /// An icosahedron with each edge in so many parts.
    fn new(parts: u32) -> Self {
        let (corners, triangles) = icosahedron();
        let mut known = BTreeMap::new();
        let mut sphere = Self { directions: Vec::new(), faces: Vec::new() };
        for triangle in triangles {
            let mut vertex = |counts: [u32; 3]| {
                // In one order whatever triangle it is seen from, so that shared points are the same.
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

    /// Divides the faces that are largest in a shape into three each.
    fn divide_largest(&mut self, count: usize, shape: &dyn Fn(DVec3) -> DVec3) {
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

    /// Leaves out the lowest faces, so that so many are left.
    fn open_at_the_bottom(&mut self, left: usize) {
        let height = |face: &[u32; 3]| face.iter().map(|&corner| self.directions[corner as usize].z).sum::<f64>();
        let mut by_height: Vec<(f64, usize)> = self.faces.iter().map(height).zip(0..).collect();
        by_height.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut kept: Vec<usize> = by_height.into_iter().take(left).map(|(_, face)| face).collect();
        kept.sort_unstable();
        self.faces = kept.into_iter().map(|face| self.faces[face]).collect();
    }
}

/// Corners and triangles, fronts outwards.
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
