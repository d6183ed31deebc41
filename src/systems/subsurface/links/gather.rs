//! Pass 2 on the host, in f64: radiosity as the sum over links of factor times mean irradiance.

use rayon::prelude::*;

use super::super::multipole::{ClusterId, SurfaceMoments, check_values, from_morton, to_morton};
use super::Links;
use crate::error::InputError;

/// The weights of texels in the mean irradiance of a cluster.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MeanWeighting {
    /// By their areas: if a texel has a link to every texel, the sum is equation 9.
    #[default]
    Area,
    /// Equal weights, as in mipmaps of the irradiance.
    Count,
}

/// The mean irradiance, in three channels, of every cluster of an atlas.
#[derive(Clone, Debug, PartialEq)]
pub struct IrradianceMeans {
    side: u32,
    /// Means level by level, in Morton order.
    levels: Vec<Vec<[f64; 3]>>,
}

impl IrradianceMeans {
    /// The means of the irradiances of all texels, row by row.
    pub fn new(
        surface: &SurfaceMoments,
        irradiances: &[[f64; 3]],
        weighting: MeanWeighting,
    ) -> Result<Self, InputError> {
        let side = surface.side();
        let texels = side as usize * side as usize;
        check_values(irradiances.len(), texels)?;
        let of_texel = |(x, y): (u32, u32)| irradiances[y as usize * side as usize + x as usize];
        let mut levels: Vec<Vec<[f64; 3]>> = vec![(0..texels).map(|k| of_texel(from_morton(k))).collect()];
        for level in 1..surface.level_count() {
            let of_four = |(k, four): (usize, &[[f64; 3]])| {
                let (area, mut sum) = (surface.area_at(level, k), [0.0; 3]);
                for (child, value) in (4 * k..).zip(four) {
                    let weight = match weighting {
                        MeanWeighting::Area if area > 0.0 => surface.area_at(level - 1, child) / area,
                        _ => 0.25,
                    };
                    sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += weight * value);
                }
                sum
            };
            let means = levels[level as usize - 1].par_chunks_exact(4).enumerate().map(of_four).collect();
            levels.push(means);
        }
        Ok(Self { side, levels })
    }

    /// The mean irradiance of a cluster. Panics if there is no such cluster.
    pub fn of(&self, ClusterId { level, y, x }: ClusterId) -> [f64; 3] {
        self.levels[level as usize][to_morton(x, y)]
    }
}

impl Links {
    /// The radiosity of every texel, row by row: the sum over the texel's links of factor times mean irradiance. A
    /// scalar factor applies to all three channels. Panics if the means belong to an atlas of another size.
    pub fn gather(&self, means: &IrradianceMeans) -> Vec<[f64; 3]> {
        assert_eq!(self.side, means.side, "links and irradiance are of one atlas");
        let side = self.side as usize;
        let texel = |k: usize| {
            let mut sum = [0.0; 3];
            for (cluster, factors) in self.of([(k % side) as u32, (k / side) as u32]) {
                let mean = means.of(cluster);
                for (channel, sum) in sum.iter_mut().enumerate() {
                    *sum += f64::from(factors[channel % factors.len()]) * mean[channel];
                }
            }
            sum
        };
        (0..side * side).into_par_iter().map(texel).collect()
    }
}
