//! Parameters of the study.

use refsim::device::Profile;
use refsim::machine::Executor;

use super::change::Change;
use super::method::SolveMethod;
use crate::radiosity::Subdivision;
use crate::radiosity::form_factor::VisibilityParameters;
use crate::radiosity::solve::Options;
use crate::scene::{Camera, Scene};

/// Parameters of the study: scene, methods and output.
#[derive(Debug)]
pub struct Parameters {
    /// Scene.
    pub scene: Scene,
    /// Fineness of its subdivision.
    pub subdivision: Subdivision,
    /// Computation of form factors, and their requirements.
    pub factors: FactorRequirements,
    /// Methods, one row of the table for each.
    pub methods: Vec<SolveMethod>,
    /// Card of the methods that run on one.
    pub profile: Profile,
    /// Switches of the card that were set.
    pub switches: Vec<(String, String)>,
    /// Executor of the card.
    pub executor: Executor,
    /// Stopping criteria.
    pub options: Options,
    /// Changes after the first solution.
    pub changes: Vec<Change>,
    /// Camera of the pictures.
    pub camera: Camera,
    /// Factor of radiance in pictures; `None` for auto-exposure: surfaces that do not emit at 18 % grey on average.
    pub exposure: Option<f64>,
    /// Iterations of the first method on a card after which pictures are drawn.
    pub frames: Vec<u32>,
    /// Side of a meshed atlas that a solution is resampled into, in texels; `None` for no atlas.
    pub atlas: Option<u32>,
    /// Numbers of patches of the sweep, in which the room is solved on the card under each of its open switches.
    pub sweep: Vec<u32>,
}

/// Computation of form factors, and their requirements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FactorRequirements {
    /// Source of the form factors.
    pub from: Factors,
    /// Maximum deviation of a row sum from 1, above which the study fails.
    pub closed: Option<f64>,
    /// `true` to make A_i F_ij and A_j F_ji equal.
    pub enforce_reciprocity: bool,
    /// `true` to make rows sum to 1 (and pairs reciprocal).
    pub enforce_closure: bool,
}

/// Source of form factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Factors {
    /// Without occlusion.
    Unoccluded,
    /// Closed forms and contour integrals, times the visible fraction by rays.
    Rays(VisibilityParameters),
    /// Hemicubes drawn from each patch by the study's card.
    Hemicube {
        /// Pixels along a side of the top face.
        resolution: u32,
    },
}

impl std::fmt::Display for Factors {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Unoccluded => f.write_str("unoccluded"),
            Self::Rays(VisibilityParameters { side, .. }) => write!(f, "{} rays a pair", side * side),
            Self::Hemicube { resolution } => write!(f, "hemicubes of {resolution}"),
        }
    }
}
