//! Bi-scale transfer on an emulated card (section V, Rendering; section VI).
//!
//! - [`GatherCard`]: light times biclusters (Algorithm 2) by pixel programs over textures, in the host's order of sums.
//!   The paper's implementation is in CUDA, which is not emulated.
//! - [`BiScaleCard`]: the display: a bidirectional texture in a volume, local light as interpolated texture
//!   coordinates, and passes summed by blending.

mod card;
mod gather;
mod lists;
mod options;
mod parts;
mod subject;
mod textures;

pub use card::{BiScaleCard, DisplayCounts};
pub use gather::{GatherCard, GatherCounts};
pub use options::{DisplayOptions, LightFormat};
pub use subject::{TexturedMesh, corner_coordinates};
pub use textures::{VolumeTexture, volume_image};
