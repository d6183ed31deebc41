//! The triangle that a device rasterizes at each pixel, for comparisons in which only the arithmetic differs.

use glam::DVec3;
use refsim::device::Profile;
use refsim::machine::{Executor, ExecutorKind};
use refsim::output::WriteMask;

use super::kernels::{FLOAT_COLOR, SHADE};
use super::{Attribute, CardError, KeptFragments, MeshDisplay, MeshDraw, MeshView, attribute};
use crate::geom::vector::wide;
use crate::geom::{Hit, Mesh, Ray};
use crate::scene::Camera;
use crate::tracer::{CastError, Caster};

/// A triangle's vertices with barycentric weights that sum to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenPixel {
    /// The triangle's number.
    pub triangle: u32,
    /// The corners.
    pub corners: [u32; 3],
    /// Perspective-correct barycentric weights of the vertices.
    pub weights: [f64; 3],
}

/// The front face and barycentric weights at each pixel of a camera, row by row: from a draw in single precision with
/// vertex positions rounded as on the device. `None` where the background shows.
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

/// A caster that finds the hits of eye rays by rasterization, because the Ray Engine is meant to augment a rasterizing
/// renderer (section 1): a ray through the center of a camera's pixel hits the front face that a device's raster shows
/// there. Another caster traces all other rays.
pub struct RasterizedEyes<'a> {
    camera: Camera,
    seen: Vec<Option<Hit>>,
    behind: &'a mut dyn Caster,
    /// Number of rays whose hit was read from the raster.
    pub drawn: u64,
}

impl<'a> RasterizedEyes<'a> {
    /// Draws the mesh.
    pub fn new(profile: &Profile, mesh: &Mesh, camera: Camera, behind: &'a mut dyn Caster) -> Result<Self, CardError> {
        let hit = |seen: SeenPixel| {
            let corners = seen.corners.map(|corner| wide(mesh.positions()[corner as usize]));
            let point = corners.iter().zip(seen.weights).map(|(corner, weight)| weight * corner).sum::<DVec3>();
            // Camera rays have a component of 1 along the view direction, so t is the depth.
            Hit { triangle: seen.triangle, t: (point - wide(camera.eye())).dot(camera.forward()) as f32 }
        };
        let seen = seen_pixels(profile, (mesh.positions(), mesh.triangles()), &camera)?;
        Ok(Self { camera, seen: seen.into_iter().map(|seen| seen.map(hit)).collect(), behind, drawn: 0 })
    }

    fn pixel(&self, ray: &Ray) -> Option<usize> {
        let (camera, direction) = (&self.camera, wide(ray.direction()));
        let across = |axis: DVec3| direction.dot(axis) / axis.dot(axis);
        let x = 0.5 * (1.0 + across(camera.right())) * f64::from(camera.width());
        let y = 0.5 * (1.0 - across(camera.up())) * f64::from(camera.height());
        let is_inside = x >= 0.0 && y >= 0.0 && x < f64::from(camera.width()) && y < f64::from(camera.height());
        let (x, y) = (x as u32, y as u32);
        (is_inside && ray.origin() == camera.eye() && camera.ray(x, y) == *ray)
            .then_some(y as usize * camera.width() as usize + x as usize)
    }
}

impl Caster for RasterizedEyes<'_> {
    fn cast(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, CastError> {
        let pixels: Vec<Option<usize>> = rays.iter().map(|ray| self.pixel(ray)).collect();
        let others: Vec<Ray> = rays.iter().zip(&pixels).filter(|(_, at)| at.is_none()).map(|(ray, _)| *ray).collect();
        self.drawn += (rays.len() - others.len()) as u64;
        let mut traced = self.behind.cast(&others)?.into_iter();
        Ok(pixels.into_iter().map(|at| at.map_or_else(|| traced.next().flatten(), |at| self.seen[at])).collect())
    }
}
