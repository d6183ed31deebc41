//! All-frequency transfer on an emulated card (section 6 of the paper, "Per-Vertex Computation").
//!
//! A [`FactoredCard`] holds a mesh. For each frame the host sends what [`ProductPlace`] says: colors of vertices, as
//! the authors did, or transferred radiance, of which the card makes the product with G per pixel, as they proposed.
//! A [`SumCard`] takes step 3 from the host too. [`draw`] makes a picture with counts and log; [`mod@reference`] is
//! step 4 in f64; [`time`] says how long a frame takes.

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
