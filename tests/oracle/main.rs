//! Stored bits: these tests fail when they change.

#[path = "../../refsim/tests/common/environment.rs"]
mod environment;
mod leaky_page;
mod leaky_teapot;
mod linalg;
#[path = "../support/pages.rs"]
mod pages;
mod probes;
mod teapot_study;
