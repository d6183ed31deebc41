//! The multiresolution meshed atlas: a mesh mapped to a square of texels.
//!
//! Every face has its own rectangle of texels, and every texel lies on one face. Faces are clustered in a binary
//! tree whose nodes are squares and 2:1 rectangles, so that a texel of a coarser level is the mean of a cluster.
//! docs/atlas.md explains the construction and measures its quality.

pub mod census;
pub mod drawn;
mod graph;
mod levels;
mod measures;
pub mod meshed;
pub mod part;
pub mod place;
pub mod quality;
mod small;
mod surface;
mod sweep;
pub mod texel;
pub mod tree;

pub use census::Census;
pub use drawn::{DrawnFace, DrawnVertex};
pub use meshed::{Atlas, MAX_SIDE, require_side};
pub use part::TexelPart;
pub use place::FacePlace;
pub use quality::{AtlasQuality, LevelQuality};
pub use texel::{Cluster, Texel};
pub use tree::{ClusterNode, ClusterTree};
