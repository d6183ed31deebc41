//! A model on its ground: mutual shadows.

use crossbar::geom::teapot::teapot;
use crossbar::scene::built::ground::{GROUND_SIDE, on_ground};
use crossbar::transfer::linear_basis::{BasisWidth, LinearBasis};
use crossbar::transfer::visibility::SegmentCensus;
use crossbar::transfer::{Tangents, Vertices};
use glam::DVec3;

use super::trace;

/// The ground's vertices near the teapot are in shadow; far vertices see all of the sky except its rim; a vertex below
/// the teapot sees almost nothing.
#[test]
fn the_ground_receives_the_shadow_of_its_model() {
    let model = teapot(3).expect("a teapot");
    let (mesh, materials) = on_ground(&model, GROUND_SIDE).expect("a mesh");
    let vertices = Vertices::with_materials(&mesh, &materials, Tangents::Any).expect("vertices");
    let ground: Vec<u32> =
        (0..vertices.len() as u32).filter(|&vertex| vertices.materials()[vertex as usize] == 1).collect();
    assert_eq!(ground.len(), 36_864);
    assert!(ground.iter().all(|&vertex| vertices.frames()[vertex as usize].normal() == DVec3::Z));
    let [low, high] = mesh.bounds().expect("bounds").map(|corner| DVec3::from(corner.map(f64::from)));
    let nearest = |at: DVec3| {
        let distance = |vertex: &u32| DVec3::from(vertices.positions()[*vertex as usize].map(f64::from)).distance(at);
        ground.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("a vertex")
    };
    let middle = (low + high) / 2.0;
    let of = [nearest(low), nearest(DVec3::new(middle.x, middle.y - 2.3, low.z)), nearest(middle.with_z(low.z))];
    let maps = trace(&mesh, &vertices, &of);
    let open = |map: usize| maps.bits(map).iter().map(|word| word.count_ones()).sum::<u32>() as f64 / 49_152.0;
    assert!(open(0) > 0.95, "far off: {}", open(0));
    assert!((0.5..0.95).contains(&open(1)), "beside it: {}", open(1));
    assert!(open(2) < 0.05, "below it: {}", open(2));
    // All twelve segments below the ground are empty; with overlapping hats, only the four segments of the face below.
    let census = |width| SegmentCensus::new(&vertices, &maps, &LinearBasis::new(width));
    assert_eq!(census(BasisWidth::OneTexel).below_horizon, 3 * 12);
    assert_eq!(census(BasisWidth::TwoTexels).below_horizon, 3 * 4);
}
