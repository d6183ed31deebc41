//! docs/examples/foreign_intersector.md states the errors of other intersectors: this test recomputes its numbers.

#[expect(dead_code, reason = "as an example it prints what the test compares")]
#[path = "../docs/examples/foreign_intersector.rs"]
mod foreign_intersector;

use crossbar::geom::{Mesh, Ray, Sides};
use crossbar::oracle::{Oracle, Tolerance};
use foreign_intersector::{intersector, teapot_table, wall_rays, walls, walls_table};

fn page() -> String {
    include_str!("../docs/examples/foreign_intersector.md").replace('\r', "")
}

// The intersectors' last bits come from SSE here, and may differ on other processors.
#[cfg(target_arch = "x86_64")]
#[test]
fn the_page_says_what_is_measured() {
    for table in [teapot_table(), walls_table()] {
        assert!(page().contains(&table), "docs/examples/foreign_intersector.md has another table than\n{table}");
    }
}

/// Rays in the planes of walls and cells: the signs of zeros change no hit, and no hit is lost.
#[test]
fn the_signs_of_zeros_do_not_show_in_ours() {
    let mesh: Mesh = walls();
    let oracle = Oracle::new(&mesh, Sides::Both, Tolerance::ulps(0));
    let mut ours = intersector("crossbar", &mesh);
    for free in [[true, true], [false, true], [true, false], [false, false]] {
        let mut hits = |minus| {
            let rays: Vec<Ray> = wall_rays(free, minus);
            let hits: Vec<_> = rays.iter().map(&mut ours).collect();
            let report = oracle.judge(&rays, &hits).expect("one answer a ray");
            assert!(report.agrees(), "{free:?} {minus:?}: {report}");
            hits
        };
        let plus = hits([false, false]);
        for minus in [[false, true], [true, false], [true, true]] {
            assert_eq!(plus, hits(minus), "both zeros are one direction");
        }
    }
}
