//! The meso scale: bidirectional textures, the outgoing light of a small surface patch by position, view and light
//! (section III, equation 3).
//!
//! - [`BidirectionalTexture`]: samples of b(u, e, d); [`GridSamples`]: the four views or texels around a place; `file`:
//!   textures as NPY files;
//! - [`HeightField`], [`MesoMaterial`], [`MesoPatch`]: a repeated patch of heights and materials, seen and lit by rays;
//! - [`PatchKind`]: procedural bumps, mail, tiles, bricks and weave.

mod field;
mod file;
mod kinds;
mod patch;
mod ray;
mod response;

pub use field::HeightField;
pub use file::{load_bidirectional_texture, write_bidirectional_texture};
pub use kinds::PatchKind;
pub use patch::{MesoMaterial, MesoPatch, MesoTexel, SeenPoint};
pub use response::{BidirectionalTexture, GridSamples};
