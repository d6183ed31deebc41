//! An independent estimate: path tracing under the same light, with triangles and materials, but without a rule of
//! directions, a matrix, or interpolation between vertices.
//!
//! Per vertex the difference is compared with the standard error of the paths. The error of interpolation between
//! vertices is smaller, since the surfaces are divided finely enough; with `CROSSBAR_FULL` both are finer.

use crate::environment::by_form;
use crossbar::cpca::transfer::{Bounces, Incident, Response, Transfer};
use crossbar::elementary::on_circle;
use crossbar::geom::random::CounterRng;
use crossbar::geom::{Hit, Mesh, Ray};
use crossbar::sphere::{DirectionRule, evaluate, harmonics};
use crossbar::tracer::HostTracer;
use crossbar::transfer::brdf::{Brdf, ExitBasis};
use crossbar::transfer::{LocalFrame, Tangents, Vertices};
use glam::DVec3;

use super::{Soup, caster, mixed, trace};

const ALBEDO: f64 = 0.8;
/// Offset of rays from the surface.
const LIFT: f64 = 1e-4;
/// Random numbers per vertex of a path.
const PER_PLACE: u64 = 2;

/// Number of parts into which each side of a square is divided, and number of paths per vertex.
fn size() -> (u32, u64) {
    by_form((6, 4_000), (16, 40_000))
}

/// The mesh of [`super::step`], with squares divided into `parts` x `parts`. The block comes last.
fn divided_step(parts: u32) -> (Mesh, Vec<u32>) {
    let coarse = super::step();
    let (mut soup, mut materials) = (Soup::default(), Vec::new());
    let corners: Vec<[[f32; 3]; 3]> = coarse.iter_corners().collect();
    for (square, pair) in corners.chunks(2).enumerate() {
        let [corner, side, far] = pair[0].map(|at| DVec3::from(at.map(f64::from)));
        let (across, along) = ((side - corner) / f64::from(parts), (far - side) / f64::from(parts));
        for (i, j) in (0..parts).flat_map(|i| (0..parts).map(move |j| (f64::from(i), f64::from(j)))) {
            soup.quad(corner + i * across + j * along, across, along);
        }
        let is_block = square >= 4;
        materials.extend(std::iter::repeat_n(u32::from(is_block), 2 * (parts * parts) as usize));
    }
    (soup.flat(), materials)
}

/// A cosine-distributed direction around a normal.
fn around(normal: DVec3, [u, turns]: [f64; 2]) -> DVec3 {
    let [x, y] = on_circle(turns);
    LocalFrame::of_normal(normal).to_global(DVec3::new(u.sqrt() * x, u.sqrt() * y, (1.0 - u).sqrt()))
}

/// Traces paths from a position, each with its first direction; returns the radiance along each path after a limited
/// number of diffuse reflections.
struct Paths<'a> {
    mesh: &'a Mesh,
    caster: HostTracer,
    light: &'a [f64],
    random: CounterRng,
}

impl Paths<'_> {
    fn arriving(&self, vertex: u64, place: DVec3, first: &[DVec3], reflections: u64) -> Vec<f64> {
        let mut found = vec![0.0; first.len()];
        let mut alive: Vec<(usize, DVec3, DVec3)> = first.iter().enumerate().map(|(i, &d)| (i, place, d)).collect();
        let mut weight = 1.0;
        for reflection in 0..=reflections {
            let ray = |&(_, from, towards): &(usize, DVec3, DVec3)| {
                Ray::new(from.as_vec3().into(), towards.as_vec3().into()).expect("a ray")
            };
            let rays: Vec<Ray> = alive.iter().map(ray).collect();
            let (hits, _) = self.caster.nearest_all(&rays);
            let mut next = Vec::new();
            for ((path, from, towards), hit) in alive.into_iter().zip(hits) {
                let Some(Hit { triangle, t }) = hit else {
                    found[path] = weight * evaluate(self.light, towards);
                    continue;
                };
                let corners = self.mesh.corners(triangle).expect("a triangle");
                let [a, b, c] = corners.map(|at| DVec3::from(at.map(f64::from)));
                let normal = (b - a).cross(c - a).normalize();
                // The backs of triangles are black.
                if normal.dot(towards) < 0.0 {
                    let random =
                        [0, 1].map(|k| self.random.unit(vertex, path as u64, PER_PLACE * (reflection + 2) + k));
                    next.push((path, from + f64::from(t) * towards + LIFT * normal, around(normal, random)));
                }
            }
            (alive, weight) = (next, weight * ALBEDO);
        }
        found
    }
}

/// Distance of `found` from the mean of the samples, in standard errors of the mean.
fn deviations(found: f64, samples: &[f64]) -> f64 {
    let count = samples.len() as f64;
    let mean = samples.iter().sum::<f64>() / count;
    let variance = samples.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / count;
    (found - mean) / (variance / count).sqrt()
}

/// Root mean square of deviations, and the largest.
fn spread(all: &[f64]) -> [f64; 2] {
    let squares: f64 = all.iter().map(|z| z * z).sum();
    [(squares / all.len() as f64).sqrt(), all.iter().fold(0.0, |most, z| most.max(z.abs()))]
}

/// Vertices that are compared with paths: a few of each kind, away from the edge, where an offset point would lie on
/// the other surface.
fn chosen(vertices: &Vertices, every: usize) -> impl Iterator<Item = usize> + '_ {
    (0..vertices.len()).step_by(every).filter(|&vertex| vertices.positions()[vertex][1] != 1.0)
}

