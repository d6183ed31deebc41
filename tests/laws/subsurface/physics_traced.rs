//! The walk through a mesh with the project's own tracer, in single precision.

use crossbar::geom::Sides;
use crossbar::subsurface::Coefficients;
use crossbar::subsurface::walk::{self, PhotonWalk};
use crossbar::tracer::HostTracer;

use super::physics_walk::cuboid;

/// Without absorption light from everywhere leaves everywhere alike; the tracer loses next to nothing at edges.
#[test]
fn light_from_everywhere_leaves_a_traced_box_from_everywhere() {
    let mesh = cuboid([3.0, 1.0, 2.0]);
    let areas: Vec<f64> = (0..12).map(|face| mesh.area(face)).collect();
    let surface: f64 = areas.iter().sum();
    let new = PhotonWalk::new(Coefficients { sigma_s_prime: 0.8, sigma_a: 0.0 }, 1.3).expect("a medium");
    let walk = PhotonWalk { photons: 10_000, max_steps: 10_000, ..new };
    let tally = walk::mesh(&walk, &mesh, 2.0, &areas, &mut HostTracer::new(&mesh, Sides::Both)).expect("traced");
    assert_eq!(tally.left() + tally.cut() + tally.lost(), 10_000);
    assert!(tally.cut() == 0 && tally.lost() <= 10, "{} given up, {} lost", tally.cut(), tally.lost());
    for (face, area) in areas.iter().enumerate() {
        let fraction = tally.fraction(face);
        assert!(fraction.distance(area / surface) < 2.3, "face {face}: {fraction:?}, exactly {}", area / surface);
    }
}
