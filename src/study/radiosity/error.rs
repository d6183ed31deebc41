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

/// Why the study has no findings.
#[non_exhaustive]
#[derive(Debug, Error, Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum RadiosityError {
    /// The scene makes no patches.
    #[error(transparent)]
    #[diagnostic(code(radiosity::patches))]
    Patches(#[from] PatchError),
    /// There are no form factors, or not such as were asked for.
    #[error(transparent)]
    #[diagnostic(code(radiosity::form_factors))]
    FormFactors(#[from] FormFactorError),
    /// There is no system.
    #[error(transparent)]
    #[diagnostic(code(radiosity::system))]
    System(#[from] SystemError),
    /// No light.
    #[error("expected a scene with a material that shines, found none")]
    #[diagnostic(code(radiosity::dark), help("give a material an emission: `Ke` in an MTL file"))]
    Dark,
    /// A material that is to change is not there.
    #[error("the scene has no material `{name}`")]
    #[diagnostic(code(radiosity::material), help("{}its materials are {}", did_you_mean(name, known.iter().map(String::as_str)), known.join(", ")))]
    NoMaterial { name: String, known: Vec<String> },
    /// A solver of the host.
    #[error(transparent)]
    #[diagnostic(code(radiosity::solve))]
    Solve(#[from] SolveError),
    /// The card.
    #[error(transparent)]
    #[diagnostic(code(radiosity::card))]
    Card(#[from] CardError),
    /// The pictures.
    #[error(transparent)]
    #[diagnostic(code(radiosity::display))]
    Draw(#[from] DrawError),
    /// The atlas.
    #[error(transparent)]
    #[diagnostic(code(radiosity::atlas), help("ask for a larger `--atlas`, or for fewer patches"))]
    Atlas(#[from] AtlasError),
    /// A machine for the pictures.
    #[error(transparent)]
    #[diagnostic(code(radiosity::machine))]
    Machine(#[from] MachineError),
    /// A switch.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Device(#[from] DeviceError),
    /// The time of an iteration.
    #[error(transparent)]
    #[diagnostic(code(radiosity::rate))]
    Rate(#[from] RateError),
    /// The timeline.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Timeline(#[from] TimelineError),
    /// A picture that cannot be shown.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Picture(#[from] PictureError),
}
