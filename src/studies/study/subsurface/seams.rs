//! Seams: roughness of B between neighboring texels, in addition to the roughness of B over all pairs.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3};

use crate::atlas::Atlas;

/// Maximum distance of neighbors, in sides of a square with the mean area of texels; across a corner it is 1.41.
const REACH: f64 = 1.5;
/// Minimum cosine between normals of neighbors, which excludes the far side of thin parts.
const SAME_SIDE: f64 = 0.7;

/// The neighbors of each texel on the surface, including itself; empty for a texel without area.
#[derive(Debug)]
pub(super) struct Neighbours(Vec<Vec<usize>>);

impl Neighbours {
    pub(super) fn of(atlas: &Atlas) -> Self {
        let reach = REACH * atlas.mean_texel_area().sqrt();
        let texels = atlas.texels();
        let cell = |at: DVec3| (at / reach).to_array().map(|x| x.floor() as i64);
        let mut cells: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
        for (at, texel) in texels.iter().enumerate().filter(|(_, texel)| texel.area > 0.0) {
            cells.entry(cell(texel.point)).or_default().push(at);
        }
        let mut found = vec![Vec::new(); texels.len()];
        for (&[x, y, z], ones) in &cells {
            let beside = (0..27).filter_map(|i| cells.get(&[x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1]));
            let beside: Vec<usize> = beside.flatten().copied().collect();
            for &one in ones {
                let near = |&other: &usize| {
                    let (a, b) = (&texels[one], &texels[other]);
                    a.point.distance(b.point) <= reach && a.normal.dot(b.normal) >= SAME_SIDE
                };
                found[one].extend(beside.iter().copied().filter(near));
            }
        }
        Self(found)
    }

    /// RMS over all texels of the deviation of `found` minus `expected` from a linear function over a texel's
    /// neighbors, relative to the RMS of `expected`; weighted by area, over all channels. A smooth error counts little,
    /// a jump fully.
    pub(super) fn seams(&self, atlas: &Atlas, found: &[[f64; 3]], expected: &[[f64; 3]]) -> f64 {
        let off = |texel: usize| DVec3::from(found[texel]) - DVec3::from(expected[texel]);
        let (mut rough, mut whole) = (0.0, 0.0);
        for ((texel, near), expected) in atlas.texels().iter().zip(&self.0).zip(expected) {
            whole += texel.area * DVec3::from(*expected).length_squared();
            let values = near.iter().map(|&at| (atlas.texels()[at].point, off(at)));
            rough += texel.area * from_linear(&values.collect::<Vec<_>>(), texel.normal);
        }
        if whole > 0.0 { (rough / whole).sqrt() } else { 0.0 }
    }
}

/// Mean squared deviation of values near a plane from their best linear function; 0 for too few points.
fn from_linear(values: &[(DVec3, DVec3)], normal: DVec3) -> f64 {
    if values.len() < 4 {
        return 0.0;
    }
    let share = 1.0 / values.len() as f64;
    let middle = share * values.iter().map(|value| value.0).sum::<DVec3>();
    let mean = share * values.iter().map(|value| value.1).sum::<DVec3>();
    let outer = |a: DVec3, b: DVec3| DMat3::from_cols(a * b.x, a * b.y, a * b.z);
    let (mut spread, mut mixed) = (DMat3::ZERO, DMat3::ZERO);
    for (at, value) in values {
        spread += outer(at - middle, at - middle);
        mixed += outer(value - mean, at - middle);
    }
    // Points hardly leave the plane, so the slope along its normal is set to zero.
    let trace = spread.x_axis.x + spread.y_axis.y + spread.z_axis.z;
    let slope = mixed * (spread + outer(normal, normal) * trace).inverse();
    share * values.iter().map(|(at, value)| (value - mean - slope * (at - middle)).length_squared()).sum::<f64>()
}
