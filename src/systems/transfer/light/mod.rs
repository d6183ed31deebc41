//! Distant light as radiances of a cube map of 6 x 32 x 32 texels, and its Haar coefficients (section 6).
//!
//! - [`CubeLight`]: the texels, computed from any function of directions, supersampled 4 x 4 and decimated;
//! - [`DiskSource`]: small sources, added with exact energy;
//! - [`HaarLight`]: coefficients by segment;
//! - [`TruncationPriority`]: the order in which coefficients are kept.

mod coefficients;
mod cube_light;
mod disks;
mod distant;

pub use coefficients::{HaarLight, LightTruncation, TruncationPriority};
pub use cube_light::CubeLight;
pub use disks::DiskSource;
pub use distant::DistantLight;
