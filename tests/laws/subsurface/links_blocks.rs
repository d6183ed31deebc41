//! Compares squares of texels that gather together with texels that gather alone.

use crate::environment::by_form;
use crossbar::geom::Mesh;
use crossbar::subsurface::Dipole;
use crossbar::subsurface::links::{LinkChoice, Links};
use crossbar::subsurface::multipole::Factors;

use super::links_models::{atlas, figure_7, fine_tolerance, medium, sphere, surface, texels};

/// The largest difference between link factors and factors that a texel gathers individually with a finer tolerance,
/// each relative to the factor and 1e-5 of the light that the plane returns.
fn worst(mm_per_unit: f64, dipole: Dipole, side: u32, choice: LinkChoice) -> f64 {
    let surface = surface(&atlas(&sphere(6, 0.2), side), mm_per_unit);
    let links = Links::new(&surface, &[dipole], choice, 0.01).expect("links");
    let fine = Factors::new(&surface, [dipole], fine_tolerance()).expect("a tolerance");
    let mut receiver = fine.receiver();
    let mut worst: f64 = 0.0;
    for texel in texels(side).step_by(211) {
        // Links that are not used have the factor 0.
        for (cluster, factor) in links.of(texel).filter(|(_, factor)| factor[0] > 0.0) {
            let [exact] = receiver.factor(texel, cluster);
            worst = worst.max((f64::from(factor[0]) - exact).abs() / (exact + 1e-5 * dipole.total()));
        }
    }
    worst
}

/// Links keep the tolerance; by default tests only the smallest scale, and the last medium.
#[test]
fn links_keep_their_tolerance() {
    let [fixed, adaptive] = [LinkChoice::Fixed { level: 2 }, LinkChoice::Adaptive { count: 64 }];
    let step = by_form(3, 1);
    let all = [(1.5, figure_7()), (5.0, figure_7()), (15.0, figure_7()), (8.0, medium(0.74, 0.9))];
    for (mm_per_unit, dipole) in all.into_iter().step_by(step) {
        for choice in [fixed, adaptive] {
            let worst = worst(mm_per_unit, dipole, 32, choice);
            assert!(worst <= 0.01, "{mm_per_unit} mm, {choice:?}: {worst}");
            assert!(worst > 1e-4, "{mm_per_unit} mm, {choice:?}: {worst} leaves nothing to test");
        }
    }
}

/// Atlas sides down to one texel, which is smaller than the squares of texels that gather together.
#[test]
fn small_atlases_have_links() {
    let corners = vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.5]];
    let triangle = Mesh::new(corners, vec![[0, 1, 2]]).expect("a mesh");
    for side in [1, 2, 4, 8, 16] {
        let surface = surface(&atlas(&triangle, side), 3.0);
        let factors = Factors::new(&surface, [figure_7()], 0.01).expect("a tolerance");
        let mut receiver = factors.receiver();
        let fixed = (0..surface.level_count().min(4)).map(|level| LinkChoice::Fixed { level });
        for choice in fixed.chain([1, 4, 16].map(|count| LinkChoice::Adaptive { count })) {
            let links = Links::with(&factors, choice).expect("links");
            for texel in texels(side) {
                for (cluster, found) in links.of(texel).filter(|(_, found)| found[0] > 0.0) {
                    let [exact] = receiver.factor(texel, cluster);
                    let difference = (f64::from(found[0]) - exact).abs();
                    assert!(difference <= 0.02 * exact, "{side}, {choice:?}, {texel:?}: {found:?} and {exact}");
                }
            }
        }
    }
}
