//! The programs of bi-scale transfer on a card, written here because the number of reads decides: sums over lists
//! (section V, Algorithm 2), and the product of a bidirectional texture with local light (equation 3).

mod blocks;
mod display;
mod layout;
mod list_sum;
mod vertex;

pub use blocks::{BlockEdges, BlockGrid};
pub use display::{DisplayKernel, FIRST_ORIGIN};
pub use layout::LocalLayout;
pub use list_sum::{LISTS, ListSumKernel, SOURCE, SUM};
pub use vertex::LocalVertexKernel;

use refsim::isa::Version;

use crate::card::WrittenKernel;

/// Every program that there is, by name, for a few numbers of reads and of directions.
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

#[cfg(test)]
mod tests {
    use super::*;
    use refsim::device::Profile;

    fn device(name: &str) -> Profile {
        Profile::named(name).expect("a device")
    }

    #[test]
    fn every_program_runs_on_the_geforce_gtx_280() {
        for (name, text) in programs().into_iter().filter(|(_, text)| !text.starts_with("ps_2_a")) {
            for profile in ["gt200", "ideal-fp32"].map(device) {
                crate::card::checked(&profile, name.clone(), &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
            }
        }
    }

    /// As many texels of lists as 512 instructions hold, and no more.
    #[test]
    fn lists_fill_a_program() {
        for is_weighted in [true, false] {
            let kernel = |texels| ListSumKernel { texels, is_weighted, is_first: false, version: Version::Ps2B };
            let most = ListSumKernel::most_texels(is_weighted, 512);
            let facts = |texels| kernel(texels).checked(&device("gt200")).map(|program| program.facts().slots[0]);
            let slots = facts(most).unwrap_or_else(|e| panic!("{e}"));
            assert!((500..=512).contains(&(slots.texture + slots.arithmetic)), "{slots:?}");
            assert!(facts(most + 1).is_err(), "{} texels", most + 1);
        }
    }

    /// The display needs volume textures, but no instruction beyond those of ps_2_0.
    #[test]
    fn nine_directions_take_a_third_of_a_program() {
        let grid = BlockGrid { size: 64, lights: 8, views: 12, edges: BlockEdges::Wrapped };
        let kernel = DisplayKernel { layout: LocalLayout { sets: 8 }, grid, directions: 9, version: Version::Ps2B };
        let slots = kernel.checked(&device("gt200")).unwrap_or_else(|e| panic!("{e}")).facts().slots[0];
        assert_eq!(slots.texture, 36);
        assert!((130..=160).contains(&slots.arithmetic), "{}", slots.arithmetic);
        assert!(kernel.text().contains("dcl_volume s0"));
    }
}
