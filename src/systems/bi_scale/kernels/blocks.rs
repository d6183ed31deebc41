//! A bidirectional texture in a volume (Figure 4): a layer for each view, and in it a block of texels for each
//! direction of light, the blocks in rows as the directions lie in their square.

/// How the blocks of a layer meet.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::Display, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum BlockEdges {
    /// Blocks touch, as in Figure 4: the patch has a seam one texel wide.
    ///
    /// Reads stay half a texel inside, so that nothing is interpolated between the last texel's center and the first
    /// one's of the next repetition.
    Touching,
    /// A texel around each block repeats the opposite edge, so that the patch repeats without a seam.
    #[default]
    Wrapped,
}

/// The places of blocks in a volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BlockGrid {
    /// Texels along an edge of the patch.
    pub size: usize,
    /// Directions of light along an edge of their square.
    pub lights: usize,
    /// Directions of the view along an edge of theirs.
    pub views: usize,
    /// How blocks meet.
    pub edges: BlockEdges,
}

impl BlockGrid {
    /// Texels around a block.
    pub const fn border(&self) -> usize {
        match self.edges {
            BlockEdges::Touching => 0,
            BlockEdges::Wrapped => 1,
        }
    }

    /// Texels from block to block.
    pub const fn pitch(&self) -> usize {
        self.size + 2 * self.border()
    }

    /// Width, height and depth of the volume.
    pub const fn extents(&self) -> [usize; 3] {
        let side = self.pitch() * self.lights;
        [side, side, self.views * self.views]
    }

    /// The first texel of a direction's block, with what is around it: column and row.
    pub const fn origin(&self, light: usize) -> [usize; 2] {
        [self.pitch() * (light % self.lights), self.pitch() * (light / self.lights)]
    }

    /// What a texel of a layer shows: the direction of light, and row and column of the patch.
    pub const fn shown(&self, column: usize, row: usize) -> (usize, [usize; 2]) {
        let pitch = self.pitch();
        let light = self.lights * (row / pitch) + column / pitch;
        // A texel of the border is that of the opposite edge.
        let back = self.size - self.border();
        (light, [(row % pitch + back) % self.size, (column % pitch + back) % self.size])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_show_the_opposite_edge() {
        let grid = BlockGrid { size: 4, lights: 3, views: 2, edges: BlockEdges::Wrapped };
        assert_eq!(grid.extents(), [18, 18, 4]);
        let [x, y] = grid.origin(5);
        assert_eq!([x, y], [12, 6]);
        let columns: Vec<usize> = (0..6).map(|column| grid.shown(x + column, y + 2).1[1]).collect();
        assert_eq!(columns, [3, 0, 1, 2, 3, 0]);
        assert_eq!(grid.shown(x, y), (5, [3, 3]));
        assert_eq!(grid.shown(x + 5, y + 5), (5, [0, 0]));
        let touching = BlockGrid { edges: BlockEdges::Touching, ..grid };
        assert_eq!(touching.extents(), [12, 12, 4]);
        assert_eq!(touching.shown(11, 4), (5, [0, 3]));
    }
}
