//! The studies of Crossbar, one folder per question; the writer of their findings, the values of their options, and
//! case files with their shaders. `crossbar` re-exports these modules.

use crossbar_base::{compare, elementary, error, geom};
use crossbar_ground::{atlas, card, io, linalg, names, picture, scene, sphere, tracer};
use crossbar_systems::{
    all_frequency, bi_scale, clustering, cpca, radiosity, ray_engine, renderer, subsurface, transfer,
};

pub mod case;
pub mod kept;
pub mod options;
pub mod report;
pub mod shader;

pub mod study;
