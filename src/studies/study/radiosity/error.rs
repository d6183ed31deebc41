//! Errors of the radiosity study.

use miette::Diagnostic;
use refsim::device::DeviceError;
use refsim::machine::MachineError;
use thiserror::Error;

use crate::atlas::AtlasError;
use crate::names::did_you_mean;
use crate::picture::PictureError;
use crate::radiosity::on_card::CardError;
use crate::radiosity::rate::RateError;
use crate::radiosity::solve::SolveError;
use crate::radiosity::{DrawError, FormFactorError, PatchError, SystemError};
use crate::study::timeline_trace::TimelineError;

/// Error of the study.
#[non_exhaustive]
#[derive(Debug, Error, Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum RadiosityError {
    /// The scene cannot be cut into patches.
    #[error(transparent)]
    #[diagnostic(code(radiosity::patches))]
    Patches(#[from] PatchError),
    /// Form factors cannot be computed, or do not meet the requirements.
    #[error(transparent)]
    #[diagnostic(code(radiosity::form_factors))]
    FormFactors(#[from] FormFactorError),
    /// The system's input is invalid.
    #[error(transparent)]
    #[diagnostic(code(radiosity::system))]
    System(#[from] SystemError),
    /// The scene has no light.
    #[error("expected a scene with a material that shines, found none")]
    #[diagnostic(code(radiosity::dark), help("give a material an emission: `Ke` in an MTL file"))]
    Dark,
    /// A material to change does not exist.
    #[error("the scene has no material `{name}`")]
    #[diagnostic(code(radiosity::material), help("{}its materials are {}", did_you_mean(name, known.iter().map(String::as_str)), known.join(", ")))]
    NoMaterial { name: String, known: Vec<String> },
    /// A solver of the host failed.
    #[error(transparent)]
    #[diagnostic(code(radiosity::solve))]
    Solve(#[from] SolveError),
    /// The card failed to solve the system.
    #[error(transparent)]
    #[diagnostic(code(radiosity::card))]
    Card(#[from] CardError),
    /// The pictures cannot be drawn.
    #[error(transparent)]
    #[diagnostic(code(radiosity::display))]
    Draw(#[from] DrawError),
    /// The atlas cannot be built.
    #[error(transparent)]
    #[diagnostic(code(radiosity::atlas), help("ask for a larger `--atlas`, or for fewer patches"))]
    Atlas(#[from] AtlasError),
    /// A machine for the pictures cannot be created.
    #[error(transparent)]
    #[diagnostic(code(radiosity::machine))]
    Machine(#[from] MachineError),
    /// A switch is invalid.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Device(#[from] DeviceError),
    /// An iteration cannot be timed.
    #[error(transparent)]
    #[diagnostic(code(radiosity::rate))]
    Rate(#[from] RateError),
    /// The timeline cannot be built.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Timeline(#[from] TimelineError),
    /// A picture cannot be encoded.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Picture(#[from] PictureError),
}
