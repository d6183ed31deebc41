//! Unit tests of the modules; property tests are in `tests/laws`.

mod compare;
mod elementary;
mod geom;
mod oracle;
