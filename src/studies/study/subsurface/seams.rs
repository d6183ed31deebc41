//! Seams: jumps of B between neighbouring texels that B over all pairs does not have.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::atlas::Atlas;

/// Greatest distance of neighbours, in sides of a square of the mean area of texels: those across a corner are 1.41 apart.
const REACH: f64 = 1.5;
/// Least cosine between normals of neighbours, which excludes the far side of thin parts.
const SAME_SIDE: f64 = 0.7;

/// Pairs of texels that are neighbours on the surface.
#[derive(Debug)]
pub(super) struct Neighbours(Vec<[usize; 2]>);

impl Neighbours {
    /// All pairs of an atlas, by distance.
    pub(super) fn of(atlas: &Atlas) -> Self {
        let reach = REACH * atlas.mean_texel_area().sqrt();
        let texels = atlas.texels();
        let cell = |at: DVec3| (at / reach).to_array().map(|x| x.floor() as i64);
        let mut cells: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
        for (at, texel) in texels.iter().enumerate().filter(|(_, texel)| texel.area > 0.0) {
            cells.entry(cell(texel.point)).or_default().push(at);
        }
        let mut pairs = Vec::new();
        for (&[x, y, z], ones) in &cells {
            let beside = (0..27).filter_map(|i| cells.get(&[x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1]));
            for &other in beside.flatten() {
                let near = |one: &usize| {
                    let (a, b) = (&texels[*one], &texels[other]);
                    *one < other && a.point.distance(b.point) <= reach && a.normal.dot(b.normal) >= SAME_SIDE
                };
                pairs.extend(ones.iter().copied().filter(near).map(|one| [one, other]));
            }
        }
        Self(pairs)
    }

    /// Root mean square of the jumps of `found` less those of `expected`, over the root mean square of `expected`; both by
    /// area, over all channels.
    pub(super) fn seams(&self, atlas: &Atlas, found: &[[f64; 3]], expected: &[[f64; 3]]) -> f64 {
        let off = |texel: usize| DVec3::from(found[texel]) - DVec3::from(expected[texel]);
        let area = |texel: usize| atlas.texels()[texel].area;
        let mean = |squares: &mut dyn Iterator<Item = (f64, f64)>| {
            let (sum, areas) =
                squares.fold((0.0, 0.0), |(sum, areas), (square, area)| (sum + area * square, areas + area));
            if areas > 0.0 { sum / areas } else { 0.0 }
        };
        let jumps = mean(&mut self.0.iter().map(|&[a, b]| ((off(a) - off(b)).length_squared(), area(a) + area(b))));
        let whole =
            mean(&mut (0..expected.len()).map(|texel| (DVec3::from(expected[texel]).length_squared(), area(texel))));
        if whole > 0.0 { (jumps / whole).sqrt() } else { 0.0 }
    }
}
