//! The multiresolution meshed atlas: a mesh mapped to a square of texels.
//!
//! Every face has a rectangle of texels of its own, and every texel lies on one face. Faces are clustered in a binary
//! tree whose nodes are squares and 2:1 rectangles, so that a texel of a coarser level is the mean of a cluster.
//! docs/atlas.md explains the construction and measures its quality.
//!
//! - [`meshed`]: the atlas itself, and maps between texels and faces;
//! - [`place`]: a face's rectangle, and the map between face and rectangle;
//! - [`texel`]: attributes of texels and clusters;
//! - [`part`]: the part of the surface under a rectangle of texels, as polygons;
//! - [`drawn`]: triangles for drawing into the atlas, and for drawing with texels from the atlas;
//! - [`tree`]: the binary tree of clusters; `graph`, `measures`, `sweep` and `small` build it;
//! - [`census`]: irregularities of a mesh;
//! - [`quality`]: evenness, connectivity and compactness of an atlas.

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
pub use drawn::{DrawnFace, DrawnVertex, WholeFace, WholeVertex};
pub use meshed::{Atlas, MAX_SIDE, require_side};
pub use part::TexelPart;
pub use place::FacePlace;
pub use quality::{AtlasQuality, LevelQuality};
pub use texel::{Cluster, Texel};
pub use tree::{ClusterNode, ClusterTree};
