//! Facts of the rooms, beside the laws of `tests/laws`.

mod compare;
mod elementary;
mod geom;
mod oracle;
