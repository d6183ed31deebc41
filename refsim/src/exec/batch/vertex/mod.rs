//! Vertex processing and triangle set-up in rows.
//!
//! - `program`: vertex programs; `rows`: vertices; `window`: viewport transform and clip tests.
//! - `build`, `surfaces`: triangles.

mod build;
mod program;
mod rows;
mod surfaces;
mod window;

pub use build::Instances;
pub(crate) use program::VertexPrograms;
pub use program::{AttributeRows, BatchVertices};
pub use rows::VertexRows;
pub use surfaces::Surfaces;
pub(crate) use surfaces::{PlaneRows, Triangle};
