//! The programs of bi-scale transfer on a card, generated because they depend on the number of reads: sums over lists
//! (section V, Algorithm 2), and the product of a bidirectional texture with local light (equation 3).

mod blocks;
mod display;
mod layout;
mod list_sum;

pub use blocks::{BlockEdges, BlockGrid};
pub use display::{DisplayKernel, FIRST_ORIGIN};
pub use layout::{LocalLayout, LocalVertexKernel};
pub use list_sum::{LISTS, ListSumKernel, SOURCE, SUM};

use refsim::isa::Version;

use crate::card::WrittenKernel;

/// Programs by name, for some numbers of reads and of directions.
pub fn programs() -> Vec<(String, String)> {
    let mut all = Vec::new();
    for (texels, is_weighted) in [(1, true), (3, true), (50, true), (1, false), (7, false), (36, false)] {
        for is_first in [true, false] {
            let kernel = ListSumKernel { texels, is_weighted, is_first, version: Version::Ps2B };
            all.push(kernel.listed());
        }
    }
    let layout = LocalLayout { sets: 8 };
    for (edges, directions) in [(BlockEdges::Touching, 9), (BlockEdges::Wrapped, 9), (BlockEdges::Wrapped, 1)] {
        for version in [Version::Ps2A, Version::Ps2B] {
            let grid = BlockGrid { size: 16, lights: 3, views: 4, edges };
            let kernel = DisplayKernel { layout, grid, directions, version };
            all.push(kernel.listed());
        }
    }
    for version in [Version::Vs1_1, Version::Vs2_0] {
        let kernel = LocalVertexKernel { layout, version };
        all.push(kernel.listed());
    }
    all
}
