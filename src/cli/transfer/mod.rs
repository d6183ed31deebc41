//! Options of the commands about transfer, `cpca`, `all-frequency` and `bi-scale`: a model and its vertices, distant
//! light, reflectance, and pictures.

pub(super) mod light;
pub(super) mod model;
pub(super) mod picture;
pub(super) mod values;
