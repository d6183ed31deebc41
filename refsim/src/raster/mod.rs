//! From vertices to fragments: assembly, clipping, set-up, the fill rule, interpolation.
//!
//! Positions are snapped to a fixed-point grid once; from there on coverage is decided by exact integers, so that two
//! triangles with a common edge cover each pixel along it exactly once. Values are interpolated by a fixed sequence of
//! FP32 steps that an executor with host floats can repeat bit for bit. docs/numbers.md, "Interpolation".

mod assembly;
mod clip;
mod cover;
mod error;
mod fan;
mod interpolate;
mod plane;
mod setup;
mod vertex;

pub use assembly::{Primitive, Provoking, assemble, provoking};
pub(crate) use clip::LEAST_W;
pub use cover::{PixelQuad, QuadIterator};
pub use error::RasterError;
pub(crate) use interpolate::interpolated;
pub use interpolate::{ComponentMask, FragmentInput, Weights};
pub(crate) use plane::component_plane;
pub use setup::{
    ClipSpace, Cull, Dropped, Edge, PixelCenter, Plane, RasterRules, RasterState, SetupReport, TriangleSetup, Viewport,
    setup,
};
pub(crate) use setup::{Corner, FARTHEST, GUARD_BAND, shape};
pub use vertex::{COLOR_COMPONENT, COMPONENTS, FOG_COMPONENT, POSITION_COMPONENT, TEXCOORD_COMPONENT, Vertex};