#[test]
fn diffuse_transfer_with_bounces_is_what_paths_bring() {
    let (parts, samples) = size();
    let (mesh, _) = divided_step(parts);
    let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
    let rays = trace(&mesh, &vertices, 95);
    let light = mixed(25);
    let response = [Response::diffuse(ALBEDO, rays.rule()).expect("a response")];
    let transfer = |count| Transfer::new(&vertices, &rays, &response, 5, Bounces::Count(count)).expect("t_p");
    let paths = Paths { mesh: &mesh, caster: caster(&mesh), light: &light, random: CounterRng::new(8) };
    let (two, one) = (transfer(2), transfer(1));
    let [mut right, mut fewer] = [Vec::new(), Vec::new()];
    for vertex in chosen(&vertices, 3) {
        let frame = &vertices.frames()[vertex];
        let place = DVec3::from(vertices.positions()[vertex].map(f64::from)) + LIFT * frame.normal();
        let first = |sample| around(frame.normal(), [0, 1].map(|k| paths.random.unit(vertex as u64, sample, k)));
        let first: Vec<DVec3> = (0..samples).map(first).collect();
        let exit: Vec<f64> =
            paths.arriving(vertex as u64, place, &first, 2).into_iter().map(|radiance| ALBEDO * radiance).collect();
        right.push(deviations(two.radiance(vertex, DVec3::Z, &light), &exit));
        fewer.push(deviations(one.radiance(vertex, DVec3::Z, &light), &exit));
    }
    let ([root, most], [without, _]) = (spread(&right), spread(&fewer));
    assert!(right.len() > 80, "{} vertices", right.len());
    assert!(root < 1.2 && most < 4.5, "{root} standard deviations, {most} at most");
    assert!(without > 1.5 * root, "the last bounce is seen: {without} standard deviations without it");
}

/// A glossy block that sees only diffuse surfaces: the integrals of its exit radiance with harmonics equal `A (M_p l)`,
/// by least squares.
#[test]
fn glossy_transfer_with_a_bounce_is_what_paths_bring() {
    let (parts, samples) = size();
    let (mesh, materials) = divided_step(parts.min(8));
    let vertices = Vertices::with_materials(&mesh, &materials, Tangents::Any).expect("vertices");
    let rays = trace(&mesh, &vertices, 63);
    let light = mixed(16);
    let (exit, views) = (ExitBasis::of_order(4), DirectionRule::hemisphere(95));
    let glossy = Brdf::Phong { albedo: 0.3, specular: 0.5, exponent: 8.0 };
    let response = |brdf| Response::glossy(&brdf, &exit, true, Incident::Directions, rays.rule(), &views);
    let responses = [Brdf::Lambert { albedo: ALBEDO }, glossy].map(|brdf| response(brdf).expect("a response"));
    let transfer = |count| Transfer::new(&vertices, &rays, &responses, 4, Bounces::Count(count)).expect("M_p");
    let paths = Paths { mesh: &mesh, caster: caster(&mesh), light: &light, random: CounterRng::new(9) };
    // Computes A (M_p l) with a rule that is exact for products of two functions.
    let projected = |transfer: &Transfer, vertex: usize| {
        let (rule, mut integrals) = (DirectionRule::hemisphere(6), vec![0.0; exit.len()]);
        for (&view, weight) in rule.directions().iter().zip(rule.weights()) {
            let mut values = vec![0.0; exit.len()];
            harmonics(4, view, &mut values);
            let radiance = weight * transfer.radiance(vertex, view, &light);
            integrals.iter_mut().zip(values).for_each(|(into, y)| *into += y * radiance);
        }
        integrals
    };
    let (one, none) = (transfer(1), transfer(0));
    let [mut right, mut fewer] = [Vec::new(), Vec::new()];
    for vertex in chosen(&vertices, 2).filter(|&vertex| vertices.materials()[vertex] == 1) {
        let frame = &vertices.frames()[vertex];
        let place = DVec3::from(vertices.positions()[vertex].map(f64::from)) + LIFT * frame.normal();
        let random = |sample, dimensions: [u64; 2]| dimensions.map(|k| paths.random.unit(vertex as u64, sample, k));
        let first: Vec<DVec3> = (0..samples).map(|sample| around(frame.normal(), random(sample, [0, 1]))).collect();
        let arriving = paths.arriving(vertex as u64, place, &first, 1);
        // Views are uniform over the hemisphere, light is cosine-distributed: the factor is 2 pi times pi over the
        // number of samples.
        let scale = 2.0 * std::f64::consts::PI * std::f64::consts::PI;
        let mut integrals = vec![Vec::new(); exit.len()];
        for (sample, (&towards, radiance)) in (0..).zip(first.iter().zip(arriving)) {
            let [z, turns] = random(sample, [100, 101]);
            let ([x, y], radius) = (on_circle(turns), (1.0 - z * z).sqrt());
            let view = DVec3::new(radius * x, radius * y, z);
            let mut values = vec![0.0; exit.len()];
            harmonics(4, view, &mut values);
            let exit = scale * glossy.value(view, frame.to_local(towards)) * radiance;
            integrals.iter_mut().zip(values).for_each(|(into, y)| into.push(y * exit));
        }
        for (into, transfer) in [(&mut right, &one), (&mut fewer, &none)] {
            let found = projected(transfer, vertex);
            into.extend(found.iter().zip(&integrals).map(|(&found, samples)| deviations(found, samples)));
        }
    }
    let ([root, most], [without, _]) = (spread(&right), spread(&fewer));
    assert!(right.len() > 500, "{} numbers", right.len());
    assert!(root < 1.15 && most < 5.0, "{root} standard deviations, {most} at most");
    assert!(without > 1.3 * root, "the bounce is seen: {without} standard deviations without it");
}
