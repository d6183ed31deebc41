//! Tests the Ray Engine on every kind of card and on every executor.

use crate::support::{bits, profile};
use crossbar::geom::exact::Sides;
use crossbar::geom::random::CounterRng;
use crossbar::geom::teapot::teapot;
use crossbar::geom::{Mesh, Ray};
use crossbar::ray_engine::Crossbar;
use crossbar::ray_engine::engine::{EngineParameters, RayEngine};
use crossbar::scene::Camera;
use refsim::machine::ExecutorKind;

/// Part of the teapot, and rays from more than one origin toward its triangles.
fn scene() -> (Mesh, Vec<Ray>) {
    let whole = teapot(2).expect("a teapot");
    let mesh = Mesh::new(whole.positions().to_vec(), whole.triangles()[..96].to_vec()).expect("a part of it");
    let (random, eye) = (CounterRng::new(3), Camera::teapot(1, 1).expect("a camera").rays()[0].origin());
    let ray = |i: u64| {
        let [a, b, c] = mesh.corners((i / 4) as u32).expect("a triangle");
        let [p, q] = [0, 1].map(|k| 0.5 * random.unit(i, 0, k) as f32);
        let from = [0, 1, 2].map(|k| eye[k] + 0.01 * random.unit(i, 1, k as u64) as f32);
        let to = [0, 1, 2].map(|k| a[k] + p * (b[k] - a[k]) + q * (c[k] - a[k]));
        Ray::new(from, [0, 1, 2].map(|k| to[k] - from[k])).expect("a ray")
    };
    let rays = (0..384).map(ray).collect();
    (mesh, rays)
}

/// One GPU cell for the whole scene, and one pass for all rays: then program, rays and units equal the crossbar's.
#[test]
fn a_pass_of_the_engine_finds_what_the_crossbar_finds() {
    let (mesh, rays) = scene();
    for device in ["r200", "r300", "r350", "nv30", "nv35", "ideal-fp32", "ideal-fp24", "ideal-fp16", "ideal-s3.12"] {
        for sides in [Sides::Front, Sides::Both] {
            let crossbar = Crossbar::new(profile(device), ExecutorKind::Batch).all_pairs(true);
            let mut seen = 0;
            for bundle in rays.chunks(64) {
                let parameters =
                    EngineParameters { triangles: 1..=1000, rays: 64, sides, ..EngineParameters::default() };
                let mut engine =
                    RayEngine::new(&mesh, profile(device), ExecutorKind::Batch, parameters).expect("an engine");
                let found = engine.trace(bundle).expect("the card works");
                assert_eq!(engine.counts().pass_rays, 64, "{device}: one pass of all");
                let wanted = crossbar.intersect_list(&mesh, bundle, sides).expect("the card works");
                assert_eq!(bits(&found), bits(&wanted), "{device} {sides:?}");
                seen += found.iter().flatten().count();
            }
            assert!(seen > 100, "{device} {sides:?}: {seen} hits");
        }
    }
}
