//! Unit tests of the modules; property tests are in `tests/laws`.

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
