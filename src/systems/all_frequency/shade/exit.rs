//! Step 4 of section 6: radiance of vertices towards the eye.

use glam::DVec3;
use rayon::prelude::*;

use crate::all_frequency::Reflectance;
use crate::geom::vector::wide;
use crate::transfer::Vertices;

/// G(v) . T_p times the surface's color for every vertex: `color` returns the color of a vertex, `transferred` a row of
/// its T_p. `eye` is in the frame of the mesh. Truncated factors have negative lobes: negative results are kept.
pub fn exit_radiance(
    vertices: &Vertices,
    reflectance: &Reflectance,
    color: &(dyn Fn(usize) -> [f64; 3] + Sync),
    transferred: &(dyn Fn(usize, usize) -> [f64; 3] + Sync),
    eye: DVec3,
) -> Vec<[f64; 3]> {
    let of = |vertex: usize| {
        let view = (eye - wide(vertices.positions()[vertex])).normalize_or_zero();
        let mut g = vec![0.0; reflectance.terms()];
        reflectance.view(vertices.frames()[vertex].to_local(view), &mut g);
        let mut sum = [0.0; 3];
        for (row, g) in g.iter().enumerate() {
            let product = transferred(vertex, row);
            (0..3).for_each(|channel| sum[channel] += g * product[channel]);
        }
        let color = color(vertex);
        [0, 1, 2].map(|channel| sum[channel] * color[channel])
    };
    (0..vertices.len()).into_par_iter().map(of).collect()
}
