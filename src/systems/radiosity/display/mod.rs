//! Display of a solution by the card (section 3.1, Figure 2).
//!
//! *Flat*: each pixel fetches its patch's texel of the radiosity texture. *Smooth*: the texture is first resampled into
//! a texture of corners, and each pixel interpolates between its patch's corners. [`at_corners`] computes the corners
//! on the host.

mod corners;
mod fans;
mod resample;

use glam::DVec3;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{DrawCall, Machine, TextureId, VertexSource};
use refsim::output::DepthFormat;
use refsim::raster::{Primitive, Vertex};
use refsim::texture::{SamplerState, TexelFormat};

use super::draw::{DrawError, Projection, bits, code, patch_of};
use super::{Patches, kernels};
use crate::card::{NearestTarget, Texels};
use crate::picture::Picture;
use crate::scene::Camera;
use corners::CornerSets;
pub use corners::{SmoothVertex, at_corners};
use fans::in_patch;
use resample::Resampler;

/// Patches of the same kind (quadrilaterals, triangles, fans of quadrilaterals), and the program that interpolates.
#[derive(Debug)]
struct PatchShape {
    primitive: Primitive,
    vertices: Vec<Vertex>,
    smooth: CheckedProgram,
}

/// The programs, vertices and targets for drawing the patches of a scene from one camera, on one machine.
#[derive(Debug)]
pub struct Display {
    patches: usize,
    shapes: [PatchShape; 3],
    flat: CheckedProgram,
    id: CheckedProgram,
    resampler: Resampler,
    target: NearestTarget,
    /// Target of the patch numbers, which shares the depth buffer.
    ids: NearestTarget,
}

impl Display {
    /// Projects the patches, uploads the sets of patches that meet at corners, and creates targets of the camera's
    /// size. A `target` of [`TexelFormat::Bgra8`] clamps to [0, 1] in 8 bits, like a screen of the time;
    /// [`TexelFormat::Rgba32f`] stores all values.
    pub fn new(
        machine: &mut Machine,
        patches: &Patches,
        camera: &Camera,
        target: TexelFormat,
    ) -> Result<Self, DrawError> {
        let profile = machine.profile();
        let (flat, id) = (kernels::FLAT.checked(profile)?, kernels::ID.checked(profile)?);
        let (quad, triangle) = (kernels::SMOOTH_QUAD.checked(profile)?, kernels::SMOOTH_TRIANGLE.checked(profile)?);
        let corner_sets = CornerSets::new(patches);
        let resampler = Resampler::new(machine, &corner_sets)?;
        let [quads, quad_fans, triangles] = vertices(patches, camera, &corner_sets, &resampler);
        let shapes = [
            PatchShape { primitive: Primitive::QuadList, vertices: quads, smooth: quad.clone() },
            PatchShape { primitive: Primitive::TriangleList, vertices: quad_fans, smooth: quad },
            PatchShape { primitive: Primitive::TriangleList, vertices: triangles, smooth: triangle },
        ];
        let size = [camera.width(), camera.height()];
        let target = NearestTarget::new(machine, target, DepthFormat::Unorm24, size)?;
        let ids = NearestTarget { color: machine.create_target(TexelFormat::R32f, size[0], size[1])?, ..target };
        Ok(Self { patches: patches.list().len(), shapes, flat, id, resampler, target, ids })
    }

    /// Uploads the host's radiosities, one per patch, as a texture of one row, to draw from.
    pub fn upload(&self, machine: &mut Machine, radiosity: &[[f64; 3]]) -> Result<TextureId, DrawError> {
        if radiosity.len() != self.patches {
            return Err(DrawError::Count { patches: self.patches, found: radiosity.len() });
        }
        let texel = |b: &[f64; 3]| [b[0] as f32, b[1] as f32, b[2] as f32, 0.0];
        Ok(Texels::vector(radiosity.iter().map(texel).collect()).upload(machine, TexelFormat::Rgba32f)?)
    }

