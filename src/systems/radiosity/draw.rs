//! Projection of patches to vertices.

use glam::DVec3;
use refsim::machine::MachineError;
use refsim::raster::Vertex;
use thiserror::Error;

use super::Patch;
use crate::card::KernelError;
use crate::geom::vector::{narrow, wide};
use crate::scene::Camera;

/// Distance from a patch's plane, relative to the patch's radius, within which an eye sees neither side.
const EDGE_ON: f64 = 1e-9;

/// Error of drawing patches.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
pub enum DrawError {
    /// The card rejects a resource or a draw.
    #[error(transparent)]
    Machine(#[from] MachineError),
    /// The device rejects a program.
    #[error("{0}\nuse a device with fragment programs (`!!FP1.0`), such as nv35")]
    Kernel(#[from] KernelError),
    /// The number of radiosities differs from the number of patches.
    #[error("expected {patches} radiosities, one per patch, found {found}")]
    Count { patches: usize, found: usize },
}

/// A perspective projection: an eye, and the axes of its clip space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Projection {
    eye: DVec3,
    /// Axis of clip space's w; of unit length.
    forward: DVec3,
    /// Axis of clip space's x.
    across: DVec3,
    /// Axis of clip space's y, upwards.
    upwards: DVec3,
    /// Bound on the distance of any vertex, measured along `forward`.
    far: f64,
}

impl Projection {
    pub(super) fn of(camera: &Camera, within: DVec3, extent: f64) -> Self {
        let eye = wide(camera.eye());
        let per_square = |v: DVec3| 1.0 / v.dot(v) * v;
        Self {
            eye,
            forward: camera.forward(),
            across: per_square(camera.right()),
            upwards: per_square(camera.up()),
            far: (within - eye).length() + extent,
        }
    }

    /// Returns x, y and w in clip space.
    fn clip(&self, point: DVec3) -> [f64; 3] {
        let to = point - self.eye;
        [self.across, self.upwards, self.forward].map(|axis| axis.dot(to))
    }

    /// Returns `true` if a patch lies wholly outside one plane of the view frustum.
    pub(super) fn misses(&self, patch: &Patch) -> bool {
        let mut outside = [true; 5];
        for &corner in patch.corners() {
            let [x, y, w] = self.clip(shared(corner));
            let now = [w <= 0.0, x < -w, x > w, y < -w, y > w];
            outside.iter_mut().zip(now).for_each(|(all, now)| *all &= now);
        }
        outside.contains(&true)
    }

    /// `true` if the eye sees the front of a patch, `false` for the back, which is black, `None` if it is edge-on.
    pub(super) fn sees_front(&self, patch: &Patch) -> Option<bool> {
        let (height, least) = (patch.height(self.eye), EDGE_ON * patch.radius());
        (height.abs() > least).then_some(height > 0.0)
    }

    /// A corner with its coordinates in the patch, `TEX0` of the programs: u, v, depth, 1 in front and 0 behind.
    ///
    /// The program writes depth as the distance along the view divided by the largest such distance. Its precision is
    /// equal at all distances, and there is no near plane. z in clip space is half of w, so it clips nothing.
    pub(super) fn vertex(&self, corner: DVec3, [u, v]: [f64; 2], is_front: bool) -> Vertex {
        let [x, y, w] = self.clip(shared(corner));
        let mut vertex = Vertex { position: bits([x, y, 0.5 * w, w]), ..Vertex::default() };
        vertex.texcoords[0] = bits([u, v, w / self.far, if is_front { 1.0 } else { 0.0 }]);
        vertex
    }
}

/// Encodes a patch's number as a color: counted from 1, negative for the back; 0 means no patch.
pub(super) fn code(patch: usize, is_front: bool) -> f64 {
    let number = (patch + 1) as f64;
    if is_front { number } else { -number }
}

/// Decodes the patch whose front is seen in a pixel; `None` for a back or no patch.
pub(super) fn patch_of(code: f32) -> Option<u32> {
    (code >= 1.0).then(|| code as u32 - 1)
}

/// Rounds a corner to f32, so that neighbours in other faces have equal bits.
fn shared(corner: DVec3) -> DVec3 {
    wide(narrow(corner))
}

/// Converts a vector to f32 bits, each component rounded once.
pub(super) fn bits(vector: [f64; 4]) -> [u32; 4] {
    vector.map(|x| (x as f32).to_bits())
}
