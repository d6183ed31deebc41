//! Interface of a system to its subject, and what inputs share.

use std::fmt;

use glam::DVec3;
use refsim::device::Profile;
use refsim::machine::Executor;

use crate::geom::Mesh;
use crate::geom::vector::{narrow, wide};
use crate::scene::Camera;
use crate::scene::built::transfer_models::TransferModel;
use crate::study::StudyError;
use crate::study::precision::goal::{Goal, GoalRelation};

/// Input of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SystemInput {
    /// That of the search.
    Searched,
    /// Another view or light.
    HeldBack,
}

/// System with its input, run on a device.
pub(super) trait SystemRun: fmt::Debug {
    /// Title of the study.
    fn title(&self) -> &'static str;

    /// Name of a value: `pixel`, `patch`.
    fn unit(&self) -> &'static str;

    /// Red, green and blue of each pixel or patch. Pictures are exposed, so that white is 1.
    ///
    /// # Errors
    /// If the device cannot run the programs.
    fn values(&self, input: SystemInput, profile: &Profile, executor: &Executor) -> Result<Vec<[f64; 3]>, StudyError>;

    /// Width and height of the picture, if the values are one.
    fn size(&self) -> Option<[u32; 2]> {
        None
    }

    /// Goal if none is given.
    fn default_goal(&self) -> Goal;
}

/// Goal that a measure is at most a bound.
pub(super) fn at_most(measure: &str, bound: f64) -> Goal {
    Goal { measure: measure.to_owned(), relation: GoalRelation::AtMost, bound }
}

/// Stanford bunny of few vertices.
pub(super) fn bunny() -> Mesh {
    TransferModel::BiScaleBunny.mesh(3)
}

/// Camera that frames a mesh in a square picture; from another side for the view that is held back.
pub(super) fn camera(mesh: &Mesh, side: u32, input: SystemInput) -> Camera {
    let [low, high] = mesh.bounds().map_or([DVec3::ZERO; 2], |bounds| bounds.map(wide));
    let (middle, radius) = (0.5 * (low + high), 0.5 * (high - low).length());
    let towards = match input {
        SystemInput::Searched => DVec3::new(0.35, -0.9, 0.3),
        SystemInput::HeldBack => DVec3::new(-0.9, 0.2, 0.5),
    };
    let eye = middle + 2.4 * radius * towards.normalize();
    Camera::new(narrow(eye), narrow(middle), [0.0, 0.0, 1.0], 0.42, side, side).expect("an eye outside the mesh")
}
