//! Laws: properties that every input must have, checked by property tests and formulas.

mod all_frequency;
#[path = "../archive.rs"]
mod archive;
mod atlas;
mod bi_scale;
mod card;
mod compare;
mod cpca;
#[path = "../../refsim/tests/common/environment.rs"]
mod environment;
mod files;
mod geom;
mod measuring;
mod oracle;
#[path = "../support/pages.rs"]
mod pages;
mod radiosity;
mod ray_engine;
mod readers;
mod renderer;
mod report;
mod sphere;
mod subsurface;
mod support;
mod timing;
