//! Culling in the vertex program loses no hit: a pass with culling finds, bit for bit, the hits of a pass that draws
//! everything.

use crate::environment::by_form;
use crate::support::{bits, profile, soup};
use crossbar::geom::exact::Sides;
use crossbar::geom::random::CounterRng;
use crossbar::geom::{Mesh, Ray};
use crossbar::ray_engine::{Answer, Crossbar, RayBatch};
use proptest::prelude::*;
use refsim::machine::ExecutorKind;

/// Numbers from -1 to 1; 0, -1 and 1 occur more often than by chance.
fn coordinate(random: CounterRng, i: u64, k: u64) -> f64 {
    match random.bits(i, 9, k) % 8 {
        0 => 0.0,
        1 => 1.0,
        2 => -1.0,
        _ => 2.0 * random.unit(i, 10, k) - 1.0,
    }
}

fn point(random: CounterRng, i: u64) -> [f64; 3] {
    [0, 1, 2].map(|k| coordinate(random, i, k))
}

fn add(a: [f64; 3], b: [f64; 3], by: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] + by * b[k])
}

/// Triangles of all kinds: plain, tiny, huge, needles, points, lines, and triangles with corners of their neighbors.
fn triangles(random: CounterRng, count: u64, size: f64, wild: bool) -> Mesh {
    let mut positions: Vec<[f32; 3]> = Vec::new();
    for i in 0..count {
        let at = point(random, 100 + i);
        let kind = random.bits(i, 0, 0) % 10;
        let scale = match kind {
            _ if !wild => 0.5,
            0 => 1e-5,
            1 => 1e-2,
            2 => 50.0,
            3 => 1e6,
            _ => 0.5,
        };
        let corner = |k: u64| add(at, point(random, 1000 + 3 * i + k), scale);
        let mut corners = [corner(0), corner(1), corner(2)];
        match kind {
            4 => corners[2] = add(corners[0], add(corners[1], corners[0], -1.0), 0.5),
            5 => corners[2] = add(corners[1], point(random, 2000 + i), 1e-6),
            6 => corners[1] = corners[0],
            _ => {}
        }
        let touching = kind >= 7 && positions.len() >= 3;
        for (k, corner) in corners.into_iter().enumerate() {
            let shared = positions.len().checked_sub(2).map(|last| positions[last]).filter(|_| touching && k == 0);
            positions.push(shared.unwrap_or(corner.map(|x| (x * size) as f32)));
        }
    }
    soup(positions)
}

/// Rays that start in a box and mostly point into a cone; some aim at corners and edges, and some start on triangles.
fn rays(random: CounterRng, mesh: &Mesh, size: f64, [origins, directions]: [f64; 2]) -> RayBatch {
    let (eye, at) = (add([0.0; 3], point(random, 5000), 3.0), point(random, 5001));
    let mut all = Vec::new();
    for i in 0..64_u64 {
        let id = random.bits(i, 1, 0) as u32 % mesh.len() as u32;
        let on = mesh.corners(id).expect("a triangle").map(|c| c.map(|x| f64::from(x) / size));
        let mix = [0, 1].map(|k| if random.bits(i, 2, k).is_multiple_of(3) { 0.0 } else { random.unit(i, 3, k) });
        let target = add(add(on[0], add(on[1], on[0], -1.0), mix[0]), add(on[2], on[0], -1.0), mix[1] * (1.0 - mix[0]));
        let mut origin = add(eye, point(random, 6000 + i), origins);
        if origins > 0.0 && random.bits(i, 4, 0).is_multiple_of(5) {
            origin = target;
        }
        let aimed = directions > 0.5 && random.bits(i, 5, 0).is_multiple_of(2) && origin != target;
        let middle = if aimed { add(target, origin, -1.0) } else { add(at, eye, -1.0) };
        let d = if aimed { middle } else { add(middle, point(random, 7000 + i), directions) };
        let single = |v: [f64; 3], by: f64| v.map(|x| (x * by) as f32);
        let ray = Ray::new(single(origin, size), single(d, 1.0));
        all.push(ray.unwrap_or_else(|_| Ray::new(single(origin, size), [1.0, 0.0, -0.0]).expect("a ray")));
    }
    RayBatch::new(16, 4, all).expect("64 rays")
}

fn drawn(answer: &Answer) -> u64 {
    answer.events.fragments.generated / 64
}

const DEVICES: [&str; 7] = ["ideal-fp32", "r200", "r300", "nv35", "ideal-s3.12", "ideal-fp16", "ideal-s2.8"];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(by_form(400, 20_000)))]

    #[test]
    fn a_pass_that_culls_finds_what_one_that_does_not_finds(
        seed in any::<u64>(), device in 0..DEVICES.len(), both in any::<bool>(),
        size in prop::sample::select(vec![1.0, 1.0, 1.0, 1e-3, 37.0, 1e6, 1e-12, 1e25]),
        origins in prop::sample::select(vec![0.0, 0.01, 0.3, 3.0]),
        directions in prop::sample::select(vec![0.0, 0.02, 0.3, 5.0]),
    ) {
        let random = CounterRng::new(seed);
        let mesh = triangles(random, 12, size, true);
        let rays = rays(random, &mesh, size, [origins, directions]);
        let all: Vec<u32> = (0..mesh.len() as u32).collect();
        let crossbar = Crossbar::new(profile(DEVICES[device]), ExecutorKind::Batch);
        let sides = if both { Sides::Both } else { Sides::Front };
        let pass = |cull| crossbar.intersect_pass(&mesh, &all, &rays, sides, cull).expect("the card works");
        let (plain, culled) = (pass(false), pass(true));
        prop_assert_eq!(bits(&culled.hits), bits(&plain.hits), "{} {:?}", DEVICES[device], sides);
        prop_assert_eq!(drawn(&plain), 12);
    }
}

/// Culling removes enough triangles; otherwise the test above would be vacuous.
#[test]
fn much_of_what_can_be_culled_is() {
    for (device, least) in [("ideal-fp32", 400), ("r300", 400), ("r200", 200)] {
        let crossbar = Crossbar::new(profile(device), ExecutorKind::Batch);
        for (sides, share) in [(Sides::Front, 1), (Sides::Both, 2)] {
            let mut gone = 0;
            for seed in 0..60 {
                let random = CounterRng::new(seed);
                let mesh = triangles(random, 12, 1.0, false);
                let rays = rays(random, &mesh, 1.0, [0.0, 0.02]);
                let all: Vec<u32> = (0..12).collect();
                let answer = crossbar.intersect_pass(&mesh, &all, &rays, sides, true).expect("the card works");
                gone += 12 - drawn(&answer);
            }
            assert!(gone * share >= least, "{device} {sides:?}: {gone} of 720");
        }
    }
}
