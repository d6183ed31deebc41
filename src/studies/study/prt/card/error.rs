//! Errors of studies of a card's picture, of all systems.

use miette::Diagnostic;
use refsim::device::DeviceError;
use thiserror::Error;

use crate::all_frequency::code::CodeOptionsError;
use crate::all_frequency::on_card::FactoredCardError;
use crate::all_frequency::shade::LightSizeError;
use crate::bi_scale::on_card::BiScaleCardError;
use crate::card::MeshError;
use crate::card::frame_time::FrameTimeError;
use crate::cpca::on_card::PrtCardError;
use crate::picture::PictureError;
use crate::sphere::HemisphereError;
use crate::study::timeline_trace::TimelineError;
use crate::transfer::TransferError;
use crate::transfer::light::CubeLightError;

/// A card's picture that cannot be drawn or compared.
#[non_exhaustive]
#[derive(Debug, Error, Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum CardPictureError {
    /// A signal that is no transfer.
    #[error("expected transfer, found numbers without a meaning")]
    #[diagnostic(code(crossbar::prt::meaning), help("compress a file that `crossbar cpca precompute` wrote"))]
    NoTransfer,
    /// Sums over representatives of transfer that has none.
    #[error("expected coded transfer, whose representatives a card sums, found visibility alone")]
    #[diagnostic(code(crossbar::prt::card), help("`crossbar all-frequency compress` codes it"))]
    NotCoded,
    /// Parts that do not go together.
    #[error("expected transfer of {expected} {what}, found {found}")]
    #[diagnostic(
        code(crossbar::prt::bi_scale),
        help("precompute transfer with as many `--directions` as the texture has for light")
    )]
    Size { what: &'static str, expected: usize, found: usize },
    /// A device of the sweep is not known.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Device(#[from] DeviceError),
    /// Light that cannot be a cube of texels.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::light))]
    Light(#[from] CubeLightError),
    /// Coded transfer of more segments than light has.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::segments))]
    Segments(#[from] LightSizeError),
    /// Transfer cannot be computed.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::precompute))]
    Transfer(#[from] TransferError),
    /// Numbers of bits that no code has.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::code))]
    Code(#[from] CodeOptionsError),
    /// The basis of exit radiance is invalid.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::functions))]
    Functions(#[from] HemisphereError),
    /// The card refuses clustered principal components.
    #[error(transparent)]
    #[diagnostic(
        code(crossbar::prt::card),
        help("`crossbar cpca render` draws on the host what no card takes; `crossbar devices` lists cards")
    )]
    Clusters(#[from] PrtCardError),
    /// The card refuses all-frequency transfer.
    #[error(transparent)]
    #[diagnostic(
        code(crossbar::prt::card),
        help(
            "`--way colors` runs on every card; `crossbar all-frequency render` draws on the host what no card takes"
        )
    )]
    Factors(#[from] FactoredCardError),
    /// The card refuses bi-scale transfer.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::card))]
    BiScale(#[from] BiScaleCardError),
    /// The mesh cannot be drawn.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::card))]
    Mesh(#[from] MeshError),
    /// The frame has no time.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::time))]
    Time(#[from] FrameTimeError),
    /// The frame has no timeline.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Timeline(#[from] TimelineError),
    /// A picture that cannot be shown.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Picture(#[from] PictureError),
}
