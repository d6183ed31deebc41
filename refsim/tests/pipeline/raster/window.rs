//! Tests the batch executor's viewport transform and clip tests in rows against [`refsim::raster::setup`].

use super::support::{CONVENTIONS, RULES, grids, state};
use crate::random::Random;
use proptest::prelude::*;
use refsim::device::{SubpixelGrid, SubpixelRounding};
use refsim::exec::batch::{Instances, SimdLevel, Surfaces, VertexRows};
use refsim::raster::{ComponentMask, Cull, RasterRules, RasterState, TriangleSetup, Vertex, Viewport, setup};

/// Single-precision patterns near the boundaries of the definition: zeros, planes, the guard band, the least w,
/// denormals, the limits of the range, and non-finite values.
const EDGES: [u32; 28] = [
    0, 0x80000000, 1, 0x80000001, 0x007fffff, 0x00800000, 0x1f7fffff, 0x1f800000, 0x1f800001, 0x1fffffff, 0x20000000,
    0x3f000000, 0x3f7fffff, 0x3f800000, 0x3f800001, 0xbf800000, 0xbf800001, 0x40ffffff, 0x41000000, 0x41000001,
    0xc1000000, 0xc1000001, 0x7e800000, 0x7f7fffff, 0xff7fffff, 0x7f800000, 0xff800000, 0x7fc00001,
];

/// The fields of a triangle set-up that are compared.
type Shape = ([refsim::raster::Edge; 3], i64, refsim::texture::Region, refsim::raster::Plane, bool, bool, [u32; 3]);

fn shape(s: &TriangleSetup) -> Shape {
    (s.edges, s.area, s.bounds, s.depth, s.depth_constant, s.affine, s.reciprocal_w)
}

/// Sets up triangles both ways, on every SIMD level of the processor.
fn compare(vertices: &[Vertex], state: &RasterState, rules: &RasterRules) {
    let triangles: Vec<[usize; 3]> = (0..vertices.len() / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mut expected = Vec::new();
    let (mut culled, mut clipped) = (0, 0);
    for &[a, b, c] in &triangles {
        let emitted = setup([&vertices[a], &vertices[b], &vertices[c]], state, rules, &mut expected).emitted;
        culled += u64::from(emitted == 0);
        clipped += u64::from(emitted > 1);
    }
    let expected: Vec<Shape> = expected.iter().map(shape).collect();
    let needed = ComponentMask::NONE;
    let rows = VertexRows::from_vertices(vertices, needed);
    for simd in SimdLevel::available() {
        let instances = Instances { rows: &rows, count: 1, triangles: &triangles };
        let (surfaces, counts) = Surfaces::build(&instances, state, rules, needed, simd);
        let found: Vec<Shape> = (0..surfaces.len()).filter_map(|i| surfaces.geometry(i)).map(shape).collect();
        assert_eq!(found, expected, "{simd:?} {state:?} {rules:?}");
        assert_eq!((counts.culled, counts.clipped), (culled, clipped), "{simd:?} {state:?} {rules:?}");
    }
}

/// A number that is ordinary, near a boundary, or any pattern.
fn number() -> impl Strategy<Value = u32> {
    prop_oneof![
        6 => (-2.0f32..2.0).prop_map(f32::to_bits),
        2 => (-16.0f32..16.0).prop_map(f32::to_bits),
        3 => prop::sample::select(EDGES.to_vec()),
        1 => any::<u32>(),
    ]
}

/// w is mostly positive, so that triangles remain.
fn position() -> impl Strategy<Value = [u32; 4]> {
    let z = prop_oneof![4 => (0.0f32..1.0).prop_map(f32::to_bits), 1 => number()];
    let w = prop_oneof![4 => (0.25f32..4.0).prop_map(f32::to_bits), 3 => Just(1.0f32.to_bits()), 2 => number()];
    (number(), number(), z, w).prop_map(|(x, y, z, w)| [x, y, z, w])
}

fn vertices(triangles: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Vertex>> {
    let vertex = || position().prop_map(|position| Vertex { position, ..Vertex::default() });
    prop::collection::vec([vertex(), vertex(), vertex()], triangles).prop_map(|corners| corners.concat())
}

fn any_state() -> impl Strategy<Value = (RasterState, RasterRules)> {
    let depth = || prop_oneof![Just(0u32), Just(1.0f32.to_bits()), (0.0f32..1.0).prop_map(f32::to_bits)];
    let viewport = (-40i32..40, -40i32..40, 1u32..200, 1u32..200, depth(), depth());
    let culls = [Cull::None, Cull::Clockwise, Cull::CounterClockwise];
    let grid = (grids(0u8..=8), prop::sample::select(SubpixelRounding::ALL.to_vec()));
    (0..CONVENTIONS.len(), viewport, prop::sample::select(culls.to_vec()), grid).prop_map(
        |(convention, (x, y, width, height, min_depth, max_depth), cull, (subpixel_grid, subpixel_rounding))| {
            let mut state = state(64, 48, CONVENTIONS[convention]);
            state.viewport = Viewport { x, y, width, height, min_depth, max_depth };
            state.cull = cull;
            (state, RasterRules { subpixel_grid, subpixel_rounding, ..RULES })
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn rows_of_vertices_arrive_where_single_ones_do(v in vertices(1..24), (state, rules) in any_state()) {
        compare(&v, &state, &rules);
    }
}

/// Puts every boundary value in every component, with ordinary values in the others.
#[test]
fn edge_values_arrive_where_the_definition_has_them() {
    let plain = [[-0.5f32, 0.75, 0.25, 1.0], [0.5, 0.5, 0.5, 1.0], [0.0, -0.5, 0.75, 2.0]].map(|p| p.map(f32::to_bits));
    let mut vertices = Vec::new();
    for component in 0..4 {
        for (other, &first) in EDGES.iter().enumerate() {
            for second in [first, EDGES[(other * 7 + 3) % EDGES.len()]] {
                let mut corners = plain;
                corners[other % 3][component] = first;
                corners[other % 3][(component + 1) % 4] = second;
                vertices.extend(corners.map(|position| Vertex { position, ..Vertex::default() }));
            }
        }
    }
    for convention in CONVENTIONS {
        let grids = [0, 4, 8].map(SubpixelGrid::Bits).into_iter().chain([SubpixelGrid::Twelfths]);
        for (subpixel_grid, &subpixel_rounding) in
            grids.flat_map(|grid| SubpixelRounding::ALL.iter().map(move |r| (grid, r)))
        {
            let rules = RasterRules { subpixel_grid, subpixel_rounding, ..RULES };
            compare(&vertices, &state(64, 48, convention), &rules);
        }
    }
}

/// Tests more vertices and triangles than one task processes.
#[test]
fn many_vertices_arrive_like_few() {
    let mut random = Random::new(1);
    let mut next = |low, high| random.between(low, high).to_bits();
    let mut vertex = |_| {
        let position = [next(-9.0, 9.0), next(-9.0, 9.0), next(-0.1, 1.1), next(0.5, 1.5)];
        Vertex { position, ..Vertex::default() }
    };
    let vertices: Vec<Vertex> = (0..3 * 3000).map(&mut vertex).collect();
    compare(&vertices, &state(64, 48, CONVENTIONS[0]), &RULES);
}
