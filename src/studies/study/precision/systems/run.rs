//! Interface of a system to its subject, and code shared by inputs.

use std::fmt;

use glam::DVec3;
use refsim::device::Profile;
use refsim::machine::Executor;

use crate::geom::Mesh;
use crate::geom::vector::{narrow, wide};
use crate::scene::Camera;
use crate::scene::built::transfer_models::TransferModel;
use crate::study::StudyError;
use crate::study::precision::goal::Goal;

/// Number of pixels per side of the pictures.
const PICTURE: u32 = 64;

/// Input of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SystemInput {
    /// Input of the search.
    Searched,
    /// Another view or light.
    HeldBack,
}

/// System with its input, run on a device.
pub(super) trait SystemRun: fmt::Debug {
    /// Title of the study.
    fn title(&self) -> &'static str;

    /// Name of a value: `pixel`, `patch`.
    fn unit(&self) -> &'static str {
        "pixel"
    }

    /// Red, green and blue of each pixel or patch. Pictures are exposed, with white at 1. Fails if the device cannot
    /// run the programs.
    fn values(&self, input: SystemInput, profile: &Profile, executor: &Executor) -> Result<Vec<[f64; 3]>, StudyError>;

    /// Width and height of the picture, if the values form one.
    fn size(&self) -> Option<[u32; 2]> {
        Some([PICTURE; 2])
    }

    /// Default goal: the error in 8-bit codes is at most one.
    fn default_goal(&self) -> Goal {
        Goal::at_most("largest_255ths", 1.0)
    }
}

/// Stanford bunny with few vertices.
pub(super) fn bunny() -> Mesh {
    TransferModel::BiScaleBunny.mesh(3)
}

/// Cameras that frame a mesh in a picture, by [`SystemInput`]; the held-back view is from another side.
pub(super) fn cameras(mesh: &Mesh) -> [Camera; 2] {
    let [low, high] = mesh.bounds().map_or([DVec3::ZERO; 2], |bounds| bounds.map(wide));
    let (middle, radius) = (0.5 * (low + high), 0.5 * (high - low).length());
    [DVec3::new(0.35, -0.9, 0.3), DVec3::new(-0.9, 0.2, 0.5)].map(|towards| {
        let eye = middle + 2.4 * radius * towards.normalize();
        let (eye, middle) = (narrow(eye), narrow(middle));
        Camera::new(eye, middle, [0.0, 0.0, 1.0], 0.42, PICTURE, PICTURE).expect("an eye outside the mesh")
    })
}
