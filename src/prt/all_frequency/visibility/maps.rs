//! The bits.

use crate::prt::all_frequency::grid::FINE_DIRECTIONS;

/// Words of bits per vertex.
pub(super) const WORDS: usize = FINE_DIRECTIONS / 64;
/// Memory of a vertex's map in bytes: 12 KiB. 50,000 vertices take 614 MB.
pub const VISIBILITY_BYTES: usize = FINE_DIRECTIONS / 8;

/// Numbers of directions, and vertices that something is wrong with.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VisibilityCounts {
    /// Directions above the horizon of their vertex's normal.
    pub above: u64,
    /// Of these, those that run into all triangles that the vertex lies on.
    pub below_triangles: u64,
    /// Those that a ray was cast for; the others certainly meet nothing. 0 of maps that were drawn.
    pub traced: u64,
    /// Those in which the vertex sees the light.
    pub visible: u64,
    /// Vertices on triangles that face each other so that no origin of rays is in front of all of them.
    pub unclear: Vec<u32>,
}

/// The visibility q_p of some vertices: a bit per vertex and fine direction, 1 where it sees the light. Directions that
/// are not above the horizon of the vertex's normal are 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VisibilityMaps {
    vertices: Vec<u32>,
    words: Vec<u64>,
    /// How many directions, and what is wrong.
    pub counts: VisibilityCounts,
}

impl VisibilityMaps {
    /// All bits 0.
    pub(super) fn dark(vertices: &[u32]) -> Self {
        let counts = VisibilityCounts::default();
        Self { vertices: vertices.to_vec(), words: vec![0; vertices.len() * WORDS], counts }
    }

    /// The maps of vertices 0, 1, 2 and so on, from all words, map by map; nothing is known of how they came about but
    /// the number of bits. `None` if the last map is incomplete.
    pub fn from_words(words: Vec<u64>) -> Option<Self> {
        if !words.len().is_multiple_of(WORDS) {
            return None;
        }
        let vertices = (0..u32::try_from(words.len() / WORDS).ok()?).collect();
        let mut maps = Self { vertices, words, counts: VisibilityCounts::default() };
        maps.count_visible();
        Some(maps)
    }

    /// The same maps of vertices whose numbers are less by `first`: those of the second of two joined meshes, by their
    /// numbers in it.
    ///
    /// # Panics
    /// If a vertex has a lower number.
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

    /// The vertices that the maps are of, by their number in the mesh.
    pub fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// The number of maps.
    pub fn len(&self) -> usize {
        self.vertices.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// The bits of a map, 64 directions per word, the first in the lowest bit. Maps count from 0, in the order of
    /// [`Self::vertices`].
    ///
    /// # Panics
    /// If there is no such map.
    pub fn bits(&self, map: usize) -> &[u64] {
        &self.words[map * WORDS..(map + 1) * WORDS]
    }

    /// Whether a map's vertex sees the light in a fine direction.
    ///
    /// # Panics
    /// If there is no such map or direction.
    pub fn is_visible(&self, map: usize, fine: usize) -> bool {
        assert!(fine < FINE_DIRECTIONS, "a fine direction, not {fine}");
        self.bits(map)[fine / 64] >> (fine % 64) & 1 != 0
    }

    pub(super) fn words_mut(&mut self) -> &mut [u64] {
        &mut self.words
    }

    /// Counts the bits that are set.
    pub(super) fn count_visible(&mut self) {
        self.counts.visible = self.words.iter().map(|word| u64::from(word.count_ones())).sum();
    }
}
