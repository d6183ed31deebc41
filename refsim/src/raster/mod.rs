//! The rasteriser: primitive assembly, clipping, set-up, fill rule and interpolation.
//!
//! Positions are snapped to a fixed-point grid, and coverage is then computed in exact integers, so that two triangles
//! with a common edge cover each pixel along it exactly once. Values are interpolated by a fixed sequence of FP32
//! steps, which an executor with host floats can repeat bit for bit. See docs/numbers.md, "Interpolation".

mod assembly;
mod clip;
mod cover;
mod error;
mod fan;
mod interpolate;
mod plane;
mod primitive;
mod quad;
mod setup;
mod state;
mod triangle;
mod vertex;
mod window;

pub use assembly::{assemble, provoking};
pub(crate) use clip::{GUARD_BAND, LEAST_W};
pub use cover::{PixelQuad, QuadIterator};
pub use error::RasterError;
pub(crate) use interpolate::interpolated;
pub use interpolate::{FragmentInput, Weights};
pub use plane::Plane;
pub(crate) use plane::component_plane;
pub use primitive::{Primitive, Provoking};
pub use quad::full_screen_quad;
pub use setup::setup;
pub use state::{ClipSpace, Cull, PixelCenter, RasterRules, RasterState, Viewport};
pub(crate) use triangle::shape;
pub use triangle::{Dropped, Edge, SetupReport, TriangleSetup};
pub(crate) use vertex::clamped_color;
pub use vertex::{
    COLOR_COMPONENT, COMPONENTS, ComponentMask, FOG_COMPONENT, POSITION_COMPONENT, TEXCOORD_COMPONENT, Vertex,
};
pub(crate) use window::{Corner, FARTHEST, cut_origin};
