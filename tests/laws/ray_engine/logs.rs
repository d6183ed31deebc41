//! Requests to a card are the same for every executor, and recording them changes no hit and no count.

use crate::support::profile;
use crossbar::geom::exact::Sides;
use crossbar::geom::teapot::teapot;
use crossbar::ray_engine::{Crossbar, RayBatch};
use crossbar::scene::Camera;
use refsim::event::Event;
use refsim::machine::ExecutorKind;

#[test]
fn the_crossbar_asks_the_same_of_every_executor() {
    let mesh = teapot(2).expect("a teapot");
    let camera = Camera::teapot(40, 36).expect("a camera");
    let rays = RayBatch::new(40, 36, camera.rays()).expect("rays");
    for device in ["r200", "r300"] {
        let card = |executor| Crossbar::new(profile(device), executor);
        let plain = card(ExecutorKind::Batch).intersect(&mesh, &rays, Sides::Front).expect("hits");
        assert!(plain.log.is_empty(), "nothing is written down unasked");
        let recorded = |executor| card(executor).intersect_recorded(&mesh, &rays, Sides::Front).expect("hits");
        let (scalar, batch) = (recorded(ExecutorKind::Scalar), recorded(ExecutorKind::Batch));
        assert_eq!(batch.hits, plain.hits, "{device}: recording changes no hit");
        assert_eq!(batch.events, plain.events, "{device}: nor a count");
        assert!(scalar.log == batch.log, "{device}: one log");
        let draws = batch.log.iter().filter(|event| matches!(event, Event::Draw(_))).count();
        let back = batch.log.iter().filter(|event| matches!(event, Event::ReadBack { .. })).count();
        // Four buckets of at most 32 x 32, each with ids and t.
        assert_eq!((draws, back), (4, 8), "{device}");
    }
}
