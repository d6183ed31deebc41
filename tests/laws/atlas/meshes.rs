//! Small meshes of many kinds.

use crossbar::elementary::on_circle;
use crossbar::geom::Mesh;
use crossbar::geom::random::CounterRng;
use proptest::prelude::*;

/// A mesh with the properties on which laws depend.
#[derive(Debug, Clone)]
pub(super) struct Sample {
    pub(super) mesh: Mesh,
    /// At most two faces per edge.
    pub(super) manifold: bool,
    /// Closed, connected, without handles.
    pub(super) sphere: bool,
}

type Shape = (Vec<[f32; 3]>, Vec<[u32; 3]>);

/// A grid of `columns` x `rows` quads; each direction may wrap around. `place` maps grid coordinates to a position.
fn grid([columns, rows]: [u32; 2], wrapped: [bool; 2], place: impl Fn(f64, f64) -> [f64; 3]) -> Shape {
    let across = columns + u32::from(!wrapped[0]);
    let down = rows + u32::from(!wrapped[1]);
    let vertex = |column: u32, row: u32| (row % down) * across + column % across;
    let mut shape = Shape::default();
    for row in 0..down {
        for column in 0..across {
            let at = place(f64::from(column) / f64::from(columns), f64::from(row) / f64::from(rows));
            shape.0.push(at.map(|value| value as f32));
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [vertex(column, row), vertex(column + 1, row)];
            let [c, d] = [vertex(column, row + 1), vertex(column + 1, row + 1)];
            shape.1.extend([[a, b, d], [a, d, c]]);
        }
    }
    shape
}

/// A bumpy sphere: rings between two poles.
fn sphere([around, down]: [u32; 2], bump: f64) -> Shape {
    let mut shape = Shape::default();
    let pole = |z: f32| [0.0, 0.0, z];
    shape.0.extend([pole(1.0), pole(-1.0)]);
    for ring in 1..down {
        let [z, radius] = on_circle(0.5 * f64::from(ring) / f64::from(down));
        for at in 0..around {
            let [x, y] = on_circle(f64::from(at) / f64::from(around));
            let size = 1.0 + bump * on_circle(f64::from(at * ring) / 7.0)[0];
            shape.0.push([x * radius, y * radius, z].map(|value| (value * size) as f32));
        }
    }
    let vertex = |ring: u32, at: u32| 2 + (ring - 1) * around + at % around;
    for at in 0..around {
        shape.1.push([0, vertex(1, at), vertex(1, at + 1)]);
        shape.1.push([1, vertex(down - 1, at + 1), vertex(down - 1, at)]);
        for ring in 1..down - 1 {
            let [a, b] = [vertex(ring, at), vertex(ring, at + 1)];
            let [c, d] = [vertex(ring + 1, at), vertex(ring + 1, at + 1)];
            shape.1.extend([[a, c, d], [a, d, b]]);
        }
    }
    shape
}

fn torus(size: [u32; 2], thin: f64) -> Shape {
    grid(size, [true, true], |u, v| {
        let ([c, s], [x, z]) = (on_circle(u), on_circle(v));
        let radius = 1.0 + thin * x;
        [radius * c, radius * s, thin * z]
    })
}

/// Random triangles between random vertices: many share edges, some are degenerate, some are repeated.
fn soup(vertices: u32, faces: u32, seed: u64) -> Shape {
    let random = CounterRng::new(seed);
    let position = |vertex: u32| [0, 1, 2].map(|axis| (random.unit(vertex.into(), 0, axis) * 4.0).floor() as f32 / 2.0);
    let corner = |face: u32, at: u64| (random.unit(face.into(), 1, at) * f64::from(vertices)) as u32;
    let positions = (0..vertices).map(position).collect();
    (positions, (0..faces).map(|face| [0, 1, 2].map(|at| corner(face, at))).collect())
}

fn mesh_of((positions, triangles): Shape) -> Mesh {
    Mesh::new(positions, triangles).expect("a mesh")
}

/// Several shapes side by side.
fn together(shapes: Vec<Shape>) -> Shape {
    let mut all = Shape::default();
    for (place, (positions, triangles)) in shapes.into_iter().enumerate() {
        let first = all.0.len() as u32;
        all.0.extend(positions.into_iter().map(|[x, y, z]| [x + 3.0 * place as f32, y, z]));
        all.1.extend(triangles.into_iter().map(|corners| corners.map(|corner| first + corner)));
    }
    all
}

fn sheet(size: [u32; 2], seed: u64) -> Shape {
    let random = CounterRng::new(seed);
    grid(size, [false, false], |u, v| {
        let height = random.unit((u * 64.0) as u64, (v * 64.0) as u64, 0);
        [u * f64::from(size[0]) / 4.0, v, 0.2 * height]
    })
}

/// Meshes that are closed, open, with handles, in several parts, or unordered. All have a positive area.
pub(super) fn samples() -> impl Strategy<Value = Sample> {
    let sized = |least: u32, most: u32| (least..most, least..most).prop_map(|(a, b)| [a, b]);
    let plain = |shape: Shape, sphere: bool| Sample { mesh: mesh_of(shape), manifold: true, sphere };
    prop_oneof![
        (sized(3, 12), 0.0..0.4).prop_map(move |(size, bump)| plain(sphere(size, bump), true)),
        (sized(1, 12), any::<u64>()).prop_map(move |(size, seed)| plain(sheet(size, seed), false)),
        (sized(3, 12), 0.1..0.6).prop_map(move |(size, thin)| plain(torus(size, thin), false)),
        (sized(3, 8), sized(1, 6), sized(3, 6), any::<u64>()).prop_map(move |(a, b, c, seed)| {
            plain(together(vec![sphere(a, 0.1), sheet(b, seed), torus(c, 0.3), sphere([3, 2], 0.0)]), false)
        }),
        (4_u32..20, 1_u32..120, any::<u64>())
            .prop_map(|(vertices, faces, seed)| Sample {
                mesh: mesh_of(soup(vertices, faces, seed)),
                manifold: false,
                sphere: false
            })
            .prop_filter("some area", |sample| (0..sample.mesh.len() as u32).any(|face| sample.mesh.area(face) > 0.0)),
    ]
}

/// The smallest power of two that is the side of an atlas with a texel for each face.
pub(super) fn least_side(mesh: &Mesh) -> u32 {
    let mut side = 1_u32;
    while (side * side) < mesh.len() as u32 {
        side *= 2;
    }
    side
}

/// A mesh, and the side of an atlas: the smallest side that fits, or two or four times as long.
pub(super) fn atlases() -> impl Strategy<Value = (Sample, u32)> {
    (samples(), 0_u32..3).prop_map(|(sample, more)| {
        let side = least_side(&sample.mesh) << more;
        (sample, side)
    })
}

/// A round sphere of 2 `around` (`down` - 1) faces.
pub(super) fn round(around: u32, down: u32) -> Mesh {
    mesh_of(sphere([around, down], 0.0))
}

/// A torus of 2 `size[0]` `size[1]` faces.
pub(super) fn ring(size: [u32; 2]) -> Mesh {
    mesh_of(torus(size, 0.4))
}
