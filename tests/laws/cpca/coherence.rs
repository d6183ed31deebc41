//! Reclassification draws fewer triangles, never more; its error stays within the budget and is 0 if the budget is 0.

use crate::support::cluster_options;
use crossbar::clustering::{Clustering, Signal, compress};
use crossbar::cpca::coherence::{ConstantRegisters, Superclusters, overdraw, reclassify};
use crossbar::geom::Mesh;
use crossbar::geom::random::CounterRng;
use glam::DVec3;
use proptest::prelude::*;

/// A grid of `size` x `size` vertices, two triangles per cell.
fn grid(size: u32) -> Vec<[u32; 3]> {
    let cells = (0..size - 1).flat_map(|y| (0..size - 1).map(move |x| y * size + x));
    cells.flat_map(|a| [[a, a + 1, a + size], [a + 1, a + size + 1, a + size]]).collect()
}

/// A smooth signal over the grid with noise that makes the borders of clusters ragged.
fn ragged(size: u32, noise: f32) -> Signal {
    let random = CounterRng::new(5);
    let value = |at: u32, j: u32| {
        let (x, y) = ((at % size) as f32 / size as f32, (at / size) as f32 / size as f32);
        let smooth = [x, y, x * y, (x - 0.5) * (x - 0.5)][j as usize];
        smooth + noise * random.unit(u64::from(at), u64::from(j), 0) as f32
    };
    let values = (0..size * size).flat_map(|at| (0..4).map(move |j| value(at, j)));
    Signal::new(4, values.collect()).expect("a signal")
}

fn clustered(signal: &Signal, clusters: usize) -> Clustering {
    compress(signal, &cluster_options(clusters, 1, 6, 4), |_| ()).expect("compressed").clustering
}

fn mean(drawn: u64, triangles: &[[u32; 3]]) -> f64 {
    drawn as f64 / triangles.len() as f64
}

#[test]
fn each_technique_draws_fewer_triangles_and_both_the_fewest() {
    let (signal, triangles) = (ragged(40, 0.03), grid(40));
    let original = clustered(&signal, 30);
    let before = overdraw(&triangles, original.of_point());
    let registers = ConstantRegisters::glossy(256, 24);
    let merged = |clustering: &Clustering| {
        let superclusters = Superclusters::new(clustering, &triangles, registers).expect("superclusters");
        superclusters.overdraw(clustering, &triangles)
    };
    let moved = reclassify(&signal, &original, &triangles, 0.05).expect("reclassified");
    assert_eq!(moved.drawn, [before, overdraw(&triangles, moved.clustering.of_point())]);
    let drawn = [before, moved.drawn[1], merged(&original), merged(&moved.clustering)].map(|d| mean(d, &triangles));
    assert!(drawn[1] < drawn[0] - 0.02 && drawn[2] < drawn[0] - 0.2, "{drawn:?}");
    assert!(drawn[3] < drawn[1] && drawn[3] < drawn[2], "{drawn:?}");
    // The added error is within the budget, and equals the reported one.
    let (error, after) = (original.squared_error(&signal), moved.clustering.squared_error(&signal));
    assert!((after - error - moved.added_error).abs() < 1e-9 * error && after <= 1.05 * error, "{error} to {after}");
    assert_eq!(moved.clustering.subspaces(), original.subspaces(), "the basis stays");
}

#[test]
fn superclusters_keep_within_registers_and_have_no_neighbours_left_to_merge() {
    let (signal, triangles) = (ragged(40, 0.02), grid(40));
    let clustering = clustered(&signal, 30);
    let mut before = u64::MAX;
    for limit in [12, 24, 60, 126, 10_000] {
        let registers = ConstantRegisters::glossy(limit, 24);
        let superclusters = Superclusters::new(&clustering, &triangles, registers).expect("superclusters");
        let mut used = vec![0; superclusters.count()];
        for (subspace, &of) in clustering.subspaces().iter().zip(superclusters.of_cluster()) {
            used[of as usize] += registers.needed(subspace.len());
        }
        assert!(used.iter().all(|&used| used <= limit), "{used:?}");
        for corners in &triangles {
            let of = corners.map(|corner| clustering.of_point()[corner as usize] as usize);
            let of = of.map(|cluster| superclusters.of_cluster()[cluster] as usize);
            for (a, b) in [(of[0], of[1]), (of[1], of[2]), (of[2], of[0])] {
                assert!(a == b || used[a] + used[b] > limit, "{a} and {b} fit together");
            }
        }
        let drawn = superclusters.overdraw(&clustering, &triangles);
        assert!(drawn <= before, "more registers, more triangles");
        before = drawn;
    }
    assert_eq!(before, triangles.len() as u64, "all clusters fit: each triangle is drawn once");
}

