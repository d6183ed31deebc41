//! The triangle at each pixel by a device's rasterization, for comparisons in which only arithmetic differs.

use refsim::device::Profile;
use refsim::machine::{Executor, ExecutorKind};
use refsim::output::WriteMask;

use super::kernels::{FLOAT_COLOR, SHADE};
use super::{Attribute, CardError, KeptFragments, MeshDisplay, MeshDraw, MeshView, attribute};
use crate::scene::Camera;

/// A triangle's vertices with barycentric weights that sum to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenPixel {
    /// The triangle's number.
    pub triangle: u32,
    /// The corners.
    pub corners: [u32; 3],
    /// Their perspective-correct weights.
    pub weights: [f64; 3],
}

/// The front face and barycentric weights at each pixel of a camera, row by row: from a draw in single precision with
/// the device's positions of vertices. `None` where the background shows. Fails with [`CardError::Draw`] for pictures
/// that are too large. Panics if a triangle names a vertex that does not exist.
pub fn seen_pixels(
    profile: &Profile,
    geometry: (&[[f32; 3]], &[[u32; 3]]),
    camera: &Camera,
) -> Result<Vec<Option<SeenPixel>>, CardError> {
    let (positions, triangles) = geometry;
    let mut ideal = Profile::named("ideal-fp32").expect("a device of the project");
    ideal.rules.subpixel_grid = profile.rules.subpixel_grid;
    ideal.rules.subpixel_rounding = profile.rules.subpixel_rounding;
    ideal.rules.vertex_format = profile.rules.vertex_format;
    let program =
        |kernel: super::KernelText| kernel.checked(&ideal).expect("the ideal device runs the project's programs");
    let (vertex, pixel) = (program(FLOAT_COLOR), program(SHADE));
    let machine = Executor::from(ExecutorKind::Batch).machine(ideal)?;
    let mut display =
        MeshDisplay::new(machine, triangles.as_flattened().iter().map(|&vertex| positions[vertex as usize]));
    let weights = |triangle: usize| {
        let mark = |first, second| attribute([first, second, triangle as f64], 1.0);
        [mark(1.0, 0.0), mark(0.0, 1.0), mark(0.0, 0.0)]
    };
    let marks: Attribute = (0..triangles.len()).flat_map(weights).collect();
    let (texels, _) = display.show(&MeshView::from(*camera), false, |pass| {
        pass.draw(MeshDraw {
            vertex: (&vertex, pass.rows().to_vec()),
            attributes: vec![pass.positions(), &marks],
            indices: None,
            pixel: (&pixel, Vec::new()),
            textures: Vec::new(),
            fragments: KeptFragments::Nearest,
            mask: WriteMask::ALL,
        })
    })?;
    let seen = |&[first, second, triangle, alpha]: &[f32; 4]| {
        let triangle = triangle.round() as u32;
        let corners = *triangles.get(triangle as usize).filter(|_| alpha != 0.0)?;
        let [first, second] = [first, second].map(f64::from);
        Some(SeenPixel { triangle, corners, weights: [first, second, 1.0 - first - second] })
    };
    Ok(texels.texels.iter().map(seen).collect())
}
