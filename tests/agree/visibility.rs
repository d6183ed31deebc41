//! Visibility maps of all-frequency transfer: cubes drawn from vertices, the same bits on every executor.

use crossbar::transfer::synthetic::hills;
use crossbar::transfer::visibility::drawn::CubeCard;
use crossbar::transfer::visibility::{Horizon, VisibilitySampling};
use crossbar::transfer::{Tangents, Vertices};
use refsim::device::Profile;

use crate::system::executors;

/// Hills that hide each other, with triangles around the eye that cross every face of its cube.
#[test]
fn cubes_are_drawn_the_same_everywhere() {
    let vertices = Vertices::new(&hills(5), Tangents::Any).expect("vertices");
    let of: Vec<u32> = (0..vertices.len() as u32).step_by(7).collect();
    for (device, log2_samples, horizon) in
        [("r350", 2, Horizon::Normal), ("nv25", 1, Horizon::Geometry), ("gt200", 0, Horizon::Normal)]
    {
        let sampling = VisibilitySampling { log2_samples, horizon };
        let mut reference = None;
        for (executor, how) in executors() {
            let profile = Profile::named(device).expect("a device");
            let maps = CubeCard::new(profile, how, sampling).and_then(|mut card| card.draw(&vertices, &of));
            let maps = maps.unwrap_or_else(|e| panic!("{device}, {executor}: {e}"));
            assert!(maps.counts.visible > 0 && maps.counts.visible < maps.counts.above, "{device}, {executor}");
            assert!(reference.get_or_insert_with(|| maps.clone()) == &maps, "{device}, {executor}: other than scalar");
        }
    }
}
