//! What each pixel shows, by the raster of a device: for comparisons in which only arithmetic differs.

use refsim::device::Profile;
use refsim::machine::{DrawCall, Executor, ExecutorKind, VertexSource};
use refsim::raster::Primitive;
use refsim::texture::TexelFormat;

use super::error::FactoredCardError;
use crate::all_frequency::kernels::FLOAT_COLOR;
use crate::card::{Attribute, Texels, ViewTarget, attribute, constants, vertex_streams};
use crate::cpca::kernels::SHADE;
use crate::cpca::on_card::positions;
use crate::geom::UnitFrame;
use crate::geom::vector::wide;
use crate::scene::Camera;
use crate::transfer::Vertices;

/// A triangle's vertices with weights that sum to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenPixel {
    /// The triangle's number.
    pub triangle: u32,
    /// The corners.
    pub corners: [u32; 3],
    /// Their weights, correct in perspective.
    pub weights: [f64; 3],
}

/// What each pixel of a camera shows, row by row: a draw in single precision with the fractions of a pixel that a
/// device puts vertices at. `None`: nothing.
///
/// # Errors
/// [`FactoredCardError`] if the draw is refused.
pub fn seen_pixels(
    profile: &Profile,
    vertices: &Vertices,
    camera: &Camera,
) -> Result<Vec<Option<SeenPixel>>, FactoredCardError> {
    let mut ideal = Profile::named("ideal-fp32")?;
    ideal.rules.subpixel_bits = profile.rules.subpixel_bits;
    let (vertex, pixel) = (FLOAT_COLOR.checked(&ideal)?, SHADE.checked(&ideal)?);
    let mut machine = Executor::from(ExecutorKind::Batch).machine(ideal)?;
    let frame = UnitFrame::new(vertices.positions().iter().copied().map(wide));
    let of_vertex = positions(vertices, &frame);
    let triangles = vertices.triangles();
    let places: Attribute = triangles.as_flattened().iter().map(|&vertex| of_vertex[vertex as usize]).collect();
    let weights = |triangle: usize| {
        let mark = |first, second| attribute([first, second, triangle as f64], 1.0);
        [mark(1.0, 0.0), mark(0.0, 1.0), mark(0.0, 0.0)]
    };
    let marks: Attribute = (0..triangles.len()).flat_map(weights).collect();
    let size = [camera.width(), camera.height()];
    let target = ViewTarget::default().of(&mut machine, TexelFormat::Rgba32f, size)?;
    target.clear(&mut machine)?;
    let (rows, none) = (constants(camera.clip_rows(&frame)), constants([]));
    let streams = vertex_streams([&places, &marks]);
    let source = VertexSource::Program { program: &vertex, constants: &rows, streams };
    let mut call = DrawCall::new(source, Primitive::TriangleList, &pixel, &none, target.color);
    target.keep_nearest(&mut call);
    machine.draw(&call)?;
    let seen = |&[first, second, triangle, alpha]: &[f32; 4]| {
        let triangle = triangle.round() as u32;
        let corners = *triangles.get(triangle as usize).filter(|_| alpha != 0.0)?;
        let [first, second] = [first, second].map(f64::from);
        Some(SeenPixel { triangle, corners, weights: [first, second, 1.0 - first - second] })
    };
    Ok(Texels::read_back(&machine, target.color)?.texels.iter().map(seen).collect())
}
