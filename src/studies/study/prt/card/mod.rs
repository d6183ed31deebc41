//! Radiance transfer drawn by an emulated card: errors of its pictures, their causes, and the time of a frame.
//! [`OnCard`] is about clustered principal components, [`AllFrequencyOnCard`] about all-frequency and [`BiScaleOnCard`]
//! about bi-scale transfer. A study consists of its system's subject and a [`CardSetting`]; this module contains the
//! reports that they share.

mod all_frequency;
mod bi_scale;
mod blame;
mod cpca;
mod difference;
mod frame;
mod setting;
mod sweep;

pub use all_frequency::{AllFrequencyOnCard, factored_precision};
pub use bi_scale::BiScaleOnCard;
pub use cpca::OnCard;
pub use difference::PixelErrors;
pub use setting::CardSetting;
pub use sweep::{PictureVariant, variants_table};
