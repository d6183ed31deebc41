//! Stored bits: they fail when they change.

#[path = "../../refsim/tests/common/environment.rs"]
mod environment;
mod leaky_page;
mod leaky_teapot;
mod linalg;
mod probes;
mod teapot_study;
mod timing;
