//! Draws of measured rows: positions in the card's window, and cells of one pixel.

use super::running::bits;
use refsim::device::Profile;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{DrawCall, VertexSource};
use refsim::raster::{PixelCenter, Primitive, Vertex, Viewport};
use refsim::texture::{Image, TextureKind};

/// Width of targets in cells.
pub(crate) const COLUMNS: u32 = 64;

/// A viewport around the window's origin whose half extents are powers of two, so that positions arrive exactly: window
/// (x, y) is clip space (x / 1024, -y / 1024). Pixels up to column and row 1023 are drawn.
pub(crate) const WINDOW: Viewport =
    Viewport { x: -1024, y: -1024, width: 2048, height: 2048, min_depth: 0, max_depth: 0x3f80_0000 };

/// A vertex at a window position, y downward, with a depth from 0 to 1.
pub(crate) fn at([x, y]: [f32; 2], depth: f32) -> Vertex {
    Vertex { position: bits([x / 1024.0, -y / 1024.0, depth, 1.0]), ..Vertex::default() }
}

/// The corners of cell `index`, a pixel of a target that is [`COLUMNS`] wide, as a quad.
pub(crate) fn cell(index: usize) -> [Vertex; 4] {
    let [x, y] = [index % COLUMNS as usize, index / COLUMNS as usize].map(|at| at as f32);
    [[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]].map(|corner| at(corner, 0.5))
}

/// [`cell`] with both colors equal: codes of 255ths in the order red, green, blue, alpha.
pub(crate) fn colored(index: usize, codes: [u8; 4]) -> [Vertex; 4] {
    let color = bits(codes.map(|code| f32::from(code) / 255.0));
    cell(index).map(|corner| Vertex { colors: [color; 2], ..corner })
}

/// Rows of a target that holds `cells` cells.
pub(crate) fn rows(cells: usize) -> u32 {
    (cells as u32).div_ceil(COLUMNS).max(1)
}

/// A draw of quads in window positions, with pixel centers at one half as in the hardware.
pub(crate) fn quads<'a>(
    vertices: VertexSource<'a>,
    program: &'a CheckedProgram,
    constants: &'a Constants,
    target: refsim::machine::TextureId,
) -> DrawCall<'a> {
    let mut call = DrawCall::new(vertices, Primitive::QuadList, program, constants, target);
    call.viewport = Some(WINDOW);
    call.center = PixelCenter::OpenGl;
    call
}

pub(crate) fn color_program(profile: &Profile) -> CheckedProgram {
    super::running::checked("ps_1_1\nmov r0, v0", profile)
}

/// The codes of cell `index` in a target of 8-bit BGRA: red, green, blue, alpha.
pub(crate) fn codes(image: &Image, index: usize) -> [u8; 4] {
    assert_eq!(image.kind(), TextureKind::D2);
    let (x, y) = (index as u32 % COLUMNS, index as u32 / COLUMNS);
    let [b, g, r, a] = (image.raw(0, 0, y, x) as u32).to_le_bytes();
    [r, g, b, a]
}
