//! Errors of the subsurface study.

use miette::Diagnostic;
use refsim::timing::TimingError;
use thiserror::Error;

use crate::atlas::AtlasError;
use crate::picture::PictureError;
use crate::study::timeline_trace::TimelineError;
use crate::subsurface::MaterialError;
use crate::subsurface::factor::FactorError;
use crate::subsurface::on_card::SubsurfaceCardError;
use crate::subsurface::walk::MeshWalkError;
use crate::tracer::CastError;

/// Why the study has no findings.
#[non_exhaustive]
#[derive(Debug, Error, Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum SubsurfaceError {
    /// There is no atlas of the model.
    #[error(transparent)]
    #[diagnostic(code(subsurface::atlas))]
    Atlas(#[from] AtlasError),
    /// The medium.
    #[error(transparent)]
    #[diagnostic(code(subsurface::material))]
    Material(#[from] MaterialError),
    /// There are no such links.
    #[error(transparent)]
    #[diagnostic(code(subsurface::links))]
    Factor(#[from] FactorError),
    /// The card.
    #[error(transparent)]
    #[diagnostic(code(subsurface::card))]
    Card(#[from] SubsurfaceCardError),
    /// The card has no such switch or value.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Switch(#[from] refsim::device::DeviceError),
    /// A table of irradiances of another mesh.
    #[error("expected an irradiance for each of {faces} faces, found {found}")]
    #[diagnostic(code(subsurface::irradiance), help("a line `r,g,b` per face of the model, in its order"))]
    Faces { faces: usize, found: usize },
    /// Nothing shines on the model.
    #[error("expected light on the model, found none")]
    #[diagnostic(code(subsurface::dark), help("add a `--light`, or move one to where the model's front faces see it"))]
    Dark,
    /// Photons cannot be followed through the model.
    #[error(transparent)]
    #[diagnostic(code(subsurface::walk))]
    Walk(#[from] MeshWalkError),
    /// Shadows of an environment map cannot be traced.
    #[error(transparent)]
    #[diagnostic(code(subsurface::shadows))]
    Shadows(#[from] CastError),
    /// More links than a table lists.
    #[error("expected at most {limit} links to list, found {rows}")]
    #[diagnostic(
        code(subsurface::link_rows),
        help("name texels by `--probe`, or ask for fewer `--links` or a smaller `--atlas`")
    )]
    LinkRows { rows: u64, limit: u64 },
    /// A probe that is nowhere near.
    #[error("the probe {x},{y},{z} is farther from the model than its size")]
    #[diagnostic(code(subsurface::probe), help("a probe is a point of the surface, in the model's units"))]
    Probe { x: f64, y: f64, z: f64 },
    /// The timing model.
    #[error(transparent)]
    #[diagnostic(code(subsurface::timing))]
    Timing(#[from] TimingError),
    /// The timeline.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Timeline(#[from] TimelineError),
    /// A picture that cannot be shown.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Picture(#[from] PictureError),
}
