//! The fill rule.

use super::support::{CONVENTIONS, RULES, at, counts, grids, set_up, state, vertex};
use proptest::prelude::*;
use refsim::raster::{Cull, Dropped, PixelCenter, Primitive, RasterRules, RasterState, Vertex, Viewport, assemble};
use refsim::texture::Region;

const W: u32 = 37;
const H: u32 = 29;

fn position() -> impl Strategy<Value = (f32, f32)> {
    // Many positions on pixel centers and edges, where the fill rule matters.
    let axis = |n: u32| {
        prop_oneof![
            -4.0..n as f32 + 4.0,
            (-2i32..n.cast_signed() + 2).prop_map(|i| i as f32),
            (-2i32..2 * n.cast_signed()).prop_map(|i| i as f32 / 2.0)
        ]
    };
    (axis(W), axis(H))
}

/// A jittered grid of vertices whose border is outside the target.
fn mesh(jitter: &[(f32, f32)], columns: usize, rows: usize) -> (Vec<Vertex>, Vec<[usize; 3]>) {
    let mut vertices = Vec::new();
    for (i, &(jx, jy)) in jitter.iter().enumerate().take((columns + 1) * (rows + 1)) {
        let (c, r) = (i % (columns + 1), i / (columns + 1));
        let x = -8.0 + (W as f32 + 16.0) * c as f32 / columns as f32 + jx;
        let y = -8.0 + (H as f32 + 16.0) * r as f32 / rows as f32 + jy;
        vertices.push(at(x, y, W, H));
    }
    let mut triangles = Vec::new();
    for r in 0..rows {
        for c in 0..columns {
            let i = r * (columns + 1) + c;
            let (a, b, d, e) = (i, i + 1, i + columns + 1, i + columns + 2);
            // Both diagonals and both windings occur.
            if (r + c) % 2 == 0 {
                triangles.extend([[a, b, d], [b, d, e]]);
            } else {
                triangles.extend([[a, b, e], [d, a, e]]);
            }
        }
    }
    (vertices, triangles)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

    /// Two triangles with a common edge: no pixel twice, and together the same pixels as the convex quad's other split.
    #[test]
    fn a_common_edge_belongs_to_one_side(corners in prop::collection::vec(position(), 4), grid in grids(2u8..=8), convention in 0usize..4) {
        let rules = RasterRules { subpixel_grid: grid, ..RULES };
        let v: Vec<_> = corners.iter().map(|&(x, y)| at(x, y, W, H)).collect();
        let s = state(W, H, CONVENTIONS[convention]);
        let side = |p: usize, q: usize, r: usize| {
            let c = |i: usize| (f64::from(corners[i].0), f64::from(corners[i].1));
            let ((px, py), (qx, qy), (rx, ry)) = (c(p), c(q), c(r));
            (qx - px) * (ry - py) - (rx - px) * (qy - py)
        };
        // Requires the other two vertices to be on different sides of the edge 0-2, farther away than the snapping
        // error.
        let (one, other) = (side(0, 2, 1), side(0, 2, 3));
        if one.abs() < 40.0 || other.abs() < 40.0 || (one > 0.0) == (other > 0.0) {
            return Ok(());
        }
        let both = counts(&[[&v[0], &v[1], &v[2]], [&v[0], &v[2], &v[3]]], &s, &rules);
        prop_assert!(both.iter().all(|&n| n <= 1));
        // In a convex quad the other diagonal covers the same pixels.
        if side(1, 3, 0).min(side(1, 3, 2)) < -40.0 && side(1, 3, 0).max(side(1, 3, 2)) > 40.0 {
            let other = counts(&[[&v[0], &v[1], &v[3]], [&v[1], &v[2], &v[3]]], &s, &rules);
            prop_assert_eq!(both, other);
        }
    }

    #[test]
    fn a_mesh_covers_each_pixel_once(
        jitter in prop::collection::vec(prop_oneof![(-1.2f32..1.2, -1.2f32..1.2), Just((0.0, 0.0)), Just((0.5, -0.5))], 80),
        grid in grids(1u8..=8), convention in 0usize..4,
    ) {
        let rules = RasterRules { subpixel_grid: grid, ..RULES };
        let (vertices, triangles) = mesh(&jitter, 9, 7);
        let list: Vec<_> = triangles.iter().map(|t| t.map(|i| &vertices[i])).collect();
        let found = counts(&list, &state(W, H, CONVENTIONS[convention]), &rules);
        prop_assert!(found.iter().all(|&n| n == 1), "{:?}", found.iter().enumerate().find(|(_, n)| **n != 1));
    }

    /// A fan around any point, with its rim outside the target.
    #[test]
    fn a_fan_covers_each_pixel_once(centre in (0.0f32..W as f32, 0.0f32..H as f32), on_grid in any::<bool>(), count in 3usize..24) {
        let (cx, cy) = if on_grid { (centre.0.floor(), centre.1.floor()) } else { centre };
        let mut vertices = vec![at(cx, cy, W, H)];
        // Points of the rim on a large square, in order.
        for i in 0..=count {
            let t = 4.0 * (i % count) as f32 / count as f32;
            let (side, along) = (t.floor() as u32, 240.0 * t.fract() - 120.0);
            let (x, y) = match side { 0 => (along, -120.0), 1 => (120.0, along), 2 => (-along, 120.0), _ => (-120.0, -along) };
            vertices.push(at(x + 18.0, y + 14.0, W, H));
        }
        let list: Vec<_> = assemble(Primitive::TriangleFan, vertices.len()).unwrap().map(|t| t.map(|i| &vertices[i])).collect();
        // With three or four points the rim may cross the target's corners; then only double coverage is ruled out.
        let found = counts(&list, &state(W, H, CONVENTIONS[0]), &RULES);
        prop_assert!(found.iter().all(|&n| n <= 1));
        if count >= 8 {
            prop_assert!(found.iter().all(|&n| n == 1));
        }
    }

    /// Quads, `misses` and `covers` agree with `coverage` of each pixel.
    #[test]
    fn walks_agree_with_single_pixels(corners in prop::collection::vec(position(), 3), tile in (0u32..W, 0u32..H, 1u32..20, 1u32..20)) {
        let v: Vec<_> = corners.iter().map(|&(x, y)| at(x, y, W, H)).collect();
        let s = state(W, H, CONVENTIONS[0]);
        let region = Region { x: tile.0, y: tile.1, width: tile.2, height: tile.3 };
        for done in set_up([&v[0], &v[1], &v[2]], &s, &RULES).0 {
            let mut pixels = Vec::new();
            for quad in done.quads(region) {
                prop_assert!(quad.mask != 0 && quad.x % 2 == 0 && quad.y % 2 == 0);
                pixels.extend((0..4).filter(|l| quad.mask >> l & 1 == 1).map(|l| quad.lane(l)));
            }
            pixels.sort_by_key(|&(x, y)| (y, x));
            let inside = region.intersect(s.scissor);
            let mut want = Vec::new();
            for y in inside.y..inside.y + inside.height {
                want.extend((inside.x..inside.x + inside.width).filter(|&x| done.coverage(x, y)).map(|x| (x, y)));
            }
            prop_assert_eq!(&pixels, &want);
            prop_assert!(!done.misses(region) || want.is_empty());
            prop_assert_eq!(done.covers(region), want.len() as u32 == region.width * region.height);
            prop_assert!(want.iter().all(|&(x, y)| done.edges.iter().map(|e| e.at(x, y)).sum::<i64>() == done.area));
        }
    }
}

