//! A bidirectional texture as a volume (Figure 4): one layer per view. A layer has one block of texels per direction of
//! light; blocks are arranged like the directions in their square.

/// Borders between the blocks of a layer.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum BlockEdges {
    /// Blocks touch, as in Figure 4: the patch has a seam one texel wide.
    ///
    /// Reads stay half a texel inside, so nothing is interpolated between the center of the last texel and the first
    /// center of the next repetition.
    Touching,
    /// A border of one texel around each block repeats the opposite edge, so that the patch repeats without a seam.
    #[default]
    Wrapped,
}

/// The layout of blocks in a volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BlockGrid {
    /// Texels along an edge of the patch.
    pub size: usize,
    /// Directions of light along an edge of the square of directions.
    pub lights: usize,
    /// Views along an edge of the square of directions.
    pub views: usize,
    /// Borders between blocks.
    pub edges: BlockEdges,
}

impl BlockGrid {
    /// Width of the border around a block, in texels.
    pub const fn border(&self) -> usize {
        match self.edges {
            BlockEdges::Touching => 0,
            BlockEdges::Wrapped => 1,
        }
    }

    /// Distance from block to block, in texels.
    pub const fn pitch(&self) -> usize {
        self.size + 2 * self.border()
    }

    /// Width, height and depth of the volume, in texels.
    pub const fn extents(&self) -> [usize; 3] {
        let side = self.pitch() * self.lights;
        [side, side, self.views * self.views]
    }

    /// Column and row of the first texel of a direction's block, including its border.
    pub const fn origin(&self, light: usize) -> [usize; 2] {
        [self.pitch() * (light % self.lights), self.pitch() * (light / self.lights)]
    }

    /// Maps a texel of a layer to a direction of light, and to the row and column of the patch.
    pub const fn shown(&self, column: usize, row: usize) -> (usize, [usize; 2]) {
        let pitch = self.pitch();
        let light = self.lights * (row / pitch) + column / pitch;
        // A texel of the border repeats the opposite edge.
        let back = self.size - self.border();
        (light, [(row % pitch + back) % self.size, (column % pitch + back) % self.size])
    }
}
