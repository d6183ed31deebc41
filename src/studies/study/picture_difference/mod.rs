//! Study of the difference of two pictures: numerical and perceptual.

mod compare;
mod report;

pub use compare::{DifferenceOptions, PictureDifference, PictureInput};