/// A screen-filling quad has exactly W x H fragments under every convention and at odd sizes.
#[test]
fn a_full_screen_quad_is_exact() {
    let corners = [[-1., 1.], [1., 1.], [1., -1.], [-1., -1.]];
    for (width, height) in [(1, 1), (7, 3), (64, 64), (255, 257), (640, 480)] {
        for convention in CONVENTIONS {
            for w in [1.0f32, 0.3, 1000.0] {
                let v = corners.map(|[x, y]: [f32; 2]| vertex([x * w, y * w, 0.25 * w, w]));
                let list: Vec<_> = assemble(Primitive::QuadList, 4).unwrap().map(|t| t.map(|i| &v[i])).collect();
                let found = counts(&list, &state(width, height, convention), &RULES);
                assert!(found.iter().all(|&n| n == 1), "{width}x{height} {convention:?} w {w}");
            }
        }
    }
}

/// The texture coordinate (i + 1/2) / n, interpolated over a full-screen quad, addresses texel i.
#[test]
fn coordinates_over_a_quad_hit_their_texels() {
    use refsim::texture::{AddressMode, nearest_index};
    for n in [1u32, 2, 3, 5, 64, 100, 127, 257, 511, 640, 1000, 1023, 1024, 2047, 2048] {
        for center in [PixelCenter::Direct3d, PixelCenter::OpenGl] {
            // Direct3D's pixel centers are at integers, so the quad's coordinates include the half texel.
            let shift = if center == PixelCenter::Direct3d { 0.5 / n as f32 } else { 0.0 };
            let mut v = [[-1.0f32, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]].map(|[x, y]| vertex([x, y, 0.0, 1.0]));
            for (corner, [s, t]) in v.iter_mut().zip([[0.0f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]) {
                corner.texcoords[3] = [(s + shift).to_bits(), (t + shift).to_bits(), 0, 0];
            }
            let s = state(n, n, (center, refsim::raster::ClipSpace::Direct3d));
            for triangle in [[0, 1, 2], [0, 2, 3]] {
                let done = set_up(triangle.map(|i| &v[i]), &s, &RULES).0.remove(0);
                // Sample the square by a column, a row and a diagonal.
                for i in 0..n {
                    for (x, y) in [(i, 0), (n - 1, i), (i, i), (i, n - 1), (0, i)] {
                        if !done.coverage(x, y) {
                            continue;
                        }
                        let t = done.interpolate(x, y, refsim::raster::ComponentMask::ALL).t[3];
                        assert_eq!(nearest_index(AddressMode::Clamp, t[0], n, n), Some(x), "{n} {center:?} {x} {y}");
                        assert_eq!(nearest_index(AddressMode::Clamp, t[1], n, n), Some(y), "{n} {center:?} {x} {y}");
                    }
                }
            }
        }
    }
}

#[test]
fn culling_knows_both_windings() {
    let v = [(1., 1.), (6., 1.), (1., 6.)].map(|(x, y)| at(x, y, 8, 8)); // clockwise on screen
    for (_, space) in CONVENTIONS {
        for (cull, order, kept) in [
            (Cull::None, [0, 1, 2], true),
            (Cull::None, [0, 2, 1], true),
            (Cull::CounterClockwise, [0, 1, 2], true),
            (Cull::CounterClockwise, [0, 2, 1], false),
            (Cull::Clockwise, [0, 1, 2], false),
            (Cull::Clockwise, [0, 2, 1], true),
        ] {
            let s = RasterState { cull, ..state(8, 8, (PixelCenter::Direct3d, space)) };
            let (out, report) = set_up(order.map(|i: usize| &v[i]), &s, &RULES);
            assert_eq!(out.len() == 1, kept, "{space:?} {cull:?} {order:?}");
            assert_eq!(report.dropped, (!kept).then_some(Dropped::Culled));
        }
    }
}

#[test]
fn drops_have_reasons() {
    let s = state(8, 8, CONVENTIONS[0]);
    let reason = |v: [[f32; 4]; 3]| {
        let v = v.map(vertex);
        set_up([&v[0], &v[1], &v[2]], &s, &RULES).1.dropped
    };
    assert_eq!(reason([[f32::NAN, 0., 0., 1.], [1., 0., 0., 1.], [0., 1., 0., 1.]]), Some(Dropped::NotFinite));
    assert_eq!(reason([[f32::INFINITY, 0., 0., 1.], [1., 0., 0., 1.], [0., 1., 0., 1.]]), Some(Dropped::NotFinite));
    assert_eq!(reason([[0., 0., 0.5, 1.], [1., 1., 0.5, 1.], [-1., -1., 0.5, 1.]]), Some(Dropped::Degenerate));
    assert_eq!(reason([[0., 0., 2., 1.], [1., 0., 2., 1.], [0., 1., 2., 1.]]), Some(Dropped::Clipped));
    assert_eq!(reason([[0., 0., 0.5, -1.], [1., 0., 0.5, -1.], [0., 1., 0.5, -1.]]), Some(Dropped::Clipped));
    assert_eq!(reason([[2., 2., 0.5, 1.], [3., 2., 0.5, 1.], [2., 3., 0.5, 1.]]), Some(Dropped::NoPixels));
    assert!(Viewport::new(0, 4).check().is_err());
    assert!(Viewport { x: -20_000, ..Viewport::new(4, 4) }.check().is_err());
    assert!(Viewport::new(16_384, 1).check().is_ok());
}
