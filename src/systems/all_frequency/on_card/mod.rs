//! All-frequency transfer on an emulated card (section 6 of the paper, "Per-Vertex Computation").
//!
//! A [`FactoredCard`] holds a mesh. For each frame the host sends the vertex data that [`ProductPlace`] selects: vertex
//! colors, as in the authors' implementation, or transferred radiance, which the card multiplies with G per pixel, as
//! the authors propose. [`draw`] creates a picture with counts and log; [`mod@reference`] is step 4 in f64; [`time`]
//! models the time of a frame.

mod attributes;
mod card;
mod options;
mod programs;
pub mod reference;
pub mod time;

pub use attributes::{FactoredCounts, TransferredMesh};
pub use card::{FactoredCard, FactoredDrawing, draw};
pub use options::{ProductOptions, ProductPlace, RadianceFormat, VertexColors};