#[test]
fn what_does_not_go_together_is_refused() {
    let (signal, triangles) = (ragged(6, 0.0), grid(6));
    let clustering = clustered(&signal, 3);
    let outside = [[0, 1, 2], [3, 36, 4]];
    let registers = ConstantRegisters::glossy(11, 24);
    assert!(reclassify(&signal, &clustering, &outside, 0.1).is_err(), "vertex 36 of 36");
    assert!(Superclusters::new(&clustering, &outside, registers).is_err(), "vertex 36 of 36");
    assert!(Superclusters::new(&clustering, &triangles, registers).is_err(), "a cluster needs 12 registers");
    for budget in [-0.1, f64::NAN, f64::INFINITY] {
        assert!(reclassify(&signal, &clustering, &triangles, budget).is_err(), "{budget}");
    }
    assert!(reclassify(&ragged(7, 0.0), &clustering, &triangles, 0.1).is_err(), "a signal of 49 points");
}

/// A signal and arbitrary triangles over its points, including degenerate ones.
fn any_mesh() -> impl Strategy<Value = (Signal, Vec<[u32; 3]>, usize)> {
    (3..30_u32).prop_flat_map(|points| {
        let values = prop::collection::vec(-4_i8..=4, points as usize * 2);
        let triangles = prop::collection::vec([0..points, 0..points, 0..points], 0..40);
        (values, triangles, 1..=points as usize).prop_map(|(values, triangles, clusters)| {
            let signal = Signal::new(2, values.into_iter().map(f32::from).collect()).expect("a signal");
            (signal, triangles, clusters)
        })
    })
}

proptest! {
    #[test]
    fn no_technique_draws_more(
        (signal, triangles, clusters) in any_mesh(), budget in prop_oneof![Just(0.0), 0.0..0.5_f64], limit in 2_usize..40,
    ) {
        let original = clustered(&signal, clusters);
        let before = overdraw(&triangles, original.of_point());
        let moved = reclassify(&signal, &original, &triangles, budget).expect("reclassified");
        prop_assert_eq!(moved.drawn[0], before);
        prop_assert!(moved.drawn[1] <= before && moved.drawn[1] >= triangles.len() as u64);
        let (error, after) = (original.squared_error(&signal), moved.clustering.squared_error(&signal));
        prop_assert!(after <= (1.0 + budget) * error + 1e-9);
        let superclusters = Superclusters::new(&original, &triangles, ConstantRegisters::diffuse(limit)).expect("fit");
        prop_assert!(superclusters.overdraw(&original, &triangles) <= before);
    }
}

/// The digest covers everything that a transfer depends on.
#[test]
fn digests_tell_meshes_apart() {
    use crossbar::transfer::file::MeshDigest;
    use crossbar::transfer::{Tangents, Vertices};
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.5]];
    let mesh = Mesh::new(corners.clone(), vec![[0, 1, 2], [2, 1, 3]]).expect("a mesh");
    let mut moved = corners.clone();
    moved[3][2] = 0.25;
    let others = [
        Mesh::new(moved, vec![[0, 1, 2], [2, 1, 3]]).expect("a mesh"),
        Mesh::new(corners.clone(), vec![[0, 1, 2], [1, 3, 2]]).expect("a mesh"),
        mesh.clone().with_normals(vec![[0.0, 0.0, 1.0]; 4]).expect("normals"),
    ];
    let digest = |mesh: &Mesh, tangents| MeshDigest::new(&Vertices::new(mesh, tangents).expect("vertices"));
    let one = digest(&mesh, Tangents::Any);
    assert_eq!(digest(&mesh.clone(), Tangents::Any), one);
    assert!(others.iter().all(|other| digest(other, Tangents::Any) != one));
    // The digest covers the values of tangents, not only their source's name.
    let textured = |slope: f32| {
        let texture = corners.iter().map(|&[x, y, _]| [x, y + slope * x]).collect();
        digest(&mesh.clone().with_texcoords(texture).expect("coordinates"), Tangents::Texture)
    };
    assert_ne!(textured(0.0).vertex_crc, textured(0.5).vertex_crc);
    assert_eq!(textured(0.0), textured(0.0));
    let along = [DVec3::X, DVec3::new(1.0, 2.0, 0.0)].map(|axis| digest(&mesh, Tangents::Along(axis)).vertex_crc);
    assert!(along[0] != along[1] && along[1] != one.vertex_crc);
}
