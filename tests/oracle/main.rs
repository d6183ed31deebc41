//! Tests with stored bits, which fail if the bits change.

#[path = "../../refsim/tests/common/environment.rs"]
mod environment;
mod leaky_page;
mod leaky_teapot;
mod linalg;
#[path = "../support/pages.rs"]
mod pages;
mod probes;
mod teapot_study;
