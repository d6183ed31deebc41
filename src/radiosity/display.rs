//! Radiosities where pictures are drawn from them: at the corners of patches, for smooth shading.

use std::collections::BTreeMap;

use super::Patches;
use crate::geom::vector::{Vec3, dot};

/// Patches whose normals are farther apart than this (a cosine) do not share their corners: about 26 degrees.
const CREASE: f64 = 0.9;

/// The radiosity at each corner of each patch: the mean over the patches of one material that meet there and are not across an edge
/// (Cohen and Greenberg, 1985, without their extrapolation at the border). A radiosity that is the same everywhere stays the same.
///
/// # Panics
/// If there is not one radiosity a patch.
#[must_use]
pub fn at_corners(patches: &Patches, radiosity: &[[f64; 3]]) -> Vec<Vec<[f64; 3]>> {
    assert_eq!(patches.list().len(), radiosity.len(), "one radiosity a patch");
    let mut meeting: BTreeMap<[u32; 3], Vec<usize>> = BTreeMap::new();
    for (i, patch) in patches.list().iter().enumerate() {
        for &corner in patch.corners() {
            meeting.entry(place(corner)).or_default().push(i);
        }
    }
    let mean = |i: usize, corner: Vec3| {
        let patch = &patches.list()[i];
        let smooth = |&&j: &&usize| {
            let other = &patches.list()[j];
            other.material == patch.material && dot(other.normal(), patch.normal()) >= CREASE
        };
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for &j in meeting[&place(corner)].iter().filter(smooth) {
            sum = [0, 1, 2].map(|c| sum[c] + radiosity[j][c]);
            count += 1.0;
        }
        sum.map(|value: f64| value / count)
    };
    patches
        .list()
        .iter()
        .enumerate()
        .map(|(i, p)| p.corners().iter().map(|&corner| mean(i, corner)).collect())
        .collect()
}

/// Corners of neighbours agree in f32; both zeros are one place.
fn place(corner: Vec3) -> [u32; 3] {
    corner.map(|x| (x as f32 + 0.0).to_bits())
}
