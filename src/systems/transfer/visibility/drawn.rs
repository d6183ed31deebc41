//! Visibility by an emulated card, which draws the six faces of a cube around the origin of a vertex's rays.
//!
//! Each pixel's center is a fine direction, and a covered pixel is a blocked direction, so no depth buffer is needed.
//! Coordinates are made relative to the eye in f64 and rounded once; the card snaps them to its subpixel grid, so that
//! pixels near a silhouette may differ from rays.

use std::sync::Arc;

use glam::DVec3;
use refsim::device::Profile;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{DrawCall, Executor, Machine, MachineError, TextureId, VertexSource};
use refsim::raster::{PixelCenter, Primitive, Vertex, Viewport};
use refsim::texture::{Region, TexelFormat};

use super::maps::{Horizon, VisibilityMaps, VisibilitySampling};
use super::sight::{above, set};
use super::traced::{check, unclear};
use crate::card::kernels::SHADE_COLOR;
use crate::card::{KernelError, Texels};
use crate::error::InputError;
use crate::geom::vector::wide;
use crate::sphere::{CUBE_FACES, FaceAxes};
use crate::transfer::{Occluders, Vertices, origins};

/// Errors of drawing maps.
#[non_exhaustive]
#[derive(Debug, thiserror::Error)]
pub enum DrawnVisibilityError {
    /// The card refused.
    #[error(transparent)]
    Machine(#[from] MachineError),
    /// The device cannot run the program.
    #[error("{0}\nuse a device with pixel shaders of version 1.1, such as r350")]
    Kernel(#[from] KernelError),
    /// A vertex that does not exist.
    #[error(transparent)]
    Transfer(#[from] InputError),
}

/// A card with a target for the faces of one cube, one below the other.
#[derive(Debug)]
pub struct CubeCard {
    sampling: VisibilitySampling,
    machine: Machine,
    program: CheckedProgram,
    target: TextureId,
}

impl CubeCard {
    /// A card for a device with pixel shaders 1.1.
    ///
    /// # Errors
    /// [`DrawnVisibilityError`] if the card refuses the program or the target.
    pub fn new(
        profile: impl Into<Arc<Profile>>,
        executor: impl Into<Executor>,
        sampling: VisibilitySampling,
    ) -> Result<Self, DrawnVisibilityError> {
        let profile = profile.into();
        let program = SHADE_COLOR.checked(&profile)?;
        let mut machine = executor.into().machine(profile)?;
        let side = sampling.directions().side() as u32;
        let target = machine.create_target(TexelFormat::Bgra8, side, 6 * side)?;
        Ok(Self { sampling, machine, program, target })
    }

    /// The maps of some vertices of a mesh. With [`Horizon::Normal`], triangles wholly below the horizon of a vertex
    /// are not drawn.
    ///
    /// # Errors
    /// [`DrawnVisibilityError`] if a vertex does not exist, or the card refuses.
    pub fn draw(&mut self, vertices: &Vertices, of: &[u32]) -> Result<VisibilityMaps, DrawnVisibilityError> {
        check(vertices, of)?;
        let origins = origins(vertices, &Occluders::new(vertices));
        let mut maps = VisibilityMaps::dark(of, self.sampling);
        maps.counts.unclear = unclear(&origins, of);
        for (map, &vertex) in of.iter().enumerate() {
            let (frame, origin) = (&vertices.frames()[vertex as usize], &origins[vertex as usize]);
            let blocked = self.cube(vertices, wide(origin.at), frame.normal())?;
            let (fine, below) = above(frame, origin, self.sampling);
            let words = self.sampling.words();
            let bits = &mut maps.words_mut()[map * words..(map + 1) * words];
            fine.iter().filter(|&&fine| !blocked[fine as usize]).for_each(|&fine| set(bits, fine));
            maps.counts.above += fine.len() as u64 + below;
            maps.counts.below_triangles += below;
        }
        maps.count_visible();
        Ok(maps)
    }

    /// The covered pixels of a cube around an eye, by number of the fine direction.
    fn cube(&mut self, vertices: &Vertices, eye: DVec3, normal: DVec3) -> Result<Vec<bool>, DrawnVisibilityError> {
        self.machine.clear_target(self.target, [0; 4])?;
        let sees_below = self.sampling.horizon == Horizon::Geometry;
        let triangles = 0..vertices.triangles().len() as u32;
        let seen: Vec<[DVec3; 3]> = triangles
            .map(|triangle| vertices.corners(triangle).map(|corner| corner - eye))
            .filter(|corners| sees_below || corners.iter().any(|corner| normal.dot(*corner) > 0.0))
            .collect();
        for (face, axes) in CUBE_FACES.iter().enumerate() {
            let on_face: Vec<Vertex> = seen
                .iter()
                .filter(|corners| !misses(axes, corners))
                .flatten()
                .map(|corner| vertex(axes, *corner))
                .collect();
            if on_face.is_empty() {
                continue;
            }
            let (side, constants) = (self.sampling.directions().side() as u32, Constants::default());
            let place = Region { x: 0, y: face as u32 * side, width: side, height: side };
            let source = VertexSource::Transformed(&on_face);
            let mut call = DrawCall::new(source, Primitive::TriangleList, &self.program, &constants, self.target);
            call.center = PixelCenter::OpenGl;
            call.viewport = Some(Viewport { y: place.y.cast_signed(), ..Viewport::new(side, side) });
            call.scissor = Some(place);
            self.machine.draw(&call)?;
        }
        let texels = Texels::read_back(&self.machine, self.target)?;
        // Faces are stored one below the other, so that a pixel's index is its direction's number.
        Ok(texels.texels.iter().map(|texel| texel[0] > 0.5).collect())
    }
}

/// x, y (upwards) and w in the clip space of a face.
fn clip(axes: &FaceAxes, corner: DVec3) -> [f64; 3] {
    [axes.right.dot(corner), -axes.down.dot(corner), axes.center.dot(corner)]
}

/// True if a triangle lies wholly outside one plane of a face's viewing pyramid.
fn misses(axes: &FaceAxes, corners: &[DVec3; 3]) -> bool {
    let mut outside = [true; 5];
    for &corner in corners {
        let [x, y, w] = clip(axes, corner);
        outside.iter_mut().zip([w <= 0.0, x < -w, x > w, y < -w, y > w]).for_each(|(all, now)| *all &= now);
    }
    outside.contains(&true)
}

/// A white vertex in the middle of the depth range.
fn vertex(axes: &FaceAxes, corner: DVec3) -> Vertex {
    let [x, y, w] = clip(axes, corner);
    let mut vertex = Vertex { position: [x, y, 0.5 * w, w].map(|value| (value as f32).to_bits()), ..Vertex::default() };
    vertex.colors[0] = [1.0_f32.to_bits(); 4];
    vertex
}
