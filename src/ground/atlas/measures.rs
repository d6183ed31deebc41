//! Per-face data from which the splits of clusters are optimised.

use std::ops::RangeInclusive;

use glam::DVec3;

use super::surface::AtlasSurface;

/// Allowed number of faces in the first half of a cluster.
pub(super) type SplitLimits = RangeInclusive<usize>;

#[derive(Debug)]
pub(super) struct FaceMeasures {
    pub(super) centers: Vec<DVec3>,
    /// Normal of each face, with twice the face's area as length.
    pub(super) normals: Vec<DVec3>,
    /// Target number of texels of each face: its area divided by the mean texel area, but at least [`LEAST_DEMAND`].
    pub(super) demands: Vec<f64>,
}

impl FaceMeasures {
    /// Computes the measures of faces that share `texels`.
    pub(super) fn new(surface: &AtlasSurface, texels: f64) -> Self {
        let mean = surface.areas().iter().sum::<f64>() / texels;
        let demand = |area: &f64| if mean > 0.0 { (area / mean).max(LEAST_DEMAND) } else { 1.0 };
        Self {
            centers: (0..surface.len() as u32).map(|face| surface.centroid(face)).collect(),
            normals: (0..surface.len() as u32).map(|face| surface.area_vector(face)).collect(),
            demands: surface.areas().iter().map(demand).collect(),
        }
    }
}

const LEAST_DEMAND: f64 = 1.0;
