//! Helpers of the raster tests.

use proptest::prelude::*;
use refsim::device::{SubpixelGrid, SubpixelRounding};
use refsim::num::Format;
use refsim::raster::{
    ClipSpace, Cull, PixelCenter, RasterRules, RasterState, SetupReport, TriangleSetup, Vertex, Viewport, setup,
};
use refsim::texture::Region;

pub(crate) const RULES: RasterRules = RasterRules {
    subpixel_grid: SubpixelGrid::Bits(4),
    subpixel_rounding: SubpixelRounding::Nearest,
    iterator_format: Format::FP32,
};

/// Subpixel grids with these numbers of bits, and the grid of twelfths.
pub(crate) fn grids(bits: impl Strategy<Value = u8>) -> impl Strategy<Value = SubpixelGrid> {
    prop_oneof![3 => bits.prop_map(SubpixelGrid::Bits), 1 => Just(SubpixelGrid::Twelfths)]
}

pub(crate) const CONVENTIONS: [(PixelCenter, ClipSpace); 4] = [
    (PixelCenter::Direct3d, ClipSpace::Direct3d),
    (PixelCenter::Direct3d, ClipSpace::OpenGl),
    (PixelCenter::OpenGl, ClipSpace::Direct3d),
    (PixelCenter::OpenGl, ClipSpace::OpenGl),
];

pub(crate) fn state(width: u32, height: u32, (center, clip_space): (PixelCenter, ClipSpace)) -> RasterState {
    RasterState {
        viewport: Viewport::new(width, height),
        center,
        clip_space,
        cull: Cull::None,
        scissor: Region { x: 0, y: 0, width, height },
    }
}

pub(crate) fn vertex(position: [f32; 4]) -> Vertex {
    Vertex { position: position.map(f32::to_bits), ..Vertex::default() }
}

/// A vertex at a window position of a Direct3D viewport (rows down).
pub(crate) fn at(x: f32, y: f32, width: u32, height: u32) -> Vertex {
    vertex([x / width as f32 * 2.0 - 1.0, 1.0 - y / height as f32 * 2.0, 0.5, 1.0])
}

pub(crate) fn set_up(
    triangle: [&Vertex; 3],
    state: &RasterState,
    rules: &RasterRules,
) -> (Vec<TriangleSetup>, SetupReport) {
    let mut out = Vec::new();
    let report = setup(triangle, state, rules, &mut out);
    assert_eq!(report.emitted as usize, out.len());
    assert_eq!(report.dropped.is_some(), out.is_empty());
    (out, report)
}

/// Number of triangles that cover each pixel, counted by the quads of 16x16 tiles.
pub(crate) fn counts(triangles: &[[&Vertex; 3]], state: &RasterState, rules: &RasterRules) -> Vec<u32> {
    let target = state.scissor;
    let mut counts = vec![0; (target.width * target.height) as usize];
    for &triangle in triangles {
        for done in set_up(triangle, state, rules).0 {
            for tile_y in (0..target.height).step_by(16) {
                for tile_x in (0..target.width).step_by(16) {
                    let tile = Region { x: tile_x, y: tile_y, width: 16, height: 16 };
                    for quad in done.quads(tile) {
                        for lane in (0..4).filter(|lane| quad.mask >> lane & 1 == 1) {
                            let (x, y) = quad.lane(lane);
                            counts[(y * target.width + x) as usize] += 1;
                        }
                    }
                }
            }
        }
    }
    counts
}
