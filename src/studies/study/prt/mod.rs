//! Precomputed radiance transfer from a model to a file ([`Precomputation`]), how far compression is off
//! ([`CompressionError`]), pictures ([`Rendering`]), pictures by an emulated card ([`OnCard`]), and
//! factors of a reflectance ([`BrdfFactors`]). The same of all frequencies: [`SightOfModel`],
//! [`SegmentedCompression`], [`AllFrequencyRendering`], [`AllFrequencyOnCard`]. Bi-scale transfer: pictures
//! ([`BiScaleRendering`], [`BiScaleOnCard`]), and ways to store it side by side ([`StoredComparison`]).

mod all_frequency;
mod bi_scale;
mod card;
mod compression_error;
mod exit_radiance;
mod factor;
mod fine_view;
mod interpolate;
mod light_picture;
mod precompute;
mod render;
mod stored_ways;
mod vertex_values;

pub(super) use all_frequency::exact::transferred as raw_radiance;
pub use all_frequency::{
    AllFrequencyError, AllFrequencyRendering, CodedErrors, CompressionTally, FoundSight, KeptSegments,
    KeptSegmentsError, LitModel, RenderedGround, SegmentTally, SegmentedCompression, SegmentedError, SightOfModel,
    coded_errors,
};
pub(super) use bi_scale::{BiScaleDrawing, CausePictures};
pub use bi_scale::{
    BiScaleError, BiScaleRendering, LocalLight, SurfaceError, SurfaceTexture, TexturedSurface, creased,
};
pub use card::{
    AllFrequencyOnCard, BiScaleOnCard, CardPictureError, CardSetting, OnCard, PictureVariant, PixelErrors,
    factored_precision, variants_table,
};
pub use compression_error::CompressionError;
pub(super) use exit_radiance::Lit;
pub use factor::{BrdfFactors, BrdfFactorsError, FactorSubject};
pub(super) use factor::{SweptRoughness, roughness_table};
pub(super) use fine_view::{FineView, filtered};
pub(super) use interpolate::{Seen, linear_picture};
pub(super) use light_picture::{light_picture, of_texels};
pub use precompute::{ExitRadiance, Precomputation, PrecomputeError, Precomputed, Scatterer};
pub use render::{RenderError, Rendering, Turning};
pub(super) use render::{auto_exposure, cluster_color};
pub use stored_ways::{LightChannels, StoredComparison, StoredWay, stored_ways_table};
pub use vertex_values::{ValuesFormat, VertexValues};
