//! Compares squares of texels that gather together with texels that gather alone, in small atlases.

use crossbar::geom::Mesh;
use crossbar::subsurface::links::{LinkChoice, Links};
use crossbar::subsurface::multipole::Factors;

use super::links_models::{atlas, figure_7, surface, texels};

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
