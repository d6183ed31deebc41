//! Radiosities at the corners of patches, for smooth shading.

use std::collections::{BTreeMap, BTreeSet};

use crate::geom::vector::{narrow, place_bits};
use crate::radiosity::Patches;
use glam::DVec3;

/// Cosine of the largest angle between normals of patches that share corners: about 26 degrees.
const CREASE: f64 = 0.9;

/// Sets of patches whose mean is the radiosity of a corner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct CornerSets {
    /// Each distinct set of patches, in ascending order, never empty.
    pub(super) sets: Vec<Vec<u32>>,
    /// Index of the set of each corner of each patch; a triangle's fourth index is 0.
    pub(super) of: Vec<[u32; 4]>,
}

impl CornerSets {
    /// Collects, at each corner of each patch, the uncovered patches that meet there smoothly, of the same material.
    pub(super) fn new(patches: &Patches) -> Self {
        let list = patches.list();
        let mut meeting: BTreeMap<[u32; 3], Vec<u32>> = BTreeMap::new();
        for (i, patch) in (0..).zip(list) {
            for &corner in patch.corners() {
                meeting.entry(place(corner)).or_default().push(i);
            }
        }
        let covered: Vec<bool> = (0..list.len()).map(|i| patches.open_parts(i).is_empty()).collect();
        let (mut sets, mut places) = (Vec::new(), BTreeMap::new());
        let mut of = vec![[0; 4]; list.len()];
        for (patch, of) in list.iter().zip(&mut of) {
            let smooth = |&j: &u32| {
                let other = &list[j as usize];
                other.material == patch.material && other.normal().dot(patch.normal()) >= CREASE
            };
            for (&corner, of) in patch.corners().iter().zip(of) {
                let mut set: Vec<u32> = meeting[&place(corner)].iter().copied().filter(smooth).collect();
                // Fully covered patches are dark and invisible: they count only where all patches are covered.
                if set.iter().any(|&j| !covered[j as usize]) {
                    set.retain(|&j| !covered[j as usize]);
                }
                *of = *places.entry(set).or_insert_with_key(|set| {
                    sets.push(set.clone());
                    sets.len() as u32 - 1
                });
            }
        }
        Self { sets, of }
    }
}

/// Vertex of the smooth display: a position where corners of patches of the same smooth surface meet. Several vertices
/// share a position if surfaces of different materials, or both sides of a sharp edge, meet there.
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothVertex {
    /// Position.
    pub at: DVec3,
    /// Patches whose mean is the vertex's radiosity, in ascending order.
    pub patches: Vec<u32>,
}

impl SmoothVertex {
    /// Returns the vertices of a scene, in the order of the patches and their corners.
    pub fn all(patches: &Patches) -> Vec<Self> {
        let CornerSets { sets, of } = CornerSets::new(patches);
        let corners = patches.list().iter().zip(of);
        let corners = corners.flat_map(|(patch, of)| patch.corners().iter().copied().zip(of));
        let mut seen = BTreeSet::new();
        let first = corners.filter(|&(at, set)| seen.insert((place(at), set)));
        first.map(|(at, set)| Self { at, patches: sets[set as usize].clone() }).collect()
    }

    /// The vertex's radiosity. Panics if the radiosity of one of its patches is missing.
    pub fn mean(&self, radiosity: &[[f64; 3]]) -> [f64; 3] {
        mean(&self.patches, radiosity)
    }
}

fn mean(set: &[u32], radiosity: &[[f64; 3]]) -> [f64; 3] {
    let add = |sum: [f64; 3], &j: &u32| [0, 1, 2].map(|c| sum[c] + radiosity[j as usize][c]);
    set.iter().fold([0.0; 3], add).map(|sum| sum / set.len() as f64)
}

/// Computes the radiosity at each corner of each patch: the mean over the patches of the same material that meet there
/// without a sharp edge (Cohen and Greenberg, 1985, without their extrapolation at the border). Covered patches are
/// ignored. Constant radiosity stays constant. Panics if there is not one radiosity per patch.
pub fn at_corners(patches: &Patches, radiosity: &[[f64; 3]]) -> Vec<Vec<[f64; 3]>> {
    assert_eq!(patches.list().len(), radiosity.len(), "one radiosity per patch");
    let CornerSets { sets, of } = CornerSets::new(patches);
    let means: Vec<[f64; 3]> = sets.iter().map(|set| mean(set, radiosity)).collect();
    let corners = patches.list().iter().map(|patch| patch.corners().len());
    corners.zip(&of).map(|(count, of)| of[..count].iter().map(|&set| means[set as usize]).collect()).collect()
}

/// Key of a corner: its f32 bits, which neighbours share, with -0 as +0.
pub(super) fn place(corner: DVec3) -> [u32; 3] {
    place_bits(narrow(corner))
}
