//! The paper on real-time all-frequency bi-scale transfer by biclustering.

mod counts;
mod figure_6;
mod printed;
mod stand_in;
mod table_2;

pub(super) use counts::findings as counts;
pub(super) use figure_6::findings as figure_6;
pub(super) use table_2::findings as table_2;

use super::pipeline::failed;
use super::shared::Shared;
use super::{
    Bound, EntryFindings, Method, ModelSize, Origin, PaperFigure, PaperRow, Prose, ReproduceError, Standing, number,
};

/// Where biclusters are made.
const HOST: &str = "host";
