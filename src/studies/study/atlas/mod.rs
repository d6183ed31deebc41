//! Study of a mesh's atlas: quality, pictures and files.

mod export;
mod pictures;
mod report;

pub use report::{AtlasStudy, no_atlas};
