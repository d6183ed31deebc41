//! Precomputed radiance transfer: from a model to a file ([`Precomputation`]), pictures ([`Rendering`]), pictures by an
//! emulated card ([`OnCard`]), and factors of a reflectance ([`BrdfFactors`]). The same for all-frequency transfer:
//! [`SegmentedCompression`], [`LitModel`], [`AllFrequencyOnCard`]. For bi-scale transfer: [`BiScaleRendering`],
//! [`BiScaleOnCard`].

mod all_frequency;
mod bi_scale;
mod card;
mod factor;
mod interpolate;
mod lit_view;
mod precompute;
mod render;

use crate::card::CardError;
use crate::card::frame_time::FrameTimeError;
use crate::study::StudyError;
use crate::study::error::library_errors;

pub use all_frequency::{LitModel, LitPart, SegmentTally, SegmentedCompression};
pub(super) use bi_scale::{BiScaleDrawing, CausePictures};
pub use bi_scale::{BiScaleRendering, SurfaceTexture, TexturedSurface, creased};
pub use card::{
    AllFrequencyOnCard, BiScaleOnCard, CardSetting, OnCard, PictureVariant, PixelErrors, factored_precision,
    variants_table,
};
pub use factor::{BrdfFactors, FactorSubject};
pub(super) use factor::{SweptRoughness, roughness_table};
pub(super) use interpolate::SeenSurface;
pub use lit_view::LitView;
pub(super) use lit_view::{auto_exposure, light_picture, linear_picture, of_texels};
pub use precompute::{ExitRadiance, Precomputation, Precomputed, Scatterer};
pub(super) use render::Lit;
pub use render::Rendering;

library_errors! {
    CardError => "crossbar::prt::card";
    FrameTimeError => "crossbar::prt::time";
}

pub(super) fn no_cpca_card(error: CardError) -> StudyError {
    let help = "`crossbar cpca render` draws on the host, without a card's limits; `crossbar devices` lists cards";
    StudyError::from(error).with_help(help)
}

pub(super) fn no_all_frequency_card(error: CardError) -> StudyError {
    StudyError::from(error).with_help(
        "`--way colors` runs on every card; `crossbar all-frequency render` draws on the host, without a card's limits",
    )
}
