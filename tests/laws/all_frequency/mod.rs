//! System 5: light in cube texels, visibility in fine directions, transfer in Haar wavelets.

mod bad_input;
mod baselines;
mod card;
mod coding;
mod file;
mod geometry;
mod haar;
mod light;
mod linear_basis;
mod orientation;
mod reflectance;
mod shadows;
mod transfer;
mod visibility;

use crate::support::{close, flat, in_threads};
use crossbar::all_frequency::factor::{FactorSampling, Factorization, Lobe, ProductFactors, Supersamples};
use crossbar::geom::random::CounterRng;
use crossbar::geom::{Mesh, Sides};
use crossbar::sphere::CUBE_FACES;
use crossbar::tracer::HostTracer;
use crossbar::transfer::visibility::VisibilityMaps;
use crossbar::transfer::{Tangents, Vertices};
use glam::DVec3;

/// A triangle at the origin with this normal, too small to affect visibility; its first corner is vertex 0.
fn observer(normal: DVec3) -> [[f32; 3]; 3] {
    let x = normal.cross(if normal.x.abs() < 0.6 { DVec3::X } else { DVec3::Y }).normalize() * 1e-4;
    let y = normal.cross(x);
    [[0.0; 3], x.as_vec3().into(), y.as_vec3().into()]
}

/// Triangles at any position, of any size and orientation.
fn clutter(seed: u64, count: u64, size: f64) -> Mesh {
    let random = CounterRng::new(seed);
    let corner = |triangle: u64, corner: u64| {
        [0, 1, 2].map(|k| {
            let place = 2.0 * random.unit(triangle, 0, k) - 1.0;
            (place + size * (random.unit(triangle, 1 + corner, k) - 0.5)) as f32
        })
    };
    flat((0..count).flat_map(|triangle| [0, 1, 2].map(|at| corner(triangle, at))).collect())
}

/// Factors of Cook and Torrance's model on small maps.
fn factors(terms: usize) -> ProductFactors {
    let sampling = FactorSampling { side: 8, supersamples: Supersamples::NONE, ..FactorSampling::default() };
    let table = sampling.table(&Lobe::cook_torrance(0.4, 0.5), &mut |_, _| ()).expect("a table");
    Factorization::new(&table, terms).expect("terms").factors(terms)
}

fn vertices(mesh: &Mesh) -> Vertices {
    Vertices::new(mesh, Tangents::Any).expect("vertices")
}

fn all(vertices: &Vertices) -> Vec<u32> {
    (0..vertices.len() as u32).collect()
}

fn trace(mesh: &Mesh, vertices: &Vertices, of: &[u32]) -> VisibilityMaps {
    VisibilityMaps::trace(vertices, of, &mut HostTracer::new(mesh, Sides::Both), &mut |_, _| ()).expect("traced")
}

/// The texel of a cube that contains a direction; the largest component selects the face.
fn texel_of(direction: DVec3, side: usize) -> usize {
    let face = (0..6)
        .max_by(|&a, &b| {
            CUBE_FACES[a].center.dot(direction).total_cmp(&CUBE_FACES[b].center.dot(direction)).then(b.cmp(&a))
        })
        .expect("six faces");
    let axes = CUBE_FACES[face];
    let place = |axis: DVec3| {
        ((axis.dot(direction) / axes.center.dot(direction) + 1.0) / 2.0 * side as f64).clamp(0.0, side as f64 - 1.0)
            as usize
    };
    (face * side + place(axes.down)) * side + place(axes.right)
}
