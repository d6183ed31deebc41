//! Triangle set-up: directly if no clip plane cuts the triangle, else after clipping.

use super::clip::{ClipVertex, clip, is_inside};
use super::fan::clipped_setup;
use super::state::{RasterRules, RasterState};
use super::triangle::{Dropped, SetupReport, TriangleSetup, prepare};
use super::vertex::Vertex;
use super::window::to_window;
use crate::texture::value;

/// Sets up a triangle, and appends one result, or several if clipping leaves more than three corners.
pub fn setup(
    triangle: [&Vertex; 3],
    state: &RasterState,
    rules: &RasterRules,
    out: &mut Vec<TriangleSetup>,
) -> SetupReport {
    match unclipped(triangle, state, rules) {
        Some(Ok(done)) => {
            out.push(done);
            SetupReport { emitted: 1, dropped: None }
        }
        Some(Err(why)) => SetupReport { emitted: 0, dropped: Some(why) },
        None => clipped_setup(&clip(triangle, state.clip_space), state, rules, out),
    }
}

/// Sets up a triangle; `None` if a clip plane cuts it.
fn unclipped(
    triangle: [&Vertex; 3],
    state: &RasterState,
    rules: &RasterRules,
) -> Option<Result<TriangleSetup, Dropped>> {
    if triangle.iter().any(|v| v.position.iter().any(|&p| value::is_not_finite(p))) {
        return Some(Err(Dropped::NotFinite));
    }
    is_inside(&triangle, state.clip_space).then(|| setup_inside(&triangle.map(ClipVertex::new), state, rules))
}

/// Sets up a triangle that needs no clipping.
fn setup_inside(
    vertices: &[ClipVertex; 3],
    state: &RasterState,
    rules: &RasterRules,
) -> Result<TriangleSetup, Dropped> {
    let [Some(c0), Some(c1), Some(c2)] = vertices.map(|v| to_window(v.position, state, rules)) else {
        return Err(Dropped::NotFinite);
    };
    prepare(vertices, [c0, c1, c2], state, rules)
}
