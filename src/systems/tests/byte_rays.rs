//! Rays in two textures of bytes: for rays that bytes represent exactly, the card's hits equal the hits by exact
//! arithmetic.

use crossbar_base::geom::Ray;
use crossbar_base::geom::exact::{Sides, Tracer};
use crossbar_base::geom::teapot::teapot;
use crossbar_ground::scene::Camera;
use crossbar_systems::ray_engine::{Crossbar, EngineError, Kernel, RayBatch};
use refsim::device::Profile;
use refsim::machine::ExecutorKind;

#[test]
fn the_rays_that_bytes_hold_meet_the_triangles_that_they_meet_exactly() {
    let mesh = teapot(2).expect("a teapot");
    let eye = Camera::teapot(48, 48).expect("a camera").rays();
    // Every ray has a different origin.
    let moved = eye.iter().enumerate().map(|(i, ray)| {
        let [x, y, z] = ray.origin();
        Ray::new([x + 0.01 * (i % 64) as f32, y, z], ray.direction()).expect("a ray")
    });
    let rays = RayBatch::new(48, 48, moved.collect()).expect("a ray per pixel");
    let card = Crossbar::new(Profile::named("ideal-s3.26").expect("a format"), ExecutorKind::Batch).byte_rays();
    let held = card.rays_in_bytes(&mesh, &rays).expect("a card with bytes");
    assert_ne!(held, rays);
    assert_eq!(card.rays_in_bytes(&mesh, &held).expect("a card with bytes"), held, "bytes hold them as they are");
    let triangles = |rays| -> Vec<Option<u32>> {
        let answer = card.intersect(&mesh, rays, Sides::Front).expect("the card intersects");
        answer.hits.iter().map(|hit| hit.map(|hit| hit.triangle)).collect()
    };
    let found = triangles(&held);
    assert_eq!(found, triangles(&rays));
    let exact = Tracer::new(&mesh).nearest_all(held.rays(), Sides::Front);
    let wrong = found.iter().zip(&exact).filter(|(a, b)| **a != b.as_ref().map(|hit| hit.triangle));
    let hits = found.iter().flatten().count();
    assert!(hits > 300, "{hits}");
    assert_eq!(wrong.count(), 0);
}

#[test]
fn faces_and_cards_without_a_program_are_refused() {
    for (device, sides) in [("r200", Sides::Both), ("r300", Sides::Front)] {
        let refused = Kernel::with_byte_rays(&Profile::named(device).expect("a card"), sides);
        assert!(matches!(refused, Err(EngineError::NoByteRays { .. })), "{device}: {refused:?}");
    }
}
