//! Transferred radiance, and step 4 of section 6: radiance of vertices towards the eye.

use glam::DVec3;
use rayon::prelude::*;

use crate::all_frequency::Reflectance;
use crate::error::{InputError, ensure};
use crate::geom::vector::wide;
use crate::transfer::Vertices;

/// Transferred radiance T_p: m rows of 3 channels per vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferredRadiance {
    pub(super) rows: usize,
    /// Numbers per vertex: 3 m, and zeros as padding.
    pub(super) stride: usize,
    pub(super) values: Vec<f32>,
}

impl TransferredRadiance {
    /// Transferred radiance from `rows` rows of 3 channels per vertex, one vertex after another. Panics if `rows` is 0
    /// or does not divide the number of values.
    pub fn new(rows: usize, values: Vec<[f32; 3]>) -> Self {
        assert!(rows > 0 && values.len().is_multiple_of(rows), "{} numbers are no rows of {rows}", values.len());
        Self { rows, stride: 3 * rows, values: values.into_flattened() }
    }

    /// The number m of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// A vertex's rows, 3 channels each. Panics if there is no such vertex.
    pub fn of(&self, vertex: usize) -> &[[f32; 3]] {
        self.values[vertex * self.stride..][..3 * self.rows].as_chunks().0
    }

    /// Number of vertices.
    pub fn vertices(&self) -> usize {
        self.values.len() / self.stride
    }
}

/// Number of executed multiplications over all channels, without skipped zeros.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Multiplies {
    /// Multiplications by light coefficients: step 2 of section 6.
    pub per_cluster: u64,
    /// Multiplications by weights: step 3 of section 6.
    pub per_vertex: u64,
}

/// Rejects too few light coefficients for segments up to `last`, of `per_segment` each.
pub(super) fn check_light(found: usize, per_segment: usize, last: Option<usize>) -> Result<(), InputError> {
    let expected = last.map_or(0, |last| (last + 1) * per_segment);
    ensure!(found >= expected, "crossbar::prt::segments" =>
        "expected at least {expected} light coefficients, {per_segment} per segment, found {found}");
    Ok(())
}

/// G(v) . T_p times the surface's color for every vertex: `color` returns the color of a vertex, `transferred` a row of
/// its T_p. `eye` is in the frame of the mesh. Truncated factors have negative lobes; negative results are kept.
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
