//! Laws of the tree of clusters.

use crossbar::atlas::{Atlas, AtlasQuality};
use proptest::prelude::*;

use super::meshes::{atlases, least_side, ring, round};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    /// A tree over T faces has 2 T - 1 nodes; children partition the faces and the rectangle of their parent; every
    /// leaf has one face, and no node has more faces than texels.
    #[test]
    fn nodes_are_halves_of_their_parents((sample, side) in atlases()) {
        let atlas = Atlas::new(&sample.mesh, side).expect("an atlas");
        let tree = atlas.tree();
        let faces = sample.mesh.len();
        prop_assert_eq!(tree.nodes().len(), 2 * faces - 1);
        let root = tree.nodes()[0];
        prop_assert_eq!((root.first, root.faces as usize), (0, faces));
        prop_assert_eq!([root.x, root.y, root.width, root.height], [0, 0, side, side]);
        let mut order = tree.order().to_vec();
        order.sort_unstable();
        prop_assert!(order.into_iter().eq(0..faces as u32), "every face once");
        for (at, node) in tree.nodes().iter().enumerate() {
            prop_assert!(node.faces >= 1 && node.faces <= node.width * node.height);
            prop_assert!(node.height == node.width || node.height == 2 * node.width);
            let Some(children) = tree.children(at) else {
                prop_assert_eq!(node.faces, 1);
                continue;
            };
            let [one, other] = children.map(|child| tree.nodes()[child]);
            prop_assert_eq!((one.first, other.first), (node.first, node.first + one.faces));
            prop_assert_eq!(one.faces + other.faces, node.faces);
            prop_assert_eq!(2 * one.width * one.height, node.width * node.height);
            prop_assert_eq!([one.width, one.height], [other.width, other.height]);
            let moved = if node.width == node.height { [one.width, 0] } else { [0, one.height] };
            prop_assert_eq!([one.x, one.y], [node.x, node.y]);
            prop_assert_eq!([other.x, other.y], [node.x + moved[0], node.y + moved[1]]);
        }
    }

    /// Children are connected if their parent is, with few exceptions if texels are scarce, and almost none otherwise.
    #[test]
    fn children_are_connected((sample, side) in atlases()) {
        let quality = AtlasQuality::of(&Atlas::new(&sample.mesh, side).expect("an atlas"));
        prop_assert!(quality.simply_connected <= quality.connected && quality.connected <= quality.nodes);
        if sample.manifold {
            let scarce = 4 * sample.mesh.len() as u32 > side * side;
            let share = if scarce { 0.15 } else { 0.02 };
            prop_assert!(quality.torn as f64 <= 1.0 + share * quality.nodes as f64, "{quality:?}");
            if sample.sphere && quality.torn == 0 {
                prop_assert_eq!(quality.connected, quality.nodes);
            }
        }
    }
}

/// Each node of a sphere's tree is connected and has no holes.
#[test]
fn clusters_of_a_sphere_are_simply_connected() {
    for (around, down) in [(6, 4), (16, 16), (40, 30), (64, 64)] {
        let mesh = round(around, down);
        let quality = AtlasQuality::of(&Atlas::new(&mesh, 4 * least_side(&mesh)).expect("an atlas"));
        assert_eq!((quality.connected, quality.torn), (quality.nodes, 0), "{around} x {down}");
        assert_eq!(quality.simply_connected, quality.nodes, "{around} x {down}: {quality:?}");
    }
}

/// A torus is connected but not simply connected; only its largest clusters have holes.
#[test]
fn the_upper_clusters_of_a_torus_have_holes() {
    let quality = AtlasQuality::of(&Atlas::new(&ring([48, 24]), 128).expect("an atlas"));
    assert_eq!((quality.connected, quality.torn), (quality.nodes, 0));
    let pierced = quality.nodes - quality.simply_connected;
    assert!((3..=15).contains(&pierced), "the whole, its halves and some of their parts: {pierced}");
    let top = quality.levels.last().expect("a level");
    assert_eq!((top.nodes, top.connected, top.simply_connected), (1, 1, 0));
}

/// With as many faces as texels, every cut is fixed exactly.
#[test]
fn a_full_atlas_is_still_one() {
    let mesh = ring([32, 32]);
    assert_eq!(mesh.len(), 2048);
    let atlas = Atlas::new(&mesh, 64).expect("an atlas");
    assert!(atlas.places().iter().all(|place| place.texels() >= 1));
    let mesh = ring([64, 32]);
    let atlas = Atlas::new(&mesh, 64).expect("as many texels as faces");
    assert!(atlas.places().iter().all(|place| place.texels() == 1));
}
