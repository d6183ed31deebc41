//! Picture metrics: differences channel by channel, and perceptual metrics.
//!
//! [`channels`] compares samples. [`ssim`] and [`flip`] compare pictures as displayed ([`ScreenPicture`]): SSIM
//! compares the structure of the luma (Wang, Bovik, Sheikh and Simoncelli, 2004), FLIP predicts the difference that an
//! observer notices when flipping between the two pictures (Andersson et al., 2020). All sums have a fixed order: the
//! same pictures give the same bits.

mod channel;
mod error_sums;
mod filter;
mod flip;
mod luminance;
mod screen;
mod ssim;

pub use channel::{ChannelDifference, WorstSample, channels, signed_differences};
pub use error_sums::{ErrorSums, relative_error, value_error};
pub use flip::{DEFAULT_PPD, FlipMap, MAX_PPD, MIN_PPD, flip};
pub use luminance::{luminance_differences, relative_luminance_differences};
pub use screen::ScreenPicture;
pub use ssim::{WINDOW, ssim};
