//! What the study is asked.

use refsim::device::Profile;
use refsim::machine::Executor;

use super::change::Change;
use super::method::SolveMethod;
use crate::radiosity::Subdivision;
use crate::radiosity::form_factor::VisibilityParameters;
use crate::radiosity::solve::Options;
use crate::scene::{Camera, Scene};

/// What to solve, how, and what to show of it.
#[derive(Debug)]
pub struct Parameters {
    /// The room.
    pub scene: Scene,
    /// How finely it is cut.
    pub subdivision: Subdivision,
    /// How form factors are found, and what they must satisfy.
    pub factors: FactorRequirements,
    /// The methods: a row of the table for each.
    pub ways: Vec<SolveMethod>,
    /// The card for methods on a card.
    pub profile: Profile,
    /// The switches of the card that were set.
    pub switches: Vec<(String, String)>,
    /// The executor of the card.
    pub executor: Executor,
    /// When iterations stop.
    pub options: Options,
    /// What changes after the first solution.
    pub changes: Vec<Change>,
    /// The camera of the pictures.
    pub camera: Camera,
    /// What radiance is multiplied by in pictures; `None` for auto-exposure: surfaces that do not emit at 18 % grey on
    /// average.
    pub exposure: Option<f64>,
    /// Iterations of the first method on a card of which there are pictures.
    pub frames: Vec<u32>,
    /// Texels along a side of a meshed atlas that a solution is resampled into.
    pub atlas: Option<u32>,
    /// Other numbers of patches in which the room is solved on the card, under each of its open switches.
    pub sweep: Vec<u32>,
}

/// How form factors are found, and what they must satisfy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FactorRequirements {
    /// Where they come from.
    pub from: Factors,
    /// Largest deviation of a row sum from 1; a larger one is an error.
    pub closed: Option<f64>,
    /// Make A_i F_ij and A_j F_ji equal.
    pub enforce_reciprocity: bool,
    /// Make rows sum to 1 (and pairs reciprocal).
    pub enforce_closure: bool,
}

/// Where form factors come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Factors {
    /// As if nothing stood between any two patches.
    Unoccluded,
    /// Closed forms and contour integrals, times what rays find open.
    Rays(VisibilityParameters),
    /// Pictures of the scene from each patch, drawn by the study's card.
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
