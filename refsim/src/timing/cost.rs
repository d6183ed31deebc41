//! Cost of a draw per unit of a card.

use super::{Clocks, Picoseconds};

/// Busy time of each unit for one draw alone, and the duration of the draw with all units in parallel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct DrawCost {
    /// Command processor, vertex units and triangle set-up. This work precedes the first fragment, then overlaps with
    /// the rest of the draw.
    pub front_end: Picoseconds,
    /// Pixel pipelines: the maximum of arithmetic, texture issue and raster back end.
    pub shader: Picoseconds,
    /// Memory traffic: texture cache misses, depth, colour and vertices, at the peak rate times its efficiency.
    pub memory: Picoseconds,
    /// Duration from the first clock of the first unit to the last clock of the last unit: the maximum of front end,
    /// shader and memory, plus the time to fill and drain the pipeline.
    pub total: Picoseconds,
    /// [`DrawCost::total`] in core clocks.
    pub core_clocks: Clocks,
    /// The limiting unit.
    pub bottleneck: Bottleneck,
}

impl DrawCost {
    /// The sum of two costs in sequence, with the bottleneck of the longer cost.
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

/// Limiting factor of a draw.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Hash, PartialOrd, Ord, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Bottleneck {
    /// Fixed cost per draw.
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
    /// A measured rate, in models without individual units.
    Rate,
}
