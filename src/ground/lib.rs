//! Modules that Crossbar's systems share: linear algebra, quadrature, pictures, functions on the sphere, rays on the
//! host, texture atlases of meshes, scenes and their files, cards that compute. `crossbar` re-exports these modules.

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
