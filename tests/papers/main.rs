//! Printed figures of the papers, and their consequences.

mod cpca_appendix;
#[path = "../../refsim/tests/common/environment.rs"]
mod environment;
#[path = "../support/pages.rs"]
mod pages;
mod radiosity;
mod ray_cache;
mod ray_engine;
mod reproduce;
mod subsurface_material;
