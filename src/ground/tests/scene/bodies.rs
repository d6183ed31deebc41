//! Surfaces composed of rounded pieces, and the scanned bunny, at any number of vertices.

use crossbar_base::geom::Mesh;
use crossbar_base::geom::vector::wide;
use crossbar_ground::scene::built::stand_ins;
use crossbar_ground::scene::built::transfer_models::TransferModel;
use glam::DVec3;

/// Refined and coarsened surfaces are closed and lie around the origin. They have exactly the requested number of
/// vertices, no handles (heads and Buddhas excepted), and nearly the volume of the finest one.
#[test]
fn bodies_are_closed_at_every_size_and_keep_their_volume() {
    use TransferModel::{BiScaleArmor, BiScaleBunny, BiScaleBunnyMiddle, Bird, Buddha, Bunny, Head};
    for (model, sizes, vertices) in [
        (Bunny, [4, 2, 1], 11_556),
        (BiScaleBunny, [3, 2, 1], 3_286),
        (BiScaleBunnyMiddle, [6, 3, 1], 12_380),
        (Bird, [8, 4, 3], 48_688),
        (Head, [8, 4, 3], 50_060),
        (Buddha, [4, 3, 2], 54_100),
        (BiScaleArmor, [3, 2, 1], 10_652),
    ] {
        let mut volumes = Vec::new();
        for coarser in sizes {
            let vertices = (vertices / (coarser * coarser)) as usize;
            let mesh = model.mesh(coarser).welded();
            // Parts of coarse heads and Buddhas touch and form handles; each handle adds four triangles.
            let handles = if matches!(model, Head | Buddha) { (mesh.len() + 4 - 2 * vertices) / 4 } else { 0 };
            let triangles = 2 * vertices - 4 + 4 * handles;
            assert_eq!((mesh.positions().len(), mesh.len()), (vertices, triangles), "{model:?}");
            assert_eq!((mesh.boundary_edge_count(), mesh.orientation_conflicts(), mesh.degenerate_count()), (0, 0, 0));
            let [low, high] = mesh.bounds().expect("a box").map(wide);
            assert!((low + high).abs().max_element() < 1.0 && (2.0..3.3).contains(&(high - low).max_element()));
            volumes.push(volume(&mesh));
        }
        let [coarse, middle, fine] = [0, 1, 2].map(|at| volumes[at] / volumes[2]);
        assert!((coarse - fine).abs() < 0.05 && (middle - fine).abs() < 0.02, "{model:?}: {volumes:?}");
    }
}

fn volume(mesh: &Mesh) -> f64 {
    mesh.iter_corners().map(|corners| corners.map(wide)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

/// The bunny's bounding box is 2.5 long and centred at the origin, for any number of vertices.
#[test]
fn the_bunny_is_as_large_as_stand_ins_are() {
    for coarser in 1..=4 {
        let [low, high] = TransferModel::Bunny.mesh(coarser).bounds().expect("a box").map(wide);
        assert!((low + high).abs().max_element() < 1e-5 && ((high - low).max_element() - 2.5).abs() < 1e-5);
    }
}

/// Refinement keeps the order of triangles: the parts of a divided triangle follow each other, so that hardly more
/// pairs of consecutive triangles are far apart than in the scan.
#[test]
fn the_order_of_triangles_is_kept() {
    let far = |mesh: &Mesh| {
        let middles: Vec<DVec3> =
            mesh.iter_corners().map(|corners| corners.map(wide).into_iter().sum::<DVec3>() / 3.0).collect();
        middles.windows(2).filter(|pair| pair[0].distance(pair[1]) > 0.2).count()
    };
    let (scan, refined) = (far(&stand_ins::bunny()), far(&TransferModel::BiScaleBunnyFine.mesh(1)));
    assert!(scan > 10_000 && refined < scan + scan / 50, "{scan}, {refined}");
}
