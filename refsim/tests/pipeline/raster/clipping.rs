//! The clipper.

use super::support::{CONVENTIONS, RULES, counts, grids, set_up, state, vertex};
use proptest::prelude::*;
use refsim::device::SubpixelGrid;
use refsim::raster::{ComponentMask, RasterRules, Vertex, Viewport};

fn any_vertex() -> impl Strategy<Value = Vertex> {
    (any::<[u32; 4]>(), any::<u32>(), any::<u32>()).prop_map(|(position, a, b)| {
        let mut v = Vertex { position, ..Vertex::default() };
        v.texcoords[0][0] = a;
        v.colors[0][2] = b;
        v
    })
}

fn near_vertex() -> impl Strategy<Value = Vertex> {
    let axis = || prop_oneof![-3.0f32..3.0, -200.0f32..200.0, prop::num::f32::ANY, Just(0.0f32), Just(1.0f32)];
    [axis(), axis(), axis(), axis()].prop_map(vertex)
}

fn check(v: &[Vertex; 3], convention: usize, grid: SubpixelGrid, viewport: Viewport) {
    let mut s = state(64, 48, CONVENTIONS[convention]);
    s.viewport = viewport;
    let rules = RasterRules { subpixel_grid: grid, ..RULES };
    for done in set_up([&v[0], &v[1], &v[2]], &s, &rules).0 {
        let b = done.bounds;
        assert!(b.width > 0 && b.height > 0 && b.x + b.width <= 64 && b.y + b.height <= 48);
        assert!(done.area > 0);
        for (x, y) in [(b.x, b.y), (b.x + b.width - 1, b.y + b.height), (0, 0), (64, 48)] {
            let _ = done.interpolate(x, y, ComponentMask::ALL);
        }
        let fragments: u32 = done.quads(s.scissor).map(|q| q.mask.count_ones()).sum();
        assert!(fragments <= b.width * b.height);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, ..ProptestConfig::default() })]

    #[test]
    fn any_bits_are_drawn_or_dropped(v in [any_vertex(), any_vertex(), any_vertex()], convention in 0usize..4, grid in grids(any::<u8>())) {
        check(&v, convention, grid, Viewport::new(64, 48));
    }

    #[test]
    fn nearly_sensible_vertices_too(
        v in [near_vertex(), near_vertex(), near_vertex()], convention in 0usize..4, grid in grids(0u8..=8),
        x in any::<i32>(), y in -100i32..100, width in any::<u32>(), height in 0u32..100, depths in any::<[u32; 2]>(),
    ) {
        check(&v, convention, grid, Viewport::new(64, 48));
        check(&v, convention, grid, Viewport { x, y, width, height, min_depth: depths[0], max_depth: depths[1] });
    }

    #[test]
    fn clipped_neighbours_share_no_pixel(
        a in [-2.0f32..2.0, -2.0f32..2.0, -1.0f32..2.0, 0.2f32..3.0], b in [-2.0f32..2.0, -2.0f32..2.0, -1.0f32..2.0, 0.2f32..3.0],
        up in 0.5f32..30.0, down in 0.5f32..30.0,
    ) {
        prop_assume!((a[0] / a[3] - b[0] / b[3]).abs() + (a[1] / a[3] - b[1] / b[3]).abs() > 0.1);
        prop_assert!(neighbours(a, b, up, down).iter().all(|&n| n <= 1));
    }
}

/// Number of covering triangles per pixel, for two triangles on either side of the edge from a to b; their third
/// vertices are `up` and `down` edge lengths away from its midpoint in screen space.
fn neighbours(a: [f32; 4], b: [f32; 4], up: f32, down: f32) -> Vec<u32> {
    let on_screen = |v: [f32; 4]| [v[0] / v[3], v[1] / v[3]];
    let (p, q) = (on_screen(a), on_screen(b));
    let across = [-(q[1] - p[1]), q[0] - p[0]];
    let beside = |k: f32| vertex([(p[0] + q[0]) / 2.0 + across[0] * k, (p[1] + q[1]) / 2.0 + across[1] * k, 0.5, 1.0]);
    let (va, vb, vc, vd) = (vertex(a), vertex(b), beside(up), beside(-down));
    counts(&[[&va, &vb, &vc], [&va, &vb, &vd]], &state(64, 48, CONVENTIONS[0]), &RULES)
}

/// The near plane cuts off or leaves a sliver so thin that snapping folds the rest over the common edge.
#[test]
fn a_folded_sliver_is_left_out() {
    let (a, b) =
        ([0.741_720_3, 1.214_467_8, 1.441_506_6, 2.824_437_4], [-1.980_204_1, 0.472_432_05, -0.562_358_7, 2.206_684_8]);
    assert!(neighbours(a, b, 0.5, 19.782_885).iter().all(|&n| n <= 1));
    let (a, b) =
        ([1.815_795_1, -0.124_025_3, -0.002_630_855_7, 2.265_137], [0.732_016_86, 0.0, 1.443_721_9, 0.785_518_9]);
    assert!(neighbours(a, b, 0.5, 25.613_966).iter().all(|&n| n <= 1));
}

/// One triangle far larger than the guard band covers everything once, with correct attributes.
#[test]
fn a_huge_triangle_fills_the_screen() {
    for convention in CONVENTIONS {
        let mut v = [[-100.0f32, -100.0], [300.0, -100.0], [-100.0, 300.0]].map(|[x, y]| vertex([x, y, 0.5, 1.0]));
        for corner in &mut v {
            corner.texcoords[0][0] = corner.position[0];
            corner.texcoords[1][0] = 0x4048_f5c3;
        }
        let s = state(64, 48, convention);
        assert!(counts(&[[&v[0], &v[1], &v[2]]], &s, &RULES).iter().all(|&n| n == 1));
        for done in set_up([&v[0], &v[1], &v[2]], &s, &RULES).0 {
            for (x, y) in (0..64).map(|i| (i, i / 2)).filter(|&(x, y)| done.coverage(x, y)) {
                let t = done.interpolate(x, y, ComponentMask::ALL).t;
                let half = if convention.0 == refsim::raster::PixelCenter::OpenGl { 0.5 } else { 0.0 };
                let want = (x as f32 + half) / 32.0 - 1.0;
                assert!((f32::from_bits(t[0][0]) - want).abs() < 1e-4, "{x}: {}", f32::from_bits(t[0][0]));
                assert_eq!(t[1][0], 0x4048_f5c3);
            }
        }
    }
}
