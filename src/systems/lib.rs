//! Six published systems of global illumination on emulated cards, modules that systems 4 to 6 share, and renderers on
//! the host. Systems do not import each other. `crossbar` re-exports these modules.

use crossbar_base::{elementary, error, geom};
use crossbar_ground::{atlas, card, fresnel, io, linalg, picture, quadrature, scene, sphere, tracer};

pub mod all_frequency;
pub mod bi_scale;
pub mod clustering;
pub mod cpca;
pub mod radiosity;
pub mod ray_engine;
pub mod renderer;
pub mod subsurface;
pub mod transfer;
