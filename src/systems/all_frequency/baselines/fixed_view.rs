//! Exit radiance towards a fixed view as a diffuse signal: a row of numbers per vertex, one for each light texel.

use glam::DVec3;
use rayon::prelude::*;

use super::BaselineSubject;
use crate::all_frequency::transfer::FactoredTransfer;
use crate::transfer::grid::{LIGHT_TEXELS, Segmentation};

/// \[NRH03\]: "glossy objects seen from a fixed view". Rows are those of equation 10 with f(v, s) in place of F(s).
#[derive(Clone, Copy, Debug)]
pub struct FixedView<'a>(pub BaselineSubject<'a>);

impl FixedView<'_> {
    /// The row of a map's vertex: the contribution of each light texel of radiance 1 to its radiance towards a local
    /// view.
    ///
    /// # Panics
    /// If there is no such map.
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

    /// Radiance of each map's vertex towards an eye under each of some lights, which are radiances of the cube's
    /// texels: truncated ones as they are put together from the coefficients that are kept
    /// ([`HaarLight::radiances`](crate::transfer::light::HaarLight::radiances)). 0 from below.
    ///
    /// # Panics
    /// If a light does not have 6,144 texels.
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
