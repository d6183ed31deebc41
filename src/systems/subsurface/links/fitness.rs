//! Texels compared with the lengths of a medium: figures for the warnings of a study.

use super::super::Dipole;
use super::super::factor::{ClusterId, SurfaceMoments};

/// Texels of a surface compared with the lengths of a dipole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitness {
    /// The side of the mean texel (the root of its area) over the mean free path. Above 1, factors within a texel's
    /// neighborhood matter, and the light cannot vary within a texel as it does in the medium.
    pub texel_per_mean_free_path: f64,
    /// The side of the largest texel over the mean free path.
    pub largest_texel_per_mean_free_path: f64,
    /// The fraction of the surface under texels whose side exceeds the mean free path.
    pub coarse_fraction: f64,
}

impl Fitness {
    /// Compares a surface with a dipole.
    pub fn new(surface: &SurfaceMoments, dipole: &Dipole) -> Self {
        let side = surface.side();
        let path = dipole.mean_free_path();
        let (mut largest, mut coarse): (f64, f64) = (0.0, 0.0);
        for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
            let area = surface.cluster_area(ClusterId { level: 0, y, x });
            largest = largest.max(area);
            coarse += if area.sqrt() > path { area } else { 0.0 };
        }
        let mean = surface.area() / (f64::from(side) * f64::from(side));
        Self {
            texel_per_mean_free_path: mean.sqrt() / path,
            largest_texel_per_mean_free_path: largest.sqrt() / path,
            coarse_fraction: coarse / surface.area(),
        }
    }

    /// Returns `true` if some texels exceed the mean free path.
    pub fn has_coarse_texels(&self) -> bool {
        self.largest_texel_per_mean_free_path > 1.0
    }
}
