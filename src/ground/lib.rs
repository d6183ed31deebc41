//! Shared ground of Crossbar's systems: linear algebra, quadrature, pictures, functions on the sphere, rays on the
//! host, meshes in texels, scenes and their files, cards that compute. `crossbar` re-exports these rooms.

use crossbar_base::{elementary, error, geom};

pub mod atlas;
pub mod card;
pub mod fresnel;
pub mod io;
pub mod linalg;
pub mod names;
pub mod picture;
pub mod quadrature;
pub mod scene;
pub mod sphere;
pub mod tracer;
