//! Visibility maps: one bit per vertex and fine direction.

use serde::{Deserialize, Serialize};

use crate::transfer::grid::{FINE_DIRECTIONS, FineDirections};

/// The directions in which visibility is sampled, and the horizon.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct VisibilitySampling {
    /// m: 2^m x 2^m directions in each of the light's texels, 0 to 2.
    pub log2_samples: u32,
    /// The horizon that limits a vertex's view.
    pub horizon: Horizon,
}

impl Default for VisibilitySampling {
    /// 4 x 4 directions per texel above the plane of the normal, as in system 5.
    fn default() -> Self {
        Self { log2_samples: 2, horizon: Horizon::Normal }
    }
}

impl VisibilitySampling {
    /// The directions of this sampling. Panics if there are more than 4 x 4 per texel.
    pub fn directions(self) -> &'static FineDirections {
        FineDirections::of(1 << self.log2_samples)
    }

    pub(super) fn words(self) -> usize {
        self.directions().directions().len() / 64
    }
}

/// The horizon that limits the view of a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, strum::Display)]
#[strum(serialize_all = "kebab-case")]
pub enum Horizon {
    /// The plane of its normal, and the triangles around it.
    #[default]
    Normal,
    /// The triangles alone: where the surface curves away from the normal, a vertex sees below the normal's plane.
    Geometry,
}

/// Memory of a vertex's map with 4 x 4 directions per texel, in bytes: 12 KiB. 50,000 vertices take 614 MB.
pub const VISIBILITY_BYTES: usize = FINE_DIRECTIONS / 8;

/// Numbers of directions, and vertices with defects.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VisibilityCounts {
    /// Directions above the horizon of their vertex, without those behind all triangles on which it lies.
    pub above: u64,
    /// Directions in which a ray was cast; the result of all others is certain.
    pub traced: u64,
    /// Directions in which the vertex sees the light.
    pub visible: u64,
    /// Vertices on triangles that face each other so that no ray origin is in front of all of them.
    pub unclear: Vec<u32>,
}

/// The visibility q_p of some vertices: one bit per vertex and fine direction, 1 if the vertex sees the light.
/// Directions below the vertex's horizon are 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VisibilityMaps {
    sampling: VisibilitySampling,
    vertices: Vec<u32>,
    words: Vec<u64>,
    /// Numbers of directions, and vertices with defects.
    pub counts: VisibilityCounts,
}

impl VisibilityMaps {
    /// Maps with all bits 0.
    pub(super) fn dark(vertices: &[u32], sampling: VisibilitySampling) -> Self {
        let counts = VisibilityCounts::default();
        Self { sampling, vertices: vertices.to_vec(), words: vec![0; vertices.len() * sampling.words()], counts }
    }

    /// Creates the maps of vertices 0, 1, 2, ... in the default sampling from all words, map by map. Of the counts,
    /// only the number of visible directions is set. `None` if the last map is incomplete.
    pub fn from_words(words: Vec<u64>) -> Option<Self> {
        let sampling = VisibilitySampling::default();
        if !words.len().is_multiple_of(sampling.words()) {
            return None;
        }
        let vertices = (0..u32::try_from(words.len() / sampling.words()).ok()?).collect();
        let mut maps = Self { sampling, vertices, words, counts: VisibilityCounts::default() };
        maps.count_visible();
        Some(maps)
    }

    /// The sampling of the directions.
    pub fn sampling(&self) -> VisibilitySampling {
        self.sampling
    }

    /// Reduces vertex indices by `first`, which converts indices in two joined meshes to indices in the second.
    /// Panics if a vertex index is lower than `first`.
    #[must_use]
    pub fn counted_from(mut self, first: u32) -> Self {
        let lower = |vertex: &mut u32| *vertex = vertex.checked_sub(first).expect("a vertex of the second mesh");
        self.vertices.iter_mut().chain(&mut self.counts.unclear).for_each(lower);
        self
    }

    /// All words, map by map.
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    /// The vertices of the maps, by index in the mesh.
    pub fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// The number of maps.
    pub fn len(&self) -> usize {
        self.vertices.len()
    }

    /// True if there are no maps.
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// The bits of a map, 64 directions per word, the first in the lowest bit. Maps count from 0, in the order of
    /// [`Self::vertices`]. Panics if there is no such map.
    pub fn bits(&self, map: usize) -> &[u64] {
        let words = self.sampling.words();
        &self.words[map * words..(map + 1) * words]
    }

    /// True if a map's vertex sees the light in a fine direction. Panics if there is no such map or direction.
    pub fn is_visible(&self, map: usize, fine: usize) -> bool {
        let bits = self.bits(map);
        assert!(fine < 64 * bits.len(), "a fine direction, not {fine}");
        bits[fine / 64] >> (fine % 64) & 1 != 0
    }

    pub(super) fn words_mut(&mut self) -> &mut [u64] {
        &mut self.words
    }

    pub(super) fn count_visible(&mut self) {
        self.counts.visible = self.words.iter().map(|word| u64::from(word.count_ones())).sum();
    }
}
