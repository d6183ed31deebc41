//! The common input of the baselines, and the fixed-view baseline: exit radiance towards a fixed view as a diffuse
//! signal, with one row per vertex and one number per light texel.

use glam::DVec3;
use rayon::prelude::*;

use crate::all_frequency::factor::ProductFunction;
use crate::all_frequency::transfer::FactoredTransfer;
use crate::geom::vector::wide;
use crate::transfer::Vertices;
use crate::transfer::grid::{LIGHT_TEXELS, Segmentation};
use crate::transfer::linear_basis::LinearBasis;
use crate::transfer::visibility::VisibilityMaps;

/// Vertices with their visibility, and a reflectance that is not factored.
#[derive(Clone, Copy)]
pub struct BaselineSubject<'a> {
    /// The mesh.
    pub vertices: &'a Vertices,
    /// Visibility maps of the vertices whose radiance is computed.
    pub maps: &'a VisibilityMaps,
    /// Hat functions of the light's texels.
    pub hats: &'a LinearBasis,
    /// f(v, s) = b(v, s) s_z.
    pub product: &'a dyn ProductFunction,
}

impl std::fmt::Debug for BaselineSubject<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("BaselineSubject").field("maps", &self.maps.len()).finish_non_exhaustive()
    }
}

impl BaselineSubject<'_> {
    /// The direction from a map's vertex to an eye, in its local frame; `None` if it lies below the horizon.
    pub(super) fn view(&self, map: usize, eye: DVec3) -> Option<DVec3> {
        let vertex = self.maps.vertices()[map] as usize;
        let view = (eye - wide(self.vertices.positions()[vertex])).normalize_or_zero();
        Some(self.vertices.frames()[vertex].to_local(view)).filter(|view| view.z > 0.0)
    }
}

/// \[NRH03\]: "glossy objects seen from a fixed view". Rows follow equation 10 with f(v, s) in place of F(s).
#[derive(Clone, Copy, Debug)]
pub struct FixedView<'a>(pub BaselineSubject<'a>);

impl FixedView<'_> {
    /// The row of a map's vertex: for each light texel, the radiance towards a local view under radiance 1 of that
    /// texel. Panics if there is no such map.
    pub fn row(&self, map: usize, view: DVec3) -> Vec<f64> {
        let BaselineSubject { vertices, maps, hats, product } = self.0;
        let response = |light: DVec3, into: &mut [f64]| into[0] = product.value(view, light);
        let transfer = FactoredTransfer { vertices, maps, hats, rows: 1, response: &response };
        let mut row = vec![0.0; LIGHT_TEXELS];
        for segment in 0..Segmentation::Quarters.count() {
            for (place, value) in transfer.raw(segment, map).into_iter().enumerate() {
                row[Segmentation::Quarters.texel(segment, place)] = value;
            }
        }
        row
    }

    /// Radiance of each map's vertex towards an eye under each light. A light is given by the radiances of the
    /// cube's texels; a truncated light is reconstructed first
    /// ([`HaarLight::radiances`](crate::transfer::light::HaarLight::radiances)). The radiance is 0 if the eye is below
    /// the horizon. Panics if a light does not have 6,144 texels.
    pub fn radiance(&self, eye: DVec3, lights: &[&[[f64; 3]]]) -> Vec<Vec<[f64; 3]>> {
        assert!(lights.iter().all(|light| light.len() == LIGHT_TEXELS), "lights of {LIGHT_TEXELS} texels");
        let of_map = |map: usize| {
            let Some(view) = self.0.view(map, eye) else { return vec![[0.0; 3]; lights.len()] };
            let row = self.row(map, view);
            let under = |light: &&[[f64; 3]]| {
                let mut sum = [0.0; 3];
                for (response, radiance) in row.iter().zip(*light) {
                    (0..3).for_each(|channel| sum[channel] += response * radiance[channel]);
                }
                sum
            };
            lights.iter().map(under).collect::<Vec<_>>()
        };
        let by_map: Vec<Vec<[f64; 3]>> = (0..self.0.maps.len()).into_par_iter().map(of_map).collect();
        (0..lights.len()).map(|light| by_map.iter().map(|colors| colors[light]).collect()).collect()
    }
}
