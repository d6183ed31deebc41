//! Renderers on the host, the applications of a ray engine (Ray Engine, section 5.2). docs/renderers.md states what
//! each one estimates.
//!
//! - [`eye`]: eye rays alone, shaded by a light at the eye;
//! - [`whitted`]: point lights with hard shadows, mirrors, glass (Whitted 1980);
//! - [`environment`]: the same with cube maps in place of reflected rays, drawn by a card (Blinn and Newell 1976);
//! - [`distributed`]: soft shadows, gloss, depth of field (Cook, Porter and Carpenter 1984);
//! - [`path`]: path tracing, unbiased (Kajiya 1986; Veach 1997);
//! - [`photon`]: photon maps with final gather (Jensen 1996), biased and smooth.
//!
//! All work breadth first: they cast a bundle of rays, shade, and generate the next bundle. Random numbers are keyed by
//! pixel, sample and dimension, and all sums run in the order of samples, so the picture depends on the caster only
//! where casters differ in the first triangle of a ray.

mod counting;
pub mod distributed;
pub mod environment;
pub mod eye;
mod film;
mod layers;
mod lights;
mod lobes;
pub mod path;
pub mod photon;
#[doc(hidden)] // held against a search among all photons
pub mod photon_map;
pub mod sampling;
mod settings;
mod surfel;
mod vector;
mod wave;
pub mod whitted;

pub use counting::{RayCounts, RayKind, RenderProgress, WatchProgress};
pub use film::RenderedPicture;
pub use layers::layers;
pub use settings::{Lens, Settings};
