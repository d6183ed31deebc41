//! All-frequency transfer on an emulated card (section 6 of the paper, "Per-Vertex Computation").
//!
//! A [`FactoredCard`] holds a mesh. For each frame the host sends the vertex data that [`ProductPlace`] selects: vertex
//! colors, as the authors did, or transferred radiance, which the card multiplies with G per pixel, as they proposed. A
//! [`SumCard`] also takes over step 3 from the host. [`draw`] makes a picture with counts and log; [`mod@reference`] is
//! step 4 in f64; [`time`] models the time of a frame.

mod card;
mod counts;
mod error;
mod frame;
mod maps;
mod options;
mod programs;
pub mod reference;
mod streams;
mod subject;
mod sums;
pub mod time;

pub use card::FactoredCard;
pub use counts::FactoredCounts;
pub use error::FactoredCardError;
pub use frame::{FactoredDrawing, draw};
pub use options::{ProductOptions, ProductPlace, RadianceFormat, VertexColors, ViewMaker};
pub use subject::TransferredMesh;
pub use sums::{SumCard, SumLog};

#[cfg(test)]
mod tests;