    /// Draws each patch with constant radiosity. A pixel is `exposure` times the radiance, which is the radiosity
    /// divided by pi. Fails with [`DrawError`] if the card rejects a draw.
    pub fn flat(&self, machine: &mut Machine, radiosity: TextureId, exposure: f64) -> Result<Picture, DrawError> {
        self.draw(machine, self.target, Some(radiosity), exposure, |_| &self.flat)?;
        self.picture(machine)
    }

    /// Draws each patch with radiosity interpolated between its corners, which the card resamples; exposure as in
    /// [`Display::flat`]. Fails with [`DrawError`] if the card rejects a draw.
    pub fn smooth(&self, machine: &mut Machine, radiosity: TextureId, exposure: f64) -> Result<Picture, DrawError> {
        let corners = self.resampler.run(machine, radiosity)?;
        self.draw(machine, self.target, Some(corners), exposure, |shape| &shape.smooth)?;
        self.picture(machine)
    }

    /// Draws the patch whose front each pixel shows, if any; rows from the top.
    pub fn ids(&self, machine: &mut Machine) -> Result<Vec<Option<u32>>, DrawError> {
        self.draw(machine, self.ids, None, 1.0, |_| &self.id)?;
        let codes = Texels::read_back(machine, self.ids.color)?;
        Ok(codes.texels.into_iter().map(|[code, ..]| patch_of(code)).collect())
    }

    fn draw<'a>(
        &'a self,
        machine: &mut Machine,
        target: NearestTarget,
        texture: Option<TextureId>,
        exposure: f64,
        program: impl Fn(&'a PatchShape) -> &'a CheckedProgram,
    ) -> Result<(), DrawError> {
        target.clear(machine)?;
        let factor = bits([exposure / std::f64::consts::PI; 4]);
        let constants = Constants { float: vec![factor], ..Constants::default() };
        for shape in self.shapes.iter().filter(|shape| !shape.vertices.is_empty()) {
            let source = VertexSource::Transformed(&shape.vertices);
            let mut call = DrawCall::new(source, shape.primitive, program(shape), &constants, target.color);
            if let Some(texture) = texture {
                call = call.with_texture(0, texture, SamplerState::NEAREST_CLAMP);
            }
            target.keep_nearest(&mut call);
            machine.draw(&call)?;
        }
        Ok(())
    }

    fn picture(&self, machine: &Machine) -> Result<Picture, DrawError> {
        Ok(Texels::read_back(machine, self.target.color)?.picture())
    }
}

/// Returns the vertices of all visible patches: quadrilaterals, their fans, triangles and their fans. Each vertex has
/// the texels of its patch and of the patch's corners.
fn vertices(patches: &Patches, camera: &Camera, corner_sets: &CornerSets, resampler: &Resampler) -> [Vec<Vertex>; 3] {
    let list = patches.list();
    let within = list.first().map_or(DVec3::ZERO, |patch| patch.corners()[0]);
    let projection = Projection::of(camera, within, patches.extent());
    let mut vertices = [const { Vec::new() }; 3];
    for (i, (patch, fan)) in list.iter().zip(fans::fans(patches)).enumerate() {
        let Some(is_front) = projection.sees_front(patch).filter(|_| !projection.misses(patch)) else { continue };
        let [[ax, ay], [bx, by], [cx, cy], [dx, dy]] = corner_sets.of[i].map(|set| resampler.texel(set));
        let texels = [[ax, ay, bx, by], [cx, cy, dx, dy], [i as f64 + 0.5, 0.5, code(i, is_front), 0.0]].map(bits);
        let dressed = |(point, at)| {
            let mut vertex = projection.vertex(point, at, is_front);
            vertex.texcoords[1..4].copy_from_slice(&texels);
            vertex
        };
        let into = &mut vertices[if patch.corners().len() == 3 { 2 } else { usize::from(fan.is_some()) }];
        match fan {
            Some(triangles) => into.extend(triangles.into_iter().flatten().map(dressed)),
            None => into.extend(patch.corners().iter().copied().zip(in_patch(patch)).map(dressed)),
        }
    }
    vertices
}
