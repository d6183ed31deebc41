//! From attributes to triangles, in rows.
//!
//! - `program`: vertex programs; `window`: viewport transform and clip tests; `build`, `surfaces`: triangles.

mod build;
mod program;
mod surfaces;
mod window;

pub use build::Instances;
pub(crate) use program::VertexPrograms;
pub use program::{AttributeRows, BatchVertices, VertexRows};
pub use surfaces::Surfaces;
pub(crate) use surfaces::Triangle;
