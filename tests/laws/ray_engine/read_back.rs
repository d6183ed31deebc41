//! Read-back formats change bytes and work, and never a hit.

use approx::abs_diff_eq;
use crossbar::geom::exact::Sides;
use crossbar::geom::teapot::teapot;
use crossbar::geom::{Mesh, Ray};
use crossbar::ray_engine::Outputs;
use crossbar::ray_engine::engine::{EngineParameters, LocatedHit, RayEngine};
use crossbar::scene::Camera;
use crossbar::tracer::HostTracer;
use crossbar::tracer::octree::OctreeParameters;
use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::ExecutorKind;

const SMALL: OctreeParameters = OctreeParameters { most_triangles: 4, most_depth: 6 };

fn scene() -> (Mesh, Vec<Ray>) {
    (teapot(3).expect("a teapot"), Camera::teapot(48, 48).expect("a camera").rays())
}

fn engine<'a>(mesh: &'a Mesh, device: &str, parameters: EngineParameters) -> RayEngine<'a> {
    let parameters = EngineParameters { octree: SMALL, rays: 32, record: true, ..parameters };
    RayEngine::new(mesh, Profile::named(device).expect("a profile"), ExecutorKind::Batch, parameters)
        .expect("an engine")
}

/// Bytes read back per ray of a pass.
fn gamma(engine: &mut RayEngine<'_>) -> f64 {
    let bytes = |event: &Event| match event {
        Event::ReadBack { bytes, .. } => *bytes,
        _ => 0,
    };
    let total: u64 = engine.take_log().iter().map(bytes).sum();
    total as f64 / engine.counts().pass_rays as f64
}

#[test]
fn gamma_is_what_the_book_says_and_hits_are_the_same() {
    let (mesh, rays) = scene();
    for sides in [Sides::Front, Sides::Both] {
        let truth = HostTracer::with_octree(&mesh, SMALL, sides).nearest_all(&rays).0;
        for (device, outputs, small_ids, bytes) in [
            ("ideal-fp32", Outputs::IdAndT, false, 8.0),
            ("ideal-fp32", Outputs::IdAndT, true, 5.0),
            ("ideal-fp32", Outputs::Id, false, 4.0),
            ("ideal-fp32", Outputs::Id, true, 1.0),
            ("nv35", Outputs::Id, true, 2.0),
            ("r200", Outputs::Id, true, 1.0),
            ("r200", Outputs::IdAndBarycentrics, false, 4.0),
            ("ideal-fp32", Outputs::IdAndBarycentrics, false, 16.0),
            ("nv35", Outputs::IdAndBarycentrics, true, 16.0),
        ] {
            for cull in [false, true] {
                let parameters = EngineParameters { outputs, small_ids, sides, cull, ..EngineParameters::default() };
                let mut engine = engine(&mesh, device, parameters);
                let hits = engine.trace(&rays).expect("the card works");
                assert_eq!(gamma(&mut engine), bytes, "{device} {outputs:?} {small_ids}");
                assert!(engine.counts().passes > 10);
                // r200's hits and nv35's own t need not be equal; where the host computes t for the card's triangle,
                // hits are equal.
                if device != "r200" && (device != "nv35" || outputs != Outputs::IdAndT) {
                    assert_eq!(hits, truth, "{device} {outputs:?} {small_ids} {sides:?}");
                }
            }
        }
    }
}

#[test]
fn small_ids_are_the_same_ids() {
    let (mesh, rays) = (scene().0, Camera::teapot(20, 20).expect("a camera").rays());
    for device in ["r200", "r300", "nv35", "ideal-s3.12"] {
        for (outputs, triangles) in [(Outputs::Id, 5..=15), (Outputs::IdAndT, 5..=15), (Outputs::IdAndT, 256..=2000)] {
            let run = |small_ids| {
                let parameters = EngineParameters {
                    outputs,
                    small_ids,
                    triangles: triangles.clone(),
                    ..EngineParameters::default()
                };
                let mut engine = engine(&mesh, device, parameters);
                let hits = engine.trace(&rays).expect("the card works");
                assert!(engine.counts().passes > 0, "{device} {triangles:?}");
                hits
            };
            assert_eq!(run(true), run(false), "{device} {outputs:?} {triangles:?}");
        }
    }
}

fn located(outputs: Outputs, sides: Sides, card: bool) -> (Mesh, Vec<Ray>, Vec<Option<LocatedHit>>, u64) {
    let (mesh, rays) = scene();
    let parameters = EngineParameters { outputs, sides, card, ..EngineParameters::default() };
    let mut engine = engine(&mesh, "ideal-fp32", parameters);
    let hits = engine.trace_located(&rays).expect("the card works");
    let tests = engine.counts().host_tests;
    (mesh, rays, hits, tests)
}

#[test]
fn barycentric_coordinates_of_card_and_host_have_the_same_bits() {
    for sides in [Sides::Front, Sides::Both] {
        let (.., card, fewer) = located(Outputs::IdAndBarycentrics, sides, true);
        let (.., ids, more) = located(Outputs::Id, sides, true);
        let (.., host, _) = located(Outputs::Id, sides, false);
        let bits = |hits: &[Option<LocatedHit>]| -> Vec<_> {
            hits.iter()
                .map(|hit| hit.map(|h| (h.hit.triangle, h.hit.t.to_bits(), h.weights.map(f32::to_bits))))
                .collect()
        };
        assert_eq!(bits(&card), bits(&host), "{sides:?}");
        assert_eq!(bits(&ids), bits(&host), "{sides:?}");
        assert!(fewer < more, "what the card computed the host does not: {fewer} and {more} tests");
    }
}

#[test]
fn the_weights_of_the_corners_give_the_point_that_was_hit() {
    for sides in [Sides::Front, Sides::Both] {
        let (mesh, rays, hits, _) = located(Outputs::IdAndBarycentrics, sides, true);
        let mut seen = 0;
        for (ray, found) in rays.iter().zip(hits) {
            let Some(LocatedHit { hit, weights }) = found else { continue };
            seen += 1;
            assert!(weights.iter().all(|w| *w >= 0.0), "{weights:?}");
            let sum: f32 = weights.iter().sum();
            assert!(abs_diff_eq!(sum, 1.0, epsilon = 1e-3), "u + v + w is -n.d: {sum}");
            let [a, b, c] = mesh.corners(hit.triangle).expect("a triangle");
            for axis in 0..3 {
                let place = weights[0] * a[axis] + weights[1] * b[axis] + weights[2] * c[axis];
                let along = ray.origin()[axis] + hit.t * ray.direction()[axis];
                assert!(abs_diff_eq!(place, along, epsilon = 3e-3), "axis {axis}: {place} and {along}");
            }
        }
        assert!(seen > 500, "{seen} hits");
    }
}
