//! Radiance transfer drawn by an emulated card: errors of its pictures, their causes, and the time of a frame.
//! [`OnCard`] is about clustered principal components, [`AllFrequencyOnCard`] about all-frequency and [`BiScaleOnCard`]
//! about bi-scale transfer. A study consists of its system's subject and a [`CardSetting`]; the other files contain the
//! reports that they share.

mod all_frequency;
mod bi_scale;
mod cpca;
mod errors;
mod factored;
mod setting;

pub use all_frequency::AllFrequencyOnCard;
pub use bi_scale::BiScaleOnCard;
pub use cpca::OnCard;
pub use errors::{PictureVariant, PixelErrors, variants_table};
pub use factored::factored_precision;
pub use setting::CardSetting;
