//! Facts of the rooms, beside the laws of `tests/laws`.

mod atlas;
mod card;
mod fresnel;
mod io;
mod linalg;
mod names;
mod picture;
mod quadrature;
mod scene;
mod sphere;
mod tracer;
