//! Hits do not depend on the engine's schedule.

use crate::support::{bits, profile};
use crossbar::geom::exact::Sides;
use crossbar::geom::random::CounterRng;
use crossbar::geom::teapot::teapot;
use crossbar::geom::{Mesh, Ray};
use crossbar::ray_engine::engine::{EngineParameters, RayEngine, Readback};
use crossbar::ray_engine::ray_tree::RayTreeParameters;
use crossbar::scene::Camera;
use crossbar::tracer::HostTracer;
use crossbar::tracer::octree::OctreeParameters;
use refsim::event::{Event, HostOperation};
use refsim::machine::ExecutorKind;

const SMALL: OctreeParameters = OctreeParameters { most_triangles: 4, most_depth: 6 };

/// Eye rays, and rays between random points.
fn rays(count: usize) -> Vec<Ray> {
    let mut rays = Camera::teapot(32, 32).expect("a camera").rays();
    let random = CounterRng::new(21);
    for i in 0.. {
        if rays.len() >= count {
            break;
        }
        let point = |sample| [0, 1, 2].map(|k| (6.0 * random.unit(i, sample, k) - 3.0) as f32);
        let (a, b) = (point(0), point(1));
        rays.extend(Ray::new(a, [b[0] - a[0], b[1] - a[1], b[2] - a[2]]));
    }
    rays
}

fn trace<'a>(mesh: &'a Mesh, rays: &[Ray], parameters: EngineParameters) -> (Vec<Option<(u32, u32)>>, RayEngine<'a>) {
    let mut engine = RayEngine::new(mesh, profile("ideal-fp32"), ExecutorKind::Batch, parameters).expect("an engine");
    let hits = engine.trace(rays).expect("the card works");
    (bits(&hits), engine)
}

#[test]
fn schedules_change_counts_and_never_a_hit() {
    let (mesh, rays) = (teapot(3).expect("a teapot"), rays(3000));
    for sides in [Sides::Front, Sides::Both] {
        let base = EngineParameters { octree: SMALL, sides, ..EngineParameters::default() };
        let truth = bits(&HostTracer::with_octree(&mesh, SMALL, sides).nearest_all(&rays).0);
        let variants = [
            base.clone(),
            EngineParameters { card: false, ..base.clone() },
            EngineParameters { rays: 16, ..base.clone() },
            EngineParameters { rays: 100_000, ..base.clone() },
            EngineParameters { waiting: 300, tree: RayTreeParameters { bucket: 7, merge: 5 }, ..base.clone() },
            EngineParameters { triangles: 1..=40, rays: 64, ..base.clone() },
            EngineParameters { rays: 16, waiting: 500, readback: Readback::Asynchronous { passes: 3 }, ..base.clone() },
            EngineParameters { readback: Readback::InfinitelyFast, ..base.clone() },
            EngineParameters { cull: false, beams: false, shuffle: None, ..base.clone() },
            EngineParameters { shuffle: Some(99), rays: 16, ..base.clone() },
        ];
        for (i, parameters) in variants.into_iter().enumerate() {
            let (hits, engine) = trace(&mesh, &rays, parameters.clone());
            assert_eq!(hits, truth, "variant {i}, {sides:?}");
            let counts = engine.counts();
            assert_eq!(counts.rays, rays.len() as u64);
            assert!(parameters.cull || counts.culled == 0, "variant {i}: {counts:?}");
            assert_eq!(counts.rays_on_card > 0, parameters.card && parameters.rays < 1000, "variant {i}: {counts:?}");
        }
    }
}

#[test]
fn order_and_bundles_do_not_show() {
    let (mesh, rays) = (teapot(3).expect("a teapot"), rays(2000));
    let parameters = EngineParameters { octree: SMALL, rays: 32, ..EngineParameters::default() };
    let (forward, _) = trace(&mesh, &rays, parameters.clone());
    let reversed: Vec<Ray> = rays.iter().rev().copied().collect();
    let (mut backward, _) = trace(&mesh, &reversed, parameters.clone());
    backward.reverse();
    assert_eq!(forward, backward);
    let mut engine = RayEngine::new(&mesh, profile("ideal-fp32"), ExecutorKind::Batch, parameters).expect("an engine");
    let mut hits = vec![None; rays.len()];
    for bundle in rays.chunks(77) {
        engine.submit(bundle).expect("the card works");
    }
    engine.finish().expect("the card works");
    for (ticket, hit) in engine.take_answers() {
        hits[ticket.0 as usize] = hit;
    }
    assert_eq!(forward, bits(&hits));
}

#[test]
fn rays_wait_until_the_cache_is_full_or_a_result_is_needed() {
    let (mesh, rays) = (teapot(3).expect("a teapot"), rays(2000));
    let parameters = EngineParameters { octree: SMALL, waiting: 1500, ..EngineParameters::default() };
    let mut engine = RayEngine::new(&mesh, profile("ideal-fp32"), ExecutorKind::Batch, parameters).expect("an engine");
    engine.submit(&rays[..1499]).expect("the card works");
    assert!(engine.take_answers().is_empty() && engine.counts().passes == 0, "there is room for one more");
    engine.submit(&rays[1499..1600]).expect("the card works");
    let early = engine.take_answers().len();
    assert!(early > 0, "the fullest bucket has left");
    assert!(early < 1000, "and no more than had to: {early} answers");
    engine.finish().expect("the card works");
    assert_eq!(early + engine.take_answers().len(), 1600, "whatever waits is answered when results are needed");
    assert_eq!(engine.counts().rays, 1600);
}

#[test]
fn every_pass_is_in_the_log_with_the_work_around_it() {
    let (mesh, rays) = (teapot(3).expect("a teapot"), rays(2000));
    let parameters = EngineParameters { octree: SMALL, rays: 32, record: true, ..EngineParameters::default() };
    let (_, mut engine) = trace(&mesh, &rays, parameters);
    let (counts, log) = (engine.counts(), engine.take_log());
    let draws = log.iter().filter(|event| matches!(event, Event::Draw(_))).count() as u64;
    assert_eq!(draws, counts.passes);
    let host = |kind: HostOperation| -> u64 {
        let of = |event: &Event| match event {
            Event::Host(work) if work.kind == kind => work.operations,
            _ => 0,
        };
        log.iter().map(of).sum()
    };
    assert_eq!(host(HostOperation::RayTriangleTest), counts.host_tests);
    assert_eq!(host(HostOperation::OctreeCell), counts.traversal.cells + counts.beam_cells);
    assert_eq!(host(HostOperation::RayPacked), counts.pass_rays);
    assert_eq!(host(HostOperation::ResultRead), counts.pass_rays);
    assert!(counts.pass_rays >= 32 * counts.passes / 2 && counts.passes > 0);
}

#[test]
fn a_million_rays_fit_in_200_megabytes() {
    let mesh = teapot(3).expect("a teapot");
    let waiting = EngineParameters { waiting: usize::MAX, ..EngineParameters::default() };
    let mut engine = RayEngine::new(&mesh, profile("ideal-fp32"), ExecutorKind::Batch, waiting).expect("an engine");
    let bundle = rays(10_000);
    for _ in 0..100 {
        engine.submit(&bundle).expect("nothing is drawn yet");
    }
    let bytes = engine.bytes();
    assert!(bytes <= 200_000_000, "{bytes} B for a million rays");
}
