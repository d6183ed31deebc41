//! Layouts of blocks and of local light, and the programs that read them.

use std::collections::BTreeSet;

use crossbar_systems::bi_scale::kernels::{BlockEdges, BlockGrid, DisplayKernel, ListSumKernel, LocalLayout, programs};
use refsim::isa::Version;

use crate::card::{WrittenKernel, checked};
use crate::device;

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

#[test]
fn every_number_has_a_place_of_its_own() {
    for sets in 3..=16 {
        let layout = LocalLayout { sets };
        let beside = [(0, 3), (layout.last(), 0), (layout.last(), 1), (layout.last(), 2), (layout.last(), 3)];
        let of = (0..layout.directions()).flat_map(|d| (0..3).map(move |channel| layout.place(d, channel)));
        let places: BTreeSet<_> = of.chain(beside).collect();
        assert_eq!(places.len(), 3 * layout.directions() + 5, "{sets} sets");
        assert!(places.iter().all(|&(set, component)| set < sets && component < 4));
        assert!(4 * sets - places.len() < 3, "{sets} sets: room for one more");
    }
}

/// Eight sets in ps_2_x, fifteen in shader model 4: Direct3D 10 has 16 outputs of a vertex program, one for the
/// position, and Mesa's driver for these cards (nv50_screen.c) gives fragment programs 15 inputs.
#[test]
fn passes_for_the_papers_directions() {
    let passes = |sets, directions| LocalLayout { sets }.passes(directions);
    assert_eq!([8, 15, 16].map(|sets| LocalLayout { sets }.directions()), [9, 18, 19]);
    assert_eq!([64, 144].map(|directions| passes(8, directions)), [8, 16]);
    assert_eq!([64, 144].map(|directions| passes(15, directions)), [4, 8]);
    assert_eq!([64, 144].map(|directions| passes(16, directions)), [4, 8]);
}

/// Programs have the maximum number of list texels within 512 instructions.
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

/// The display needs volume textures, but only instructions that ps_2_0 has.
#[test]
fn nine_directions_take_a_third_of_a_program() {
    let grid = BlockGrid { size: 64, lights: 8, views: 12, edges: BlockEdges::Wrapped };
    let kernel = DisplayKernel { layout: LocalLayout { sets: 8 }, grid, directions: 9, version: Version::Ps2B };
    let slots = kernel.checked(&device("gt200")).unwrap_or_else(|e| panic!("{e}")).facts().slots[0];
    assert_eq!(slots.texture, 36);
    assert!((130..=160).contains(&slots.arithmetic), "{}", slots.arithmetic);
    assert!(kernel.text().contains("dcl_volume s0"));
}

#[test]
fn every_program_runs_on_the_geforce_gtx_280() {
    for (name, text) in programs().into_iter().filter(|(_, text)| !text.starts_with("ps_2_a")) {
        for profile in ["gt200", "ideal-fp32"].map(device) {
            checked(&profile, name.clone(), &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        }
    }
}
