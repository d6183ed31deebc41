//! The oracle judges a watertight intersector, and one that leaks.
//!
//! `cargo run --release -p crossbar-gi-base --example watertight` prints the tables of
//! docs/examples/foreign_intersector.md; `tests/watertight.rs` checks the page. Needs no features of the crate.
#![expect(clippy::print_stdout, reason = "an example prints")]

use crossbar::elementary::on_circle;
use crossbar::geom::{Hit, Mesh, Ray, Sides};
use crossbar::oracle::{Oracle, Tolerance, hard_rays};

fn main() {
    print!("{}", tables());
}

/// Counts wrong answers of the two tests for up to 984 rays of each aim at a closed mesh.
pub(crate) fn tables() -> String {
    let mesh = closed_surface(1.37);
    let oracle = Oracle::new(&mesh, Sides::Both, Tolerance::ANY_T);
    let rays = hard_rays(&mesh, 984, 1);
    let mut out = String::new();
    for (name, test) in TESTS {
        let report = oracle.examine(&rays, |ray| nearest(&mesh, ray, test));
        let verdict = if report.leaks() == 0 { "watertight" } else { "leaks" };
        out += &format!("{name}: {verdict}.\n\n{}\n\n", report.by_aim(&rays));
    }
    out
}

/// Intersection of a ray with a triangle, in the arithmetic under test.
pub(crate) type TriangleTest = fn(&Ray, [[f32; 3]; 3]) -> Option<f32>;

/// Intersectors under test.
pub(crate) const TESTS: [(&str, TriangleTest); 2] = [("Woop", woop), ("Moeller-Trumbore", moeller_trumbore)];

/// The first hit among all triangles.
pub(crate) fn nearest(mesh: &Mesh, ray: &Ray, test: impl Fn(&Ray, [[f32; 3]; 3]) -> Option<f32>) -> Option<Hit> {
    let hit = |(triangle, corners)| Some(Hit { triangle, t: test(ray, corners)? });
    let hits = (0..).zip(mesh.iter_corners()).filter_map(hit);
    hits.reduce(|first, hit| if hit.t < first.t { hit } else { first })
}

/// A closed, rippled ring of 1,830 vertices and 3,660 triangles, scaled by `size`.
pub(crate) fn closed_surface(size: f64) -> Mesh {
    const AROUND: u32 = 61;
    const ACROSS: u32 = 30;
    let vertex = |around: u32, across: u32| (around % AROUND) * ACROSS + across % ACROSS;
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for around in 0..AROUND {
        for across in 0..ACROSS {
            let (u, v) = (f64::from(around) / f64::from(AROUND), f64::from(across) / f64::from(ACROSS));
            let ([x, y], [out, up]) = (on_circle(u), on_circle(v));
            let [ripple, lift] = [on_circle(7.0 * u)[1], on_circle(3.0 * u)[0]];
            let thick = 0.35 + 0.08 * ripple;
            let radius = 1.0 + thick * out;
            positions.push([radius * x, radius * y, thick * up + 0.2 * lift].map(|value| (size * value) as f32));
            let [a, b] = [vertex(around, across), vertex(around + 1, across)];
            let [c, d] = [vertex(around + 1, across + 1), vertex(around, across + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh::new(positions, triangles).expect("finite corners, indices in range")
}

/// The watertight test of Woop, Benthin and Wald (Journal of Computer Graphics Techniques 2(1), 2013), both sides: the
/// triangle is sheared so that the ray runs along the z axis; edge functions are in f32, or in f64 if one is zero.
pub(crate) fn woop(ray: &Ray, corners: [[f32; 3]; 3]) -> Option<f32> {
    let (origin, direction) = (ray.origin(), ray.direction());
    // The axis with the largest component of the direction; the other two change places if this component is negative.
    let longest = |best: usize, axis: usize| if direction[axis].abs() > direction[best].abs() { axis } else { best };
    let kz = [1, 2].into_iter().fold(0, longest);
    let (mut kx, mut ky) = ((kz + 1) % 3, (kz + 2) % 3);
    if direction[kz] < 0.0 {
        std::mem::swap(&mut kx, &mut ky);
    }
    let [sx, sy, sz] = [direction[kx] / direction[kz], direction[ky] / direction[kz], 1.0 / direction[kz]];
    let from_origin = corners.map(|corner| [0, 1, 2].map(|axis| corner[axis] - origin[axis]));
    let [a, b, c] = from_origin.map(|at| [at[kx] - sx * at[kz], at[ky] - sy * at[kz]]);
    let edge = |p: [f32; 2], q: [f32; 2]| p[0] * q[1] - p[1] * q[0];
    let mut edges = [edge(c, b), edge(a, c), edge(b, a)];
    if edges.contains(&0.0) {
        let exact = |p: [f32; 2], q: [f32; 2]| {
            let [p, q] = [p, q].map(|at| at.map(f64::from));
            (p[0] * q[1] - p[1] * q[0]) as f32
        };
        edges = [exact(c, b), exact(a, c), exact(b, a)];
    }
    if edges.iter().any(|&edge| edge < 0.0) && edges.iter().any(|&edge| edge > 0.0) {
        return None;
    }
    let [u, v, w] = edges;
    let determinant = u + v + w;
    if determinant == 0.0 {
        return None;
    }
    let [az, bz, cz] = from_origin.map(|at| sz * at[kz]);
    let t = (u * az + v * bz + w * cz) / determinant;
    (t >= 0.0).then_some(t)
}

/// The test of Moeller and Trumbore (Journal of Graphics Tools 2(1), 1997), both sides: barycentric coordinates that
/// each triangle computes from its own edges, so two neighbours round their common edge differently.
pub(crate) fn moeller_trumbore(ray: &Ray, [a, b, c]: [[f32; 3]; 3]) -> Option<f32> {
    let sub = |p: [f32; 3], q: [f32; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let dot = |p: [f32; 3], q: [f32; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let cross =
        |p: [f32; 3], q: [f32; 3]| [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    let [ab, ac, from_a] = [sub(b, a), sub(c, a), sub(ray.origin(), a)];
    let p = cross(ray.direction(), ac);
    let determinant = dot(ab, p);
    if determinant == 0.0 {
        return None;
    }
    let inverse = 1.0 / determinant;
    let u = inverse * dot(from_a, p);
    let q = cross(from_a, ab);
    let v = inverse * dot(ray.direction(), q);
    let t = inverse * dot(ac, q);
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0).then_some(t)
}
