//! The cost of one draw per unit of a card.

use super::{Clocks, Picoseconds};

/// How long one draw keeps each unit busy, were it alone; and how long the draw takes, with all of them at work at
/// once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct DrawCost {
    /// Command processor, vertex units and triangle set-up: before the first fragment, and beside the others after it.
    pub front_end: Picoseconds,
    /// Pixel pipelines: the longest of arithmetic, texture issue and raster back end.
    pub shader: Picoseconds,
    /// Memory: textures that the cache missed, depth, colour, vertices, at the peak rate times its efficiency.
    pub memory: Picoseconds,
    /// From the first clock of the first unit to the last clock of the last: the longest of the above, and the time in
    /// which the pipeline fills and drains.
    pub total: Picoseconds,
    /// [`DrawCost::total`] in clocks of the core.
    pub core_clocks: Clocks,
    /// What the draw waits for most.
    pub bottleneck: Bottleneck,
}

impl DrawCost {
    /// Both, one after the other; bound by what the longer one is bound by.
    #[must_use]
    pub fn and_then(self, next: Self) -> Self {
        Self {
            front_end: self.front_end + next.front_end,
            shader: self.shader + next.shader,
            memory: self.memory + next.memory,
            total: self.total + next.total,
            core_clocks: self.core_clocks + next.core_clocks,
            bottleneck: if next.total > self.total { next.bottleneck } else { self.bottleneck },
        }
    }
}

/// What bounds a draw.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Hash, PartialOrd, Ord, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Bottleneck {
    /// Fixed cost of a draw.
    #[default]
    Overhead,
    /// Vertex units.
    Vertices,
    /// Triangle set-up.
    #[strum(to_string = "set-up")]
    Setup,
    /// Arithmetic of the pixel pipelines.
    Arithmetic,
    /// Texture units.
    Textures,
    /// Raster back end.
    Output,
    /// Memory bandwidth.
    Memory,
    /// A measured rate, in a model that knows nothing else.
    Rate,
}
